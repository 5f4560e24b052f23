"""A root is thickened until its fillets keep their limit, and the sizing settles on it."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest
from rotary_cases import rotary_model

from springcad.errors import InfeasibleError
from springcad.kinds.rotary_flexure.full_load import demand_of, loads_of
from springcad.kinds.rotary_flexure.inputs import case_of, target_of
from springcad.kinds.rotary_flexure.law import design_law
from springcad.kinds.rotary_flexure.relief import AIM, LEAST, Relief
from springcad.kinds.rotary_flexure.settling import PATIENCE, Settling
from springcad.kinds.rotary_flexure.sizing import PASSES, Sized, size_flexure
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.kinds.rotary_flexure.straight_limit import STRAIGHT_EXCESS, STRAIGHT_LIMIT

YIELD = 1310e6
STRAIGHT = (
    "flexures.fillet_stress=1310 MPa", "flexures.count=30", "envelope.contact_radius=4.3 mm",
    "flexures.style=straight",
)  # fmt: skip


def model(degrees: float, *overrides: str) -> RotaryFlexureSpec:
    return rotary_model("rotary-auto", *STRAIGHT, f"target.deflection={degrees!r} deg", *overrides)


def sized_of(spec: RotaryFlexureSpec) -> Sized:
    case = case_of(spec).shifted
    return size_flexure(spec, case, design_law(case.inputs), target_of(spec), lambda _: None)


def fillet_stress(spec: RotaryFlexureSpec, sized: Sized) -> float:
    """At full load, the larger of both directions, Pa."""
    inputs = case_of(spec).inputs
    demand = demand_of(target_of(spec), inputs.root_radius, inputs.contact_radius, inputs.count)
    states = loads_of(sized.found.ribbon, sized.beam, demand)
    nominal = max(float(state.nominal_stress[-1, 0]) for state in states)
    return sized.root.fillet_stress_factor * nominal


@pytest.mark.parametrize("degrees", [7.0, 8.6, 9.5, 10.0, 11.0, 11.6, 12.1, 12.4])
def test_straight_flexures_settle_at_any_deflection(degrees: float) -> None:
    """Stiffness within 0.1 %, the fillets at their limit wherever they would be beyond it."""
    spec = model(degrees)
    sized = sized_of(spec)
    assert sized.passes <= 6
    assert sized.stiffness_at_rest == pytest.approx(150.0, rel=1e-3)
    stress = fillet_stress(spec, sized)
    assert stress <= YIELD
    if sized.root_relief < 1.0:
        assert stress == pytest.approx(AIM * YIELD, rel=4e-3)


@pytest.mark.parametrize("fillet", ["0.3 mm", "auto"])
def test_larger_fillets_leave_more_of_the_design_stress(fillet: str) -> None:
    larger = sized_of(model(11.0, f"flexures.root_fillet={fillet}"))
    assert larger.root_relief > sized_of(model(11.0)).root_relief


def test_the_limit_of_straight_flexures_is_below_that_without_a_limit_for_fillets() -> None:
    """A thick root is stiff, so what is left of the flexure bears more: 12.45 deg is the end."""
    with pytest.raises(InfeasibleError) as told:
        sized_of(model(13.2))
    assert told.value.claim == STRAIGHT_LIMIT
    limit = math.degrees(told.value.limit)
    assert limit == pytest.approx(12.45, abs=0.01)
    assert sized_of(model(math.floor(100 * limit) / 100)).level <= 1.0 + STRAIGHT_EXCESS
    assert sized_of(model(13.2, "flexures.fillet_stress=10 GPa")).level < 1.0


@pytest.mark.parametrize(("decade", "scale"), [(15.0, 20.0), (20.0, 35.0), (10.0, 10.0)])
def test_straight_flexures_have_the_stiffness_of_a_law_that_stiffens(
    decade: float, scale: float
) -> None:
    """The slope of a (10^(x/d) - 1) at rest; the pad moves with the contact, by 0.7 mm."""
    spec = rotary_model(
        "rotary-exponential", "target.deflection=8 deg",
        f"target.law={{exponential: {{scale: {scale} N*m, decade: {decade} deg}}}}",
    )  # fmt: skip
    sized = sized_of(spec)
    assert sized.found.style == "straight"
    at_rest = scale * math.log(10.0) / math.radians(decade)
    assert sized.stiffness_at_rest == pytest.approx(at_rest, rel=1e-3)
    assert sized.passes < PASSES - 3


@pytest.mark.parametrize("power", [0.45, 0.6, 0.85, 1.1])
def test_relief_finds_the_limit_whatever_the_power(power: float) -> None:
    """Stress of fillets as share^power: within 0.1 % of its aim after four secants."""
    relief = Relief()
    for _ in range(5):
        relief = relief.after(1.6 * YIELD * relief.share**power, YIELD)
    assert relief.share == pytest.approx((AIM / 1.6) ** (1.0 / power), rel=2e-3)
    assert relief.kept


def test_fillets_that_nothing_helps_end_the_search_for_relief() -> None:
    relief = Relief()
    for _ in range(8):
        relief = relief.after(5.0 * YIELD * relief.share**0.5, YIELD)
    assert relief.share == LEAST
    assert relief.kept


def test_fillets_within_their_limit_ask_for_no_relief() -> None:
    assert Relief().after(0.7 * YIELD, YIELD).share == 1.0


def passes_until_the_end(off: Callable[[int], float]) -> int:
    settling = Settling()
    ends = (n for n in range(99) if settling.ended(off(n), 0.0, shaping=False))
    return next(ends) + 1


def test_a_sizing_that_goes_round_in_circles_is_given_up() -> None:
    assert passes_until_the_end(lambda n: (0.02, 0.01)[n % 2]) == 2 + PATIENCE
    # Halving from 10 % down to 0.04 % takes eight passes; nothing is given up before.
    assert passes_until_the_end(lambda n: 0.1 * 0.5**n) >= 8
