"""What a bench test tells of a spring, against simulated tests of which the truth is known.

The first simulator is the model of the fit itself with noise: it says whether estimates and
standard errors are right. The second is contact finite elements with friction, which share neither
beam nor root spring nor point of contact with it. The third is the bench of paper 004.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from rotary_cases import written_of
from scipy.optimize import brentq
from sector_cases import rough_cycle

from springcad.kinds.rotary_flexure.bench_fit import Points, at_end, first_known, fit, unknown
from springcad.kinds.rotary_flexure.bench_model import (
    Bench,
    BenchModel,
    bench_model,
    seated_as_drawn,
)
from springcad.kinds.rotary_flexure.measured import travel_of
from springcad.kinds.rotary_flexure.written_spring import written_spring
from springcad.mechanics.beam import prepare

DEGREE = np.pi / 180.0
FULL_CYCLE = ((0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0))


@cache
def model_of(name: str) -> BenchModel:
    written = written_of(name)
    return bench_model(written, written_spring(written))


def recorded(
    model: BenchModel, bench: Bench, seed: int, legs: tuple[tuple[float, float], ...] = FULL_CYCLE
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Angle, torque and true travel: 0.05 deg of noise, and 0.4 % of the peak torque."""
    noise = np.random.default_rng(seed)
    angle = model.reach * np.concatenate([np.linspace(*leg, 70) for leg in legs])
    travel = np.repeat([1 if end > begin else -1 for begin, end in legs], 70)
    torque = model.torque(bench, angle, travel)
    torque = torque + noise.normal(0.0, 0.004 * model.peak_torque, len(angle))
    return angle + noise.normal(0.0, 0.05 * DEGREE, len(angle)), torque, travel


def counted(model: BenchModel, angle: np.ndarray, torque: np.ndarray) -> Points:
    travel = travel_of(angle)
    used = travel.settled & (np.abs(angle) <= model.reach)
    return Points(angle[used], torque[used], travel.direction[used])


@pytest.mark.parametrize("root", [0.0, 6.0])
def test_torques_go_with_the_modulus_exactly_with_friction_and_large_deflection(
    root: float,
) -> None:
    written = written_of("S1")
    spring = written_spring(written)
    beam = spring.beam.beam
    softer = replace(
        beam,
        elastic_modulus=0.94 * beam.elastic_modulus,
        shear_modulus=0.94 * beam.shear_modulus,
        root_compliance=beam.root_compliance / 0.94,
    )
    soft = replace(
        spring,
        beam=prepare(softer),
        sheet=replace(spring.sheet, elastic_modulus=softer.elastic_modulus),
    )
    angle = np.array([0.2, 0.6, 1.0]) * spring.deflection
    torques = [
        seated_as_drawn(written, ring, 1, angle, root=root, friction=-0.2).torque
        for ring in (spring, soft)
    ]
    np.testing.assert_allclose(torques[1], 0.94 * torques[0], rtol=1e-7)


@pytest.mark.parametrize(("root", "friction"), [(-4.0, 0.0), (4.0, 0.3), (16.0, -0.1)])
def test_the_table_is_the_spring_seated(root: float, friction: float) -> None:
    written, model = written_of("S1"), model_of("S1")
    angle = np.array([0.2, 0.53, 0.97]) * model.reach
    for direction, way in zip((1, -1), model.ways, strict=True):
        seat = seated_as_drawn(
            written, written_spring(written), direction, angle, root=root, friction=friction
        )
        sign = np.interp(angle, way.angle, way.loading)
        bench = Bench(root=root, friction=friction)
        found = [
            direction * model.torque(bench, direction * angle, np.full(3, direction * int(s)))[i]
            for i, s in enumerate(sign)
        ]
        np.testing.assert_allclose(found, seat.torque, rtol=2e-4)


