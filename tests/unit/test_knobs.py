"""Changes of numbers that make an infeasible case feasible: what is printed is what was tried."""

from __future__ import annotations

from dataclasses import dataclass, replace

from springcad.kinds.knobs import Knob, far_remedies, remedies

LENGTH = Knob("length", "mm", 1e-3, "length")
WIDTH = Knob("width", "mm", 1e-3, "width")
COUNT = Knob("count", "", 1.0, "count")


@dataclass(frozen=True)
class Beams:
    """Equal beams side by side, SI."""

    length: float = 10e-3
    width: float = 10e-3
    count: int = 1


def test_the_number_printed_is_the_first_of_three_digits_that_works() -> None:
    def failures(case: Beams) -> tuple[str, ...]:
        return () if case.length > 12.34e-3 else ("length",)

    assert remedies(Beams(), [LENGTH], failures) == ("raise length from 10 to ≥ 12.4 mm",)


def test_where_it_stops_working_is_said() -> None:
    def failures(case: Beams) -> tuple[str, ...]:
        return () if 12e-3 < case.length < 13e-3 else ("length",)

    assert remedies(Beams(), [LENGTH], failures) == (
        "raise length from 10 to ≥ 12.1 mm (up to 12.9)",
    )


def test_two_numbers_are_turned_where_one_does_not_help() -> None:
    def failures(case: Beams) -> tuple[str, ...]:
        wrong = {"length": case.length < 12e-3, "width": case.width < 15e-3}
        return tuple(name for name, failing in wrong.items() if failing)

    assert remedies(Beams(), [LENGTH, WIDTH], failures) == (
        "raise length from 10 to 12 mm and raise width from 10 to ≥ 15 mm",
    )


def test_a_number_may_be_far_off() -> None:

    def failures(case: Beams, least: float = 100e-3) -> tuple[str, ...]:
        return () if case.length >= least else ("length",)

    assert remedies(Beams(), [LENGTH], failures) == ()
    assert far_remedies(Beams(), [LENGTH], failures) == ("raise length from 10 to ≥ 100 mm",)
    assert far_remedies(Beams(), [LENGTH], lambda case: failures(case, 10.0)) == ()


def test_nothing_is_to_be_changed_where_nothing_fails() -> None:
    """Also not where every change would break something."""
    assert remedies(Beams(), [LENGTH], lambda _: ()) == ()
    assert remedies(Beams(), [LENGTH], lambda case: () if case == Beams() else ("other",)) == ()


def test_the_last_of_a_count_is_never_taken_away() -> None:
    tried = []

    def failures(case: Beams) -> tuple[str, ...]:
        tried.append(case.count)
        return () if case.count == 0 else ("too many",)

    assert remedies(Beams(), [COUNT], failures) == ()
    assert min(tried) == 1


def test_one_number_may_be_turned_to_make_room_for_the_next() -> None:
    """A turn may trade two failures for another one, which the next turn cures."""

    def failures(case: Beams) -> tuple[str, ...]:
        short = case.length < 12e-3
        wrong = {"length": short, "tip": short, "width": not short and case.width < 15e-3}
        return tuple(name for name, failing in wrong.items() if failing)

    assert remedies(Beams(), [LENGTH, WIDTH], failures) == (
        "raise length from 10 to 12 mm and raise width from 10 to ≥ 15 mm",
    )


def test_a_number_that_is_not_given_is_not_turned() -> None:
    case = replace(Beams(), width=0.0)
    assert remedies(case, [WIDTH], lambda _: ("wide",)) == ()
