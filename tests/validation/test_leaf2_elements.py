"""The unit of paper 003 by contact finite elements: what the second opinion says of it."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from fem_cases import calculix_prints
from leaf2_cases import DEGREE, INBOARD, MM, PAPER_LEAF, PAPER_LEVER

from springcad.geometry.polyline import BulgePolyline
from springcad.kinds.leaf_2dof.deck import leaf_deck
from springcad.kinds.leaf_2dof.judge import TOLERANCE, judge_leaf, pressed
from springcad.kinds.leaf_2dof.leaf import Leaf, Lever
from springcad.kinds.leaf_2dof.leaf_mesh import (
    clamp_stress,
    contact_station,
    leaf_contact,
    press_through,
)
from springcad.kinds.leaf_2dof.unit import stroke
from springcad.kinds.leaf_2dof.written_leaf import written_leaf
from springcad.written import IncompleteDesignError, WrittenDesign

PLASTIC = Leaf(10 * MM, 1 * MM, 2.6e9, 0.35)
OVERHANG, END_RADIUS, GUIDE = 4.5 * MM, 2 * MM, 22 * MM


@pytest.mark.parametrize(
    ("leaf", "lever", "length", "degrees"),
    [
        (PAPER_LEAF, PAPER_LEVER, 45, 14.83),
        (PAPER_LEAF, PAPER_LEVER, 10, 0.86),
        (PLASTIC, INBOARD, 15, 8.0),
    ],
    ids=["longest", "shortest, at yield", "inboard, plastic, bent by 20 deg"],
)
def test_the_beam_and_its_moving_contact_agree_with_finite_elements(
    leaf: Leaf, lever: Lever, length: float, degrees: float
) -> None:
    """Nothing is shared but the elastic constants and the plane section at the guide. The elements
    let the leaf sink a little into the roller, 5e-4 of its way."""
    angles = degrees * DEGREE * np.array([0.5, 1.0])
    beam = stroke(leaf, lever, length * MM, angles)
    contact = leaf_contact(leaf, lever, length * MM, OVERHANG, beam.station, angles[-1])
    presses = press_through(contact, list(angles))
    torque = [press.torque for press in presses]
    np.testing.assert_allclose(torque, beam.torque, rtol=3e-3)
    np.testing.assert_allclose([press.force for press in presses], beam.force, rtol=3e-3)
    np.testing.assert_allclose([p.state.energy for p in presses], beam.energy, rtol=3e-3)
    stress = [clamp_stress(contact, press) for press in presses]
    np.testing.assert_allclose(stress, beam.stress, rtol=4e-3)
    stations = [contact_station(contact, press) for press in presses]
    np.testing.assert_allclose(stations, beam.station, atol=0.01 * MM)


@cache
def written(torque_factor: float = 1.0, drawn_length: float = 0.0) -> WrittenDesign:
    """The paper's unit at one effective length, as a report tells it."""
    length, leaves = 15 * MM, 2
    found = stroke(PAPER_LEAF, PAPER_LEVER, length, np.linspace(0, 3.0, 13) * DEGREE)
    whole = GUIDE + length + OVERHANG
    corners = np.array([[0, -5], [1, -5], [1, 5], [0, 5]]) * [drawn_length or whole, MM]
    return WrittenDesign(
        "leaf-2dof",
        "unit",
        design={
            "leaves_per_axis": leaves,
            "arm_radius_m": PAPER_LEVER.radius,
            "roller_radius_m": PAPER_LEVER.roller_radius,
            "clamp": PAPER_LEVER.clamp,
            "leaf_width_m": PAPER_LEAF.width,
            "leaf_thickness_m": PAPER_LEAF.thickness,
            "longest_length_m": length,
            "elastic_modulus_Pa": PAPER_LEAF.elastic_modulus,
            "poisson_ratio": PAPER_LEAF.poisson_ratio,
            "leaf": {"length_m": whole, "overhang_m": OVERHANG, "end_radius_m": END_RADIUS},
            "stroke_count": 1,
        },
        response={
            "strokes": {
                "1": {
                    "effective_length_m": length,
                    "angle_rad": found.angle,
                    "torque_Nm": leaves * torque_factor * found.torque,
                    "roller_force_N": found.force,
                    "nominal_stress_Pa": found.stress,
                    "contact_station_m": found.station,
                }
            }
        },
        contours={"": (BulgePolyline(corners, np.zeros(4)),)},
    )


def test_the_judge_finds_a_wrong_torque_and_a_wrong_drawing_and_agrees_with_the_rest() -> None:
    judgement = judge_leaf(written(1.03, 46 * MM), lambda _: None)
    torque, force, stress = judgement.comparisons
    np.testing.assert_allclose(torque.differences, -0.03, atol=2e-3)
    assert np.all(np.abs(torque.differences) > TOLERANCE)
    for comparison in (force, stress):
        assert np.all(np.abs(comparison.differences) < 0.4 * comparison.tolerance)
    assert [check.status for check in judgement.checks] == ["fail", "pass", "pass"]


def test_a_report_without_its_numbers_is_not_judged() -> None:
    design = written()
    incomplete = replace(design, response={"strokes": {}})
    with pytest.raises(IncompleteDesignError, match=r"strokes\.1"):
        judge_leaf(incomplete, lambda _: None)
    with pytest.raises(IncompleteDesignError, match="contour"):
        judge_leaf(replace(design, contours={}), lambda _: None)
    with pytest.raises(IncompleteDesignError, match="sideways"):
        judge_leaf(replace(design, design={**design.design, "clamp": "sideways"}), lambda _: None)


def test_calculix_repeats_the_second_opinion(require_tool, tmp_path: Path) -> None:
    """Torque and force at the largest angle, as the comments of the deck tell ours."""
    known = written_leaf(written())
    contact, presses = pressed(known, known.strokes[0])
    deck = leaf_deck(contact, presses[-1:], "unit")
    (row,) = re.findall(r"^\*\* +(\d+(?: +[-\d.e+]+){4})$", deck, flags=re.MULTILINE)
    _, _, torque, force, _ = map(float, row.split())
    printed = calculix_prints(require_tool("ccx"), deck, tmp_path)
    numbers = re.findall(r"total surface force .*\n\s*\n(.*)\n", printed)
    x, y, _, _, _, moment = map(float, numbers[-1].split())
    assert moment == pytest.approx(torque, rel=1e-3)
    assert np.hypot(x, y) == pytest.approx(force, rel=1e-3)
