"""The correction of the flexure for full load, over the search for its shape, processor time."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path

from stopwatch import best_time

from springcad.kinds.rotary_flexure.inputs import case_of, rotary_spec, target_of
from springcad.kinds.rotary_flexure.law import design_law
from springcad.kinds.rotary_flexure.root_compliance import forget_roots
from springcad.kinds.rotary_flexure.search import Found, find_shape
from springcad.kinds.rotary_flexure.sizing import Sized, corrected_for
from springcad.spec.source import read_spec

SECONDS = 1.0


@dataclass(frozen=True)
class Correction:
    """Seconds of the search, of the correction, and of it with the roots' elements remembered."""

    search: float
    correction: float
    without_elements: float
    passes: int


def correction(path: Path) -> Correction:
    """A shipped spec, warm."""
    spec = rotary_spec(read_spec(path, ()).model)
    case = case_of(spec).shifted
    law, target = design_law(case.inputs), target_of(spec)

    def quiet(_: str) -> None:
        pass

    def correct(found: Found, *, forget: bool) -> Sized:
        if forget:
            forget_roots()
        return corrected_for(spec, case, target, found, quiet)

    search, found = best_time(partial(find_shape, spec, case, law, quiet), SECONDS)
    whole, sized = best_time(partial(correct, found, forget=True), SECONDS)
    rest, _ = best_time(partial(correct, found, forget=False), SECONDS)
    return Correction(search, whole, rest, sized.passes)
