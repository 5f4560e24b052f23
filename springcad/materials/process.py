"""What a cutting process can make: the smallest web, gap and inside radius."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Process:
    """Shop rules of a cutting process, lengths in metres.

    Attributes:
        name: as in the spec.
        title: for people.
        min_web: narrowest material that is left standing.
        min_gap: narrowest slot that can be cut.
        min_inside_radius: smallest radius of an inside corner.
        source: where the three numbers come from.
    """

    name: str
    title: str
    min_web: float
    min_gap: float
    min_inside_radius: float
    source: str


_OWN = "springcad's default, on the safe side; confirm it with the shop"

PROCESSES = {
    process.name: process
    for process in (
        Process(
            name="wire-edm",
            title="wire electrical discharge machining",
            min_web=0.3e-3,
            min_gap=0.3e-3,
            min_inside_radius=0.15e-3,
            source=f"{_OWN}: wire of 0.25 mm with a spark gap of 0.025 mm on each side",
        ),
        Process(
            name="laser",
            title="laser cutting",
            min_web=1.0e-3,
            min_gap=0.5e-3,
            min_inside_radius=0.25e-3,
            source=f"{_OWN}: kerf of 0.2 to 0.4 mm, web above the heat-affected zone of both sides",
        ),
        Process(
            name="waterjet",
            title="abrasive waterjet cutting",
            min_web=1.5e-3,
            min_gap=1.2e-3,
            min_inside_radius=0.6e-3,
            source=f"{_OWN}: jet of 0.8 to 1.1 mm with taper",
        ),
        Process(
            name="milling",
            title="milling with an end mill of 2 mm",
            min_web=0.8e-3,
            min_gap=2.1e-3,
            min_inside_radius=1.05e-3,
            source=f"{_OWN}: end mill of 2 mm and 0.05 mm of run-out",
        ),
    )
}
"""Name in the spec → rules."""


def process(name: str) -> Process:
    """The shop rules of ``name``; KeyError for an unknown name."""
    return PROCESSES[name]
