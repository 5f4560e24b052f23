"""Where no omega leaf does, the changes that are named have been tried as they are printed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from lever_cases import STEEL, STEEL_LEAF

from springcad.errors import InfeasibleError
from springcad.kinds.lever_arm import curved_remedies, curved_spring
from springcad.kinds.lever_arm.curved_remedies import search_remedies
from springcad.kinds.lever_arm.curved_spring import curved_spring as make_spring
from springcad.kinds.lever_arm.curved_spring import omega_case
from springcad.kinds.lever_arm.inputs import case_of, fittings_of, lever_spec
from springcad.kinds.lever_arm.made import MadeSpring
from springcad.kinds.lever_arm.omega import OmegaCase, OmegaDesign, OmegaSpread
from springcad.spec.source import read_spec

SPEC = Path(__file__).parents[2] / "specs/lever-steel.yaml"
STIFFNESS = 13.2e6
"""Per width, of the stored leaf [N/m per m]."""


def design_of(case: OmegaCase) -> OmegaDesign:
    """As if a search had ended in the stored leaf."""
    spread = OmegaSpread(1, np.array([STIFFNESS]))
    leaf = replace(STEEL_LEAF, hub_radius=case.hub_radius)
    return OmegaDesign(case, leaf, STIFFNESS, leaf, STIFFNESS, spread)


def remedies(monkeypatch: pytest.MonkeyPatch, works, *overrides: str) -> tuple[list, Sequence[str]]:
    """What was tried and is advised if searches find a leaf where ``works(case, starts)``."""
    tried = []

    def find(case: OmegaCase, *, starts: int, seed: int) -> OmegaDesign:
        tried.append((case, starts))
        if works(case, starts):
            return design_of(case)
        raise InfeasibleError("searches that found a leaf", 0.0, 1.0, "1")

    monkeypatch.setattr(curved_remedies, "find_omega", find)
    spec = lever_spec(read_spec(SPEC, overrides).model)
    fittings = fittings_of(spec)
    advised = search_remedies(
        case_of(spec), spec.leaf.topology, spec.optimiser.starts, spec.optimiser.seed,
        lambda case, topology: omega_case(case, fittings, topology), lambda _: None,
    )  # fmt: skip
    return tried, advised


def test_the_first_radius_at_which_a_search_finds_a_leaf_is_named(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    tried, advised = remedies(monkeypatch, lambda case, _: case.enclosure_radius > 70e-3)
    assert advised == ("raise envelope.radius from 50 to 80 mm",)
    assert [round(1e3 * case.enclosure_radius, 9) for case, _ in tried][-2:] == [62.5, 80.0]
    assert {starts for _, starts in tried} == {3}


def test_less_deflection_is_tried_too_and_nothing_is_promised_that_fails(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    _, advised = remedies(monkeypatch, lambda case, _: case.stroke < 7e-3)
    assert advised == ("lower target.spring_deflection from 10 to 6.3 mm",)
    assert remedies(monkeypatch, lambda *_: False)[1] == ()


def test_few_starts_and_one_sided_leaves_have_remedies_of_their_own(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    few = remedies(monkeypatch, lambda _, starts: starts > 3, "optimiser.starts=2")[1]
    assert few == ("raise optimiser.starts from 2 to 5",)
    _, advised = remedies(
        monkeypatch, lambda case, _: case.topology == "free", "leaf.topology=omega"
    )
    assert advised == ("take leaf.topology out of the spec",)


def spring(monkeypatch: pytest.MonkeyPatch, *overrides: str) -> MadeSpring:
    """The spring of the shipped spec, if the search ends in the stored leaf."""
    given = ("connection.eye_wall=3 mm", *overrides)
    spec = lever_spec(read_spec(SPEC, given).model)
    monkeypatch.setattr(curved_spring, "find_omega", lambda case, **_: design_of(case))
    return make_spring(case_of(spec), fittings_of(spec), ("free", 1, 1), 7850.0, lambda _: None)


@pytest.mark.parametrize(
    ("sheet", "layers"), [("20 mm", None), ("3 mm", 12)], ids=["sheet too thick", "too many layers"]
)
def test_a_stack_that_cannot_be_soft_enough_names_changes_that_hold_exactly(
    monkeypatch: pytest.MonkeyPatch, sheet: str, layers: int | None
) -> None:
    """All along at its least web the leaf is stiffer still; force is proportional to width."""
    given = [f"leaf.sheet_thickness={sheet}", "target.spring_stiffness=1 N/mm"]
    given += [f"leaf.layers={layers}"] if layers else []
    with pytest.raises(InfeasibleError, match="as thin as can be cut") as refused:
        spring(monkeypatch, *given)
    assert refused.value.value > refused.value.limit == 1e3
    assert len(refused.value.remedies) == 2
    for remedy in refused.value.remedies:
        _, key, _, _, _, *value = remedy.split()
        made = spring(monkeypatch, *given, f"{key}={' '.join(value)}")
        wanted = 1e3 * float(value[0]) if key == "target.spring_stiffness" else 1e3
        assert made.stiffness == pytest.approx(wanted, rel=1e-6)
        least = np.asarray(made.response["leaf_thickness_m"]).min()
        assert least >= STEEL.min_web * (1.0 - 1e-9)
