"""The control-point form: exact gradients, the requirements it must meet, the same bits twice."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from springcad.geometry.neighbours import neighbour_gaps
from springcad.kinds.rotary_flexure.control_point_problem import ControlPointProblem
from springcad.kinds.rotary_flexure.control_points import optimise_control_points, start_point
from springcad.kinds.rotary_flexure.problem import FlexureProblem

S2 = FlexureProblem(
    span=25e-3,
    root_radius=31e-3,
    count=24,
    root_half_thickness=1.552026e-3,
    tip_half_thickness=0.2e-3,
    serpentine_factor=1.240344,
    bend_limit=0.5,
)


def numbers(problem, variables):
    at = problem(variables)
    return np.concatenate(([at.objective], at.equalities, at.inequalities))


def central_difference(problem, variables, step=1e-5):
    """Fourth order, so that 1e-7 can be asked for."""
    columns = []
    for direction in step * np.eye(len(variables)):
        near, far = (
            numbers(problem, variables + k * direction)
            - numbers(problem, variables - k * direction)
            for k in (1, 2)
        )
        columns.append((8 * near - far) / (12 * step))
    return np.column_stack(columns)


@pytest.mark.parametrize("control_points", [1, 2, 3, 4])
@pytest.mark.parametrize("weighting", ["gap", "sharpness"])
def test_gradients_are_exact(control_points, weighting):
    problem = ControlPointProblem(S2, control_points, weighting)
    variables = start_point(problem, seed=7, index=control_points)
    at = problem(variables)
    exact = np.vstack((at.gradient, at.equality_jacobian, at.inequality_jacobian))
    scale = np.maximum(1.0, np.abs(exact).max(axis=1, keepdims=True))
    np.testing.assert_allclose(
        central_difference(problem, variables) / scale, exact / scale, atol=1e-7
    )


def test_a_start_already_has_the_wanted_serpentine_factor():
    problem = ControlPointProblem(S2, 3)
    for index in range(5):
        assert abs(problem(start_point(problem, 0, index)).equalities[0]) < 1e-9


def test_serpentine_factor_of_a_straight_plain_taper_is_one():
    problem = ControlPointProblem(replace(S2, tip_half_thickness=0.0, serpentine_factor=1.0))
    straight = np.array([0.3, -0.2, 0.0, 0.0, 0.1])
    assert problem(straight).equalities == pytest.approx([0.0, 0.0], abs=1e-14)


def test_mirrored_control_points_cost_the_same():
    problem = ControlPointProblem(S2, 3)
    variables = start_point(problem, 3, 0)
    mirrored = variables.copy()
    mirrored[3:6] *= -1.0
    here, there = problem(variables), problem(mirrored)
    assert there.objective == here.objective
    assert there.equalities[0] == pytest.approx(here.equalities[0], abs=1e-14)
    assert there.equalities[1] == pytest.approx(-here.equalities[1], abs=1e-14)
    # The other neighbour is now the near one, and sees the same pairs of points.
    tilted = problem.line(variables), problem.line(mirrored)
    gaps = [
        neighbour_gaps(
            line.x.value, line.y.value, line.half_thickness.value, problem.root_radius, S2.count
        ).gap.min()
        for line in tilted
    ]
    assert gaps[1] == pytest.approx(gaps[0], abs=1e-12)


def test_two_runs_give_the_same_bits():
    once, again = (optimise_control_points(S2, starts=3, seed=11) for _ in range(2))
    assert once.knots.tobytes() == again.knots.tobytes()
    assert once.cost == again.cost
    assert once.feasible_starts == again.feasible_starts


def test_more_starts_never_cost_more():
    few, many = (optimise_control_points(S2, starts=count, seed=5) for count in (2, 6))
    assert many.cost <= few.cost + 1e-6
    assert many.starts == 6


@pytest.mark.parametrize("control_points", [2, 3])
@pytest.mark.parametrize("weighting", ["gap", "sharpness"])
def test_the_best_shape_meets_every_requirement_between_the_grid_points_too(
    weighting, control_points
):
    found = optimise_control_points(
        S2, starts=6, seed=1, weighting=weighting, control_points=control_points
    )
    at = found.ribbon.at(np.linspace(0.0, found.ribbon.length, 8001))
    taper = np.sqrt(np.maximum(1.0 - at.x / S2.span, 0.0))
    width = (S2.root_half_thickness * taper) ** 4 / at.half_thickness**3
    area = np.trapezoid(width, at.stations)

    assert found.feasible
    assert area / (2 / 3 * S2.span * S2.root_half_thickness) == pytest.approx(
        S2.serpentine_factor, abs=5e-5
    )
    assert abs(np.trapezoid(at.y, at.x)) / S2.span < 1e-6 * S2.span
    assert np.max(at.half_thickness * np.abs(at.curvature)) <= S2.bend_limit * 1.002
    assert found.smallest_gap > 0.2e-3
    y = found.knots[1:-1, 1]
    assert y[0] <= 0.0 <= y[1]
    assert np.all(np.abs(y) <= S2.span / 2)
    assert np.all(np.diff(found.knots[:, 0]) > 0.0)


def test_the_flexure_runs_from_the_root_to_the_contact_point_and_ends_along_the_radius():
    ribbon = optimise_control_points(S2, starts=2, seed=1).ribbon
    at = ribbon.at(np.array([0.0, ribbon.edges[-2], ribbon.length]))
    np.testing.assert_allclose(at.x, [0.0, S2.span - S2.pad_length, S2.span], atol=1e-8)
    np.testing.assert_allclose(at.y, 0.0, atol=1e-8)
    np.testing.assert_allclose(at.angle, 0.0, atol=1e-7)
    np.testing.assert_allclose(
        at.half_thickness[[0, 2]], [S2.root_half_thickness, S2.tip_half_thickness], rtol=1e-6
    )


def test_the_ribbon_is_the_spline_of_the_control_points():
    found = optimise_control_points(S2, starts=2, seed=1, control_points=3)
    spline = CubicSpline(*found.knots.T, bc_type="clamped")
    at = found.ribbon.at(np.linspace(0.0, found.ribbon.edges[-2], 500))
    np.testing.assert_allclose(at.y, spline(at.x), atol=1e-8)
    np.testing.assert_allclose(np.tan(at.angle), spline(at.x, 1), atol=1e-6)


def test_a_tip_of_no_thickness_is_the_form_of_the_paper():
    found = optimise_control_points(replace(S2, tip_half_thickness=0.0), starts=2, seed=1)
    assert found.feasible
    assert found.knots[-1].tolist() == [S2.span, 0.0]


def test_local_stress_is_refused():
    with pytest.raises(ValueError, match="nominal stress"):
        optimise_control_points(replace(S2, local_stress=True), starts=1, seed=1)


def test_what_no_start_can_meet_is_said_so():
    """S3 with its bends held to 0.5 has no room for two control points."""
    s3 = FlexureProblem(
        span=20e-3,
        root_radius=26e-3,
        count=24,
        root_half_thickness=1.267574e-3,
        tip_half_thickness=0.2e-3,
        serpentine_factor=1.319759,
        bend_limit=0.5,
    )
    found = optimise_control_points(s3, starts=4, seed=1)
    assert not found.feasible
    assert found.feasible_starts == 0
    assert found.violation > 1e-3


def test_progress_is_told_of_each_start():
    told = []
    optimise_control_points(S2, starts=3, seed=1, progress=told.append)
    assert len(told) == 3


def test_a_straight_flexure_without_bend_limit_is_found_where_no_more_is_needed():
    """f_s that the cut-off tip alone leaves short is reached by a hair of a wave."""
    nearly = replace(S2, serpentine_factor=1.0005, bend_limit=math.inf)
    found = optimise_control_points(nearly, starts=3, seed=1)
    assert found.feasible
    assert np.max(np.abs(found.knots[:, 1])) < 1.5e-3
