"""Materials over modulus and stress, with lines of equal sigma^3/E^2, as an SVG file of its own.

As Fig. 6 of paper 000. Both axes are logarithmic, so that the lines are straight.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Sequence
from html import escape
from typing import NamedTuple

import numpy as np

from springcad.materials.data import Family
from springcad.materials.ranking import Ranked, Ranking
from springcad.report.display import display_unit
from springcad.report.plots import Axis, grid, log_ticks, titles

_WIDTH, _HEIGHT = 760, 520
_LEFT, _RIGHT, _TOP, _BOTTOM = 66, 690, 62, 470
_CHARACTER, _LINE, _GAP = 6.5, 13, 8
_MPA = display_unit("Pa").scale
_COLOURS: dict[Family, str] = {
    "steel": "#0b5394",
    "copper alloy": "#c2500c",
    "aluminium alloy": "#3c434a",
    "titanium alloy": "#80489b",
    "polymer": "#16795a",
}
_STYLE = """
svg { background: #ffffff; font-family: Helvetica, Arial, "Liberation Sans", sans-serif; }
text { fill: #1d2329; font-size: 12px; }
.tick { fill: #5a646e; text-anchor: middle; } .tick.y { text-anchor: end; }
.label { text-anchor: middle; font-size: 13px; } .title { font-size: 14px; }
.grid, .axis, .equal, .range, .leader { fill: none; }
.grid { stroke: #e4e8ec; } .axis { stroke: #5a646e; stroke-width: 1.25; }
.equal { stroke: #9aa5b0; stroke-dasharray: 6 4; } .equal-label { fill: #5a646e; }
.range { stroke-width: 2; } .leader { stroke: #9aa5b0; stroke-width: .75; }
"""


class _Box(NamedTuple):
    """Left, right, top and bottom of what must not be written over, in pixels."""

    left: float
    right: float
    top: float
    bottom: float

    def overlaps(self, other: _Box) -> bool:
        across = self.left < other.right and other.left < self.right
        return across and self.top < other.bottom and other.top < self.bottom


def material_chart(ranking: Ranking) -> str:
    """``ranking`` as an SVG document: a dot for the stress in use, a line for its range."""
    x_axis = Axis(
        log_ticks([np.array([entry.modulus * _MPA for entry in ranking.ranked])]),
        _LEFT, _RIGHT, "log",
    )  # fmt: skip
    y_axis = Axis(
        log_ticks([np.array([s * _MPA for entry in ranking.ranked for s in entry.stress_range])]),
        _BOTTOM, _TOP, "log",
    )  # fmt: skip
    stress = "yield" if ranking.cycles is None else f"fatigue at {ranking.cycles:g} cycles"
    title = "sigma^3/E^2: energy and stiffness of a leaf of given width, length and deflection"
    return "\n".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {_WIDTH} {_HEIGHT}"'
            f' width="{_WIDTH}" height="{_HEIGHT}" role="img">',
            f"<title>{escape(title)}</title>",
            f"<style>{_STYLE}</style>",
            f'<text class="title" x="{_LEFT}" y="20">{escape(title)}</text>',
            *_family_key(ranking.ranked),
            *grid(x_axis, y_axis),
            *titles(x_axis, y_axis, "modulus in bending (MPa)", f"stress: {stress} (MPa)"),
            *_lines_of_equal_metric(ranking.ranked, x_axis, y_axis),
            *_materials(ranking.ranked, x_axis, y_axis),
            "</svg>\n",
        ]
    )


def _family_key(ranked: Sequence[Ranked]) -> Iterator[str]:
    x: float = _LEFT + 5
    present = {entry.material.family for entry in ranked}
    for family, colour in _COLOURS.items():
        if family in present:
            yield f'<circle cx="{x:g}" cy="38" r="4" fill="{colour}"/>'
            yield f'<text x="{x + 8:g}" y="42">{family}</text>'
            x += 24 + _CHARACTER * len(family)


def _lines_of_equal_metric(ranked: Sequence[Ranked], x_axis: Axis, y_axis: Axis) -> Iterator[str]:
    """sigma = (m E^2)^(1/3) for the powers of ten around the materials, cut at the frame."""
    powers = [math.log10(end) for entry in ranked for end in entry.leaf_metric_range]
    first, last = math.floor(min(powers, default=0.0)), math.ceil(max(powers, default=0.0))
    stresses = np.array([y_axis.ticks[0], y_axis.ticks[-1]])
    for power in range(first, last + 1):
        metric = 10.0**power * _MPA
        moduli = np.sqrt(stresses**3 / metric).clip(x_axis.ticks[0], x_axis.ticks[-1])
        if moduli[0] == moduli[1]:  # passes by a corner
            continue
        (x0, x1), (y0, y1) = x_axis.pixels(moduli), y_axis.pixels(np.cbrt(metric * moduli**2))
        yield f'<path class="equal" d="M{x0:.2f} {y0:.2f}L{x1:.2f} {y1:.2f}"/>'
        x, y = (x1 - 20, _TOP - 5) if y1 < _TOP + 1 else (_RIGHT + 5, y1 + 4)
        yield f'<text class="equal-label" x="{x:.2f}" y="{y:.2f}">{10.0**power / 1e3:g} kPa</text>'


def _materials(ranked: Sequence[Ranked], x_axis: Axis, y_axis: Axis) -> Iterator[str]:
    """Ranges, dots and names; the names from top to bottom, each at the nearest free place."""
    names, taken = [], []
    for entry in ranked:
        x, y = x_axis.pixel(entry.modulus * _MPA), y_axis.pixel(entry.stress * _MPA)
        low, high = (y_axis.pixel(stress * _MPA) for stress in entry.stress_range)
        colour = _COLOURS[entry.material.family]
        yield f'<path class="range" stroke="{colour}" d="M{x:.2f} {low:.2f}V{high:.2f}"/>'
        yield f'<circle cx="{x:.2f}" cy="{y:.2f}" r="4" fill="{colour}"/>'
        names.append((y, x, entry.material.name))
        taken += [_Box(x - 4, x + 4, y - 4, y + 4), _Box(x - 1, x + 1, high, low)]
    for y, x, name in sorted(names):
        box = _free_box(x, y, _CHARACTER * len(name), taken)
        taken.append(box)
        middle = (box.top + box.bottom) / 2
        if middle - y > _LINE / 3:
            side = box.left - 1 if box.left > x else box.right + 1
            yield f'<path class="leader" d="M{x:.2f} {y:.2f}L{side:.2f} {middle:.2f}"/>'
        yield f'<text x="{box.left:.2f}" y="{middle + 4:.2f}">{escape(name)}</text>'


def _free_box(x: float, y: float, width: float, taken: Sequence[_Box]) -> _Box:
    """The place of a line of text that overlaps nothing: right or left of (x, y), or lower."""
    for middle in itertools.count(y):
        for left in (x + _GAP, x - _GAP - width):
            box = _Box(left, left + width, middle - _LINE / 2, middle + _LINE / 2)
            if not any(box.overlaps(other) for other in taken):
                return box
    raise AssertionError("a line of text finds room below all others")
