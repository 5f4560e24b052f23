"""What helps where no omega leaf was found: changes of the spec, each tried by a short search.

No closed form tells whether a search will end in a leaf. So a few values are tried as they are
printed, with the first starts of the spec's own search; what works with these works with all.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import islice

from springcad.errors import InfeasibleError
from springcad.kinds.knobs import Knob, changed, value_of
from springcad.kinds.lever_arm.case import Case
from springcad.kinds.lever_arm.changes import KNOBS
from springcad.kinds.lever_arm.claims import claims
from springcad.kinds.lever_arm.omega import OmegaCase, Topology, find_omega
from springcad.kinds.lever_arm.stack import layer_count
from springcad.result import Progress

TRIED_STARTS = 3
FEW_STARTS = 10
"""Below so many starts a few more may be all that is missing."""
FACTORS = {"radius": (1.25, 1.6, 2.0), "deflection": (0.8, 0.63, 0.5)}
"""By which numbers of the spec are changed, until one works."""


def search_remedies(
    case: Case,
    topology: Topology,
    starts: int,
    seed: int,
    asked: Callable[[Case, Topology], OmegaCase],
    progress: Progress,
) -> tuple[str, ...]:
    """Changes with each of which a short search found a leaf; empty if none did.

    Args:
        asked: what a search is asked for.
    """

    def found(tried: Case, tried_topology: Topology, tried_starts: int, change: str) -> bool:
        progress(f"no leaf was found; trying to {change}")
        if any(claim.status == "fail" for claim in claims(tried)):
            return False
        try:
            best = find_omega(asked(tried, tried_topology), starts=tried_starts, seed=seed)
            layer_count(tried, tried.count * best.stiffness * tried.sheet)
        except InfeasibleError:
            return False
        return True

    few = min(starts, TRIED_STARTS)
    remedies = []
    if starts < FEW_STARTS:
        more = starts + TRIED_STARTS
        change = f"raise optimiser.starts from {starts} to {more}"
        remedies += [change] if found(case, topology, more, change) else []
    if topology == "omega":
        change = "take leaf.topology out of the spec"
        remedies += [change] if found(case, "free", few, change) else []
    for knob in KNOBS:
        options = ((c, found(tried, topology, few, c)) for c, tried in _options(case, knob))
        remedies += list(islice((change for change, works in options if works), 1))
    return tuple(remedies)


def _options(case: Case, knob: Knob) -> Iterator[tuple[str, Case]]:
    start = value_of(case, knob)
    for factor in FACTORS.get(knob.target, ()):
        value = float(f"{factor * start:.3g}")
        verb = "raise" if factor > 1.0 else "lower"
        yield (
            f"{verb} {knob.key} from {start:.4g} to {value:g} {knob.unit}",
            changed(case, knob, value),
        )
