"""Every check of a finished spring can be made to speak up; and no invalid outline is written."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from rotary_cases import SPECS, spring_of, statuses

from springcad.batch.design_one import exit_code_of
from springcad.errors import InfeasibleError
from springcad.geometry.outline import Line, Outline, Profile
from springcad.kinds.rotary_flexure import design
from springcad.kinds.rotary_flexure.checks import root_fillet_stress, spring_checks
from springcad.kinds.rotary_flexure.spring import Spring
from springcad.result import Check

FAIL, WARN = "fail", "warn"


def with_stroke(**factors: float) -> Callable[[Spring], Spring]:
    """The spring with fields of both strokes times a factor."""

    def change(spring: Spring) -> Spring:
        strokes = [
            replace(s, **{name: factor * getattr(s, name) for name, factor in factors.items()})
            for s in spring.strokes
        ]
        return replace(spring, strokes=(strokes[0], strokes[1]))

    return change


def with_camshaft(**changes: float) -> Callable[[Spring], Spring]:
    return lambda spring: replace(spring, camshaft=replace(spring.camshaft, **changes))


def with_found(spring: Spring, **changes: object) -> Spring:
    found = replace(spring.found, **changes)  # type: ignore[arg-type]
    return replace(spring, sized=replace(spring.sized, found=found))


def bent_sideways(spring: Spring) -> Spring:
    ribbon = spring.found.ribbon
    return with_found(spring, ribbon=replace(ribbon, root_angle=ribbon.root_angle + 0.05))


def more_curved(spring: Spring) -> Spring:
    ribbon = spring.found.ribbon
    return with_found(spring, ribbon=replace(ribbon, curvature=1.05 * ribbon.curvature))


def with_sharper_root(spring: Spring) -> Spring:
    root = spring.sized.root
    sharper = replace(root, fillet_stress_factor=1.5 * root.fillet_stress_factor)
    return replace(spring, sized=replace(spring.sized, root=sharper))


FAULTS: dict[str, tuple[str, Callable[[Spring], Spring]]] = {
    "secant stiffness counter-clockwise, deviation from the target": (
        FAIL, with_stroke(torque=1.02),
    ),
    "secant stiffness clockwise, deviation from the target": (FAIL, with_stroke(torque=0.98)),
    "inner-fibre stress against yield": (WARN, with_stroke(local_stress=1.2)),
    "half thickness x curvature": (FAIL, more_curved),
    "gap between flexures at rest": (
        FAIL, lambda spring: with_found(spring, gap=0.2e-3),
    ),
    "gap between deformed flexures counter-clockwise": (FAIL, with_stroke(gap=-1.0)),
    "gap between deformed flexures clockwise": (FAIL, with_stroke(gap=math.nan)),
    "root fillet radius": (
        FAIL, lambda spring: replace(spring, sized=replace(spring.sized, fillet=0.1e-3)),
    ),
    "root fillet stress against yield": (WARN, with_sharper_root),
    "lateral balance: radial over tangential compliance of the tip": (WARN, bent_sideways),
    "camshaft tooth, thinnest": (FAIL, with_camshaft(tooth_thickness=0.29e-3)),
    "camshaft tooth root stress against yield": (FAIL, with_camshaft(tooth_stress=1.4e9)),
    "camshaft torsion inside the slots": (FAIL, with_camshaft(hub_stress=0.8e9)),
    "contact pressure on the flanks": (WARN, with_stroke(pressure=2.0)),
    "interference of camshaft and tips in the stroke": (FAIL, with_camshaft(overlap=6e-6)),
}  # fmt: skip


@cache
def checks_of(name: str, *overrides: str) -> dict[str, Check]:
    return {claim.name: claim for claim in spring_checks(spring_of(name, *overrides))}


def test_s2_passes_everything_but_the_root_fillets_of_which_it_warns() -> None:
    found = statuses("S2")
    assert {name: status for name, status in found.items() if status != "pass"} == {
        "root fillet stress against yield": WARN,
    }


@pytest.mark.parametrize("name", FAULTS)
def test_each_claim_speaks_up_when_it_is_broken(name: str) -> None:
    status, breaks = FAULTS[name]
    sound = "S1" if name.startswith("root fillet stress") else "S2"
    found = {claim.name: claim for claim in spring_checks(breaks(spring_of(sound)))}
    assert checks_of(sound)[name].status == "pass"
    assert found[name].status == status
    assert exit_code_of([found[name]], strict=False) == (5 if status == FAIL else 0)
    assert exit_code_of([found[name]], strict=True) == 5


def test_these_are_all_checks_that_follow_the_search() -> None:
    spring = spring_of("S2")
    before = {claim.name for claim in spring.feasibility}
    rest = "stiffness at rest with contact at the contact radius, deviation from the target"
    torque = {
        f"torque {way}, largest deviation from the law over the full torque"
        for way in ("clockwise", "counter-clockwise")
    }
    others = {rest, "nominal stress at full load", *torque}
    assert {claim.name for claim in spring_checks(spring)} - before == {*FAULTS, *others}


def test_too_much_stress_a_wrong_stiffness_at_rest_and_a_wrong_law_fail() -> None:
    spring = spring_of("S2")
    stiffer = replace(spring, sized=replace(spring.sized, stiffness_at_rest=150.2))
    wrong = "torque clockwise, largest deviation from the law over the full torque"
    for name, broken in (
        (wrong, with_stroke(torque=1.011)(spring)),
        ("nominal stress at full load", with_stroke(nominal_stress=1.006)(spring)),
        (
            "stiffness at rest with contact at the contact radius, deviation from the target",
            stiffer,
        ),
    ):
        found = {claim.name: claim for claim in spring_checks(broken)}
        assert checks_of("S2")[name].status == "pass"
        assert found[name].status == FAIL


LOCAL = ("S2", "stress=local", "target.stiffness=100 N*m/rad", "target.deflection=15 deg")


def test_local_stress_is_held_and_judged_instead_of_the_nominal_one() -> None:
    """S2, softer: its flexures have room for what the inner fibres ask for."""
    found = checks_of(*LOCAL)
    held = found["inner-fibre stress at full load"]
    assert (held.status, held.value) == ("pass", pytest.approx(912e6, rel=5e-3))
    assert held.limit == pytest.approx(1.005 * 912e6)
    assert not any(name.startswith("nominal stress") for name in found)


def test_inner_fibres_beyond_yield_fail_where_they_are_what_is_asked_for() -> None:
    spring = spring_of(*LOCAL)
    found = {c.name: c for c in spring_checks(with_stroke(local_stress=1.6)(spring))}
    assert found["inner-fibre stress against yield"].status == FAIL


def test_roots_are_thickened_until_their_fillets_keep_the_stress_asked_for() -> None:
    """Unasked the fillets of S2 bear 1580 MPa; the rest of the flexure stays fully stressed."""
    asked = ("S2", "flexures.fillet_stress=1400 MPa")
    plain, thicker = spring_of("S2"), spring_of(*asked)
    assert root_fillet_stress(plain) > 1.5e9
    assert root_fillet_stress(thicker) == pytest.approx(1.4e9, rel=5e-3)
    assert checks_of(*asked)["root fillet stress"].status == "pass"
    roots = [float(s.found.ribbon.half_thickness[0]) for s in (plain, thicker)]
    assert roots[1] > 1.05 * roots[0]
    assert max(s.nominal_stress.max() for s in thicker.strokes) == pytest.approx(912e6, rel=5e-3)


def test_the_root_fillet_stress_is_the_root_s_times_the_factor_of_the_fillet() -> None:
    spring = spring_of("S1")
    stroke = spring.strokes[0]
    root = spring.found.ribbon.at(np.zeros(1))
    moment = stroke.force[-1] * spring.law.span
    nominal = 1.5 * moment / (4.5e-3 * float(root.half_thickness[0]) ** 2)
    # Finite elements of S1 with a fillet of half the root thickness: 1.23 to 1.27.
    assert root_fillet_stress(spring) == pytest.approx(1.25 * nominal, rel=0.03)


@pytest.mark.parametrize("part", ["flexure ring", "camshaft"])
def test_a_part_with_a_faulty_outline_is_never_finished(
    part: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    from springcad.batch.design_one import Wishes, attempt_design
    from springcad.batch.specs import read_specs

    points = [(0.0, 0.0), (1e-3, 1e-3), (1e-3, 0.0), (0.0, 1e-3)]
    sides = zip(points, [*points[1:], points[0]], strict=True)
    bow_tie = Profile(Outline(tuple(Line(a, b) for a, b in sides)))
    if part == "camshaft":
        made = design.design_camshaft

        def broken(*args: object) -> object:
            return replace(made(*args), profile=bow_tie)  # type: ignore[arg-type]

        monkeypatch.setattr(design, "design_camshaft", broken)
    else:
        monkeypatch.setattr(design, "ring_profile", lambda *_: bow_tie)
    (reading,) = read_specs([SPECS / "S1.yaml"], ())
    attempt = attempt_design(reading, Wishes(tmp_path, strict=False, judged=False), lambda _: None)
    assert attempt.exit_code == 4
    assert isinstance(attempt.error, InfeasibleError)
    assert f"faults in the outline of the {part} (outer contour cuts itself" in str(attempt.error)
    assert list(tmp_path.iterdir()) == []
