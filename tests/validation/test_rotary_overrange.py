"""How far a spring may be turned, how far its tips slide, and what ends its use."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from rotary_cases import spring_of, written_of

from springcad.kinds.rotary_flexure.camshaft import seated
from springcad.kinds.rotary_flexure.numbers import sliding
from springcad.kinds.rotary_flexure.overrange import FLANK, GAP, YIELD, EndOfUse, end_of_use
from springcad.kinds.rotary_flexure.sector_contact import sector_contact, torque, turn_through
from springcad.kinds.rotary_flexure.written_spring import written_spring
from springcad.mechanics.conjugate import between, until
from springcad.mechanics.friction import sliding_path


def end(name: str, yield_strength: float, count: int | None = None) -> EndOfUse:
    spring = spring_of(name)
    inputs = spring.camshaft_inputs
    inputs = replace(inputs, count=count or inputs.count)
    return end_of_use(spring.found.ribbon, spring.beam, spring.camshaft, inputs, 1, yield_strength)


def test_the_flanks_end_four_per_cent_beyond_the_stroke() -> None:
    spring = spring_of("S1")
    assert spring.end.limit == FLANK
    assert spring.end.angle == pytest.approx(1.04 * spring.target.deflection, rel=1e-9)
    assert spring.end.torque == pytest.approx(150.0 * spring.end.angle, rel=1e-3)


def test_finite_elements_still_rest_on_the_flank_there() -> None:
    """With the torque that the beam finds at the end of the flanks."""
    spring, sector = spring_of("S1"), sector_contact(written_spring(written_of("S1")), 1)
    (turn,) = turn_through(sector, [spring.end.angle])
    assert turn.angle == pytest.approx(spring.end.angle)
    assert torque(sector, turn) == pytest.approx(spring.end.torque, rel=0.01)


def test_yield_ends_it_where_the_inner_fibres_reach_it() -> None:
    stroke = spring_of("rotary-stiffening").strokes[0]
    strength = 0.9 * float(stroke.local_stress[-1])
    found = end("rotary-stiffening", strength)
    assert found.limit == YIELD
    assert np.interp(found.angle, stroke.angle, stroke.local_stress) == pytest.approx(
        strength, rel=1e-3
    )
    assert np.interp(found.angle, stroke.angle, stroke.torque) == pytest.approx(found.torque)


def test_touching_neighbours_end_it() -> None:
    """Twice as many of the same flexures have no room between them."""
    assert end("S1", 1310e6, count=60).limit == GAP


def test_sliding_is_the_way_along_the_flank_less_that_along_the_pad() -> None:
    """A second way, from the contacts on the camshaft as drawn, where the flank is exact.

    From rest on it slides back a little at first; 0.14 mm in all, 3 % of the energy for each 0.1.
    """
    spring = spring_of("S1")
    full = spring.target.deflection * (1.0 + 1e-9)
    flank = until(spring.camshaft.flanks[0], full)
    seen = between(flank, 0.3 * full, full)
    seat = seated(spring.beam, spring.camshaft_inputs, spring.camshaft, seen)
    on_flank, on_pad = (np.abs(np.ptp(way)) for way in (seat.place, seat.station))
    path = np.trapezoid(np.abs(seen.sliding), seen.angle)
    assert path == pytest.approx(on_flank - on_pad, rel=0.01)
    assert path < sliding_path(flank) < 1.1 * path


def test_friction_of_a_tenth_costs_three_per_cent_of_s1() -> None:
    """Trial implementation, S1: loop over loading energy 2.95 % per 0.1 with this tip."""
    spring = spring_of("S1")
    share = 0.1 * float(sliding(spring)["loss_per_friction_J"]) / spring.law.energy  # type: ignore[arg-type]
    assert share == pytest.approx(0.0295, rel=0.07)
