"""The ring and the camshaft as parts to be cut, with their dimensions."""

from __future__ import annotations

import math
from collections.abc import Iterator

from springcad.kinds.rotary_flexure.spring import Spring
from springcad.result import Dimension, Part


def parts(spring: Spring) -> tuple[Part, ...]:
    """Ring and camshaft; the camshaft drawn as finely as its torque asks for."""
    title = spring.spec.material.values.title
    stack = spring.stack
    return (
        Part(
            "", "flexure ring", spring.ring, stack.sheet, title,
            dimensions=(
                _radius("outer", spring.case.outer_radius, 40.0),
                _radius("root", spring.law.inputs.root_radius, 130.0),
                _radius("contact", spring.law.inputs.contact_radius, 220.0),
            ),
            count=stack.sheets,
        ),
        Part(
            "camshaft", "camshaft", spring.camshaft.profile, stack.camshaft_length, title,
            spring.camshaft.tolerance, tuple(_camshaft_dimensions(spring)), stack.series,
        ),
    )  # fmt: skip


def _camshaft_dimensions(spring: Spring) -> Iterator[Dimension]:
    yield _radius("tip", spring.camshaft.slot.tip_radius, 40.0)
    yield _radius("slot", spring.camshaft.slot.bottom_radius, 130.0)
    if spring.camshaft_inputs.bore_radius > 0.0:
        yield _radius("bore", spring.camshaft_inputs.bore_radius, 220.0)


def _radius(label: str, value: float, degrees: float) -> Dimension:
    at = math.radians(degrees)
    end = (value * math.cos(at), value * math.sin(at))
    return Dimension(label, "radius", (0.0, 0.0), end)