def test_estimates_and_their_standard_errors_are_right() -> None:
    model = model_of("S1")
    true = Bench(modulus=0.94, friction=0.17, angle=0.3 * DEGREE)
    deviations, errors = [], []
    for seed in range(80):
        angle, torque, travel = recorded(model, true, seed)
        seen = travel_of(angle)
        assert np.all((seen.direction == travel)[seen.settled])
        found = first_known(model, counted(model, angle, torque), Bench(), ("modulus",))
        assert found is not None
        assert found.free == ("modulus", "friction", "angle")
        errors.append([found.standard_error(name) for name in found.free])
        deviations.append([getattr(found.bench, n) - getattr(true, n) for n in found.free])
    scaled = np.array(deviations) / np.array(errors)
    assert np.all(np.mean(np.abs(scaled) < 2.0, axis=0) >= 0.9)
    spread = np.std(deviations, axis=0)
    np.testing.assert_allclose(np.mean(errors, axis=0), spread, rtol=0.25)


def test_modulus_and_root_cannot_be_told_apart_but_friction_can() -> None:
    model = model_of("S1")
    points = counted(model, *recorded(model, Bench(root=4.0, friction=0.17), 1)[:2])
    both = fit(model, points, Bench(), ("modulus", "root", "friction", "angle"))
    assert {"modulus", "root"} <= set(unknown(model, both))
    assert both.condition > 100.0
    partner, correlation = both.partner("modulus")
    assert partner == "root"
    assert correlation > 0.999
    alone = fit(model, points, Bench(), ("root", "friction", "angle"))
    assert unknown(model, alone) == ()
    assert alone.bench.root == pytest.approx(4.0, abs=0.2)
    assert alone.bench.friction == pytest.approx(0.17, abs=0.015)


def test_loading_alone_tells_no_friction() -> None:
    model = model_of("S1")
    legs = ((0.0, 1.0), (1.0, 0.0), (0.0, -1.0))
    angle, torque, travel = recorded(model, Bench(friction=0.17), 2, legs)
    loading = travel * np.sign(angle) > 0.0
    points = Points(angle[loading], torque[loading], travel[loading])
    found = first_known(model, points, Bench(), ("modulus",))
    assert found is not None
    assert found.free == ("modulus", "angle")
    # The friction that is not seen goes into the modulus.
    assert found.bench.modulus == pytest.approx(1.04, abs=0.01)


LOOPS = {
    "in proportion to torque": lambda part: 1.0,
    "with the square of the angle": lambda part: 2.0 * part**2,
    "only beyond 0.6 of the stroke": lambda part: 1.56 * (np.abs(part) > 0.6),
    "a constant torque": lambda part: 0.5 / np.maximum(np.abs(part), 0.02),
}
"""Half the loop over the torque, by the part of the stroke; of the same energy all of them."""


def loop_of(shape: str, loss: float) -> Points:
    """Of 0.94 of the modulus in the mean of both branches; ``loss`` of a cycle over the work."""
    model, noise = model_of("S1"), np.random.default_rng(6)
    angle = model.reach * np.concatenate([np.linspace(*leg, 60) for leg in FULL_CYCLE])
    travel = np.repeat([1, -1, -1, 1], 60)
    mean = model.torque(Bench(modulus=0.94), angle, travel)
    half = 0.5 * loss * mean * np.sign(angle) * travel * LOOPS[shape](angle / model.reach)
    torque = mean + half + noise.normal(0.0, 0.05, len(angle))
    lost = np.trapezoid(torque, angle) / np.trapezoid(np.abs(mean[:60]), angle[:60]) / 2.0
    assert lost == pytest.approx(loss, rel=0.06)
    return counted(model, angle, torque)


@pytest.mark.parametrize(
    ("shape", "loss"),
    [(shape, loss) for shape in LOOPS for loss in (0.07, 0.094, 0.12)][:-1],
)
def test_a_loop_that_no_friction_explains_is_no_error_of_the_modulus(
    shape: str, loss: float
) -> None:
    model = model_of("S1")
    found = first_known(model, loop_of(shape, loss), Bench(), ("modulus",))
    assert found is not None
    assert "friction" in found.free
    stated = max(2.0 * found.standard_error("modulus"), found.model_error("modulus"))
    assert abs(found.bench.modulus - 0.94) < stated < 0.03


def test_a_loop_too_strange_is_refused_though_the_modulus_is_right() -> None:
    """The last of the loops above: what is left counts as an error, and comes to the limit."""
    model, points = model_of("S1"), loop_of("a constant torque", 0.12)
    assert first_known(model, points, Bench(), ("modulus",)) is None
    found = fit(model, points, Bench(), ("modulus", "friction", "angle"))
    assert 0.015 < found.standard_error("modulus") < 0.017
    assert found.bench.modulus == pytest.approx(0.94, abs=0.003)


def test_a_root_cannot_be_as_stiff_as_a_modulus_of_a_fifth_more() -> None:
    model = model_of("S1")
    points = counted(model, *recorded(model, Bench(modulus=1.2, friction=0.1), 5)[:2])
    found = first_known(model, points, Bench(), ("root",))
    assert found is None or "root" in at_end(found)
    by_modulus = first_known(model, points, Bench(), ("modulus",))
    assert by_modulus is not None
    assert at_end(by_modulus) == ()


def test_noise_and_dwell_do_not_turn_the_travel() -> None:
    noise = np.random.default_rng(3)
    legs = [np.linspace(a, b, 300) for a, b in ((0, 14), (14, 14), (14, -14), (-14, -14), (-14, 2))]
    angle = DEGREE * (np.concatenate(legs) + noise.normal(0.0, 0.1, 1500))
    found = travel_of(angle)
    true = np.repeat([1, 0, -1, 0, 1], 300)
    moving = found.settled & (true != 0)
    assert np.all(found.direction[moving] == true[moving])
    assert np.mean(moving[true != 0]) > 0.9


@pytest.mark.slow
def test_finite_elements_with_friction_are_recovered() -> None:
    """S1 in contact elements with its own modulus and a coefficient of 0.2, one way and back."""
    model = model_of("S1")
    angle, torque = rough_cycle("S1", 0.2)
    points = counted(model, np.append(0.0, angle), np.append(0.0, torque))
    found = fit(model, points, Bench(), ("modulus", "friction"))
    assert found.bench.modulus == pytest.approx(1.0, abs=0.002)
    assert found.bench.friction == pytest.approx(0.2, abs=0.005)
    assert found.scatter < 5e-4


MEASURED = {
    "S1": (161.8 + 159.6, 150.3 + 152.0, 0.0972, 0.0041),
    "S2": (165.4 + 165.1, 155.3 + 151.5, 0.120, 0.0108),
    "S3": (156.8 + 162.2, 148.9 + 151.7, 0.109, 0.0150),
}
"""004, Table II and section IV-B: loading and unloading rates (both directions), loss of a cycle
over the work of loading at the design deflection, and at 9 deg."""


@pytest.mark.parametrize(
    ("name", "by_rate", "by_loss", "by_loss_at_9"),
    [
        ("S1", 0.173, 0.334, 0.021),
        pytest.param("S2", 0.168, 0.333, 0.053, marks=pytest.mark.slow),
        pytest.param("S3", 0.153, 0.345, 0.068, marks=pytest.mark.slow),
    ],
)
def test_no_single_friction_explains_table_ii(
    name: str, by_rate: float, by_loss: float, by_loss_at_9: float
) -> None:
    """The figures of docs/theory/calibration.md; rates are lines through the origin."""
    model = model_of(name)
    loading, unloading, loss, loss_at_9 = MEASURED[name]

    def work(friction: float, degrees: float) -> tuple[float, float]:
        """Rate loading over unloading, loss over loading work; mean of both directions."""
        angle = np.linspace(0.0, min(degrees * DEGREE, model.reach), 400)
        ahead, back = (
            sum(
                way * model.torque(Bench(friction=friction), way * angle, np.full(400, way * on))
                for way in (1, -1)
            )
            for on in (1, -1)
        )
        lost = float(np.trapezoid(ahead - back, angle) / np.trapezoid(ahead, angle))
        return float(angle @ ahead) / float(angle @ back), lost

    rate = brentq(lambda mu: work(mu, 60.0)[0] - loading / unloading, 0.0, 0.44)
    full = brentq(lambda mu: work(mu, 60.0)[1] - loss, 0.0, 0.44)
    nine = brentq(lambda mu: work(mu, 9.0)[1] - loss_at_9, 0.0, 0.44)
    assert (rate, full, nine) == pytest.approx((by_rate, by_loss, by_loss_at_9), abs=0.01)
    assert full > 1.8 * rate
    assert rate > 2.0 * nine
