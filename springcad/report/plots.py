"""Plots of the report as inline SVG: axes with round numbers, curves, a limit line.

The SVG holds no colours: its classes are coloured by the style sheet of the page, so that a plot
follows a dark or a light page and prints well. Its legend stands outside, in the page.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from html import escape
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from springcad.report.display import display_unit, format_value, printable, typeset
from springcad.result import Plot, Scale, Series

_WIDTH, _HEIGHT = 480, 300
_LEFT, _RIGHT, _TOP, _BOTTOM = 62, 456, 12, 252
_COLOURS = 6
_TICKS = 6
_FEW_DECADES = 4


class LegendEntry(NamedTuple):
    """A curve's ``label`` and the CSS classes that draw it."""

    label: str
    classes: str


@dataclass(frozen=True)
class Axis:
    """Maps numbers between ``ticks[0]`` and ``ticks[-1]`` to pixels ``start`` to ``end``."""

    ticks: tuple[float, ...]
    start: float
    end: float
    scale: Scale = "linear"

    def pixels(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        low, high = self.ticks[0], self.ticks[-1]
        if self.scale == "log":
            values, low, high = np.log10(values), math.log10(low), math.log10(high)
        return self.start + (values - low) / (high - low) * (self.end - self.start)

    def pixel(self, value: float) -> float:
        return float(self.pixels(np.array(value)))

    def labels(self) -> Iterator[tuple[float, str]]:
        if self.scale == "log":
            yield from ((self.pixel(tick), f"{tick:.15g}") for tick in self.ticks)
            return
        step = self.ticks[1] - self.ticks[0]
        decimals = max(0, -math.floor(math.log10(step) + 1e-9))
        if round(step, decimals) != round(step, decimals + 1):
            decimals += 1
        plain = step > 1e-6 and max(map(abs, self.ticks)) < 1e7
        for tick in self.ticks:
            yield self.pixel(tick), typeset(f"{tick:.{decimals}f}" if plain else f"{tick:.3g}")


def legend(plot: Plot) -> list[LegendEntry]:
    """What the page shows beside the plot: its curves and, if there is one, its limit."""
    entries = [
        LegendEntry(series.label, _classes(index, series))
        for index, series in enumerate(plot.series)
    ]
    if plot.limit is not None:
        entries.append(
            LegendEntry(f"limit {typeset(format_value(plot.limit, plot.y_unit))}", "limit")
        )
    return entries


def plot_svg(plot: Plot, identifier: str) -> str:
    """``plot`` as an SVG element; ``identifier`` makes its ids unique on the page."""
    x_scale, _ = display_unit(plot.x_unit)
    y_scale, _ = display_unit(plot.y_unit)
    curves = [_finite_parts(s, x_scale, y_scale, plot.y_scale) for s in plot.series]
    points = [part for parts in curves for part in parts]
    limits = [] if plot.limit is None else [np.array([plot.limit * y_scale])]
    x_axis = Axis(_axis_ticks([p[:, 0] for p in points]), _LEFT, _RIGHT)
    y_values = [*(p[:, 1] for p in points), *limits]
    y_ticks = log_ticks(y_values) if plot.y_scale == "log" else _axis_ticks(y_values)
    y_axis = Axis(y_ticks, _BOTTOM, _TOP, plot.y_scale)
    x_text, y_text = _with_unit(plot.x_label, plot.x_unit), _with_unit(plot.y_label, plot.y_unit)
    body = [*grid(x_axis, y_axis), *titles(x_axis, y_axis, x_text, y_text)]
    for index, (series, parts) in enumerate(zip(plot.series, curves, strict=True)):
        body += [_curve(part, x_axis, y_axis, _classes(index, series)) for part in parts]
    if plot.limit is not None:
        y = y_axis.pixel(plot.limit * y_scale)
        body.append(f'<path class="limit" d="M{_LEFT} {y:.2f}H{_RIGHT}"/>')
    return "\n".join(
        [
            f'<svg class="plot" viewBox="0 0 {_WIDTH} {_HEIGHT}" role="img"'
            f' aria-labelledby="{identifier}-title {identifier}-desc">',
            f'<title id="{identifier}-title">{_safe(plot.title)}</title>',
            f'<desc id="{identifier}-desc">{_safe(_description(plot))}</desc>',
            *body,
            "</svg>",
        ]
    )


def _finite_parts(
    series: Series, x_scale: float, y_scale: float, scale: Scale
) -> list[NDArray[np.float64]]:
    """The points (N, 2) in display units, cut where a value is missing or cannot be shown."""
    points = np.column_stack([series.x * x_scale, series.y * y_scale])
    if scale == "log":
        points[points[:, 1] <= 0.0] = np.nan
    finite = np.isfinite(points).all(axis=1)
    parts = np.split(points, np.flatnonzero(np.diff(finite)) + 1)
    return [part for part in parts if part.size and np.isfinite(part).all()]


def _axis_ticks(values: Iterable[NDArray[np.float64]]) -> tuple[float, ...]:
    """Round ticks around all ``values``; from zero where they are far from it on one side."""
    all_values = np.concatenate([np.empty(0), *values])
    if not all_values.size:
        return nice_ticks(0.0, 1.0)
    low, high = float(all_values.min()), float(all_values.max())
    if 0 < low < high / 2:
        low = 0.0
    if low / 2 < high < 0:
        high = 0.0
    return nice_ticks(low, high)


def nice_ticks(low: float, high: float) -> tuple[float, ...]:
    """Ticks at multiples of 1, 2, 2.5 or 5 times a power of ten that enclose ``low`` to ``high``.

    A range without width is widened about its value.
    """
    smallest_span = 1e-9 * max(abs(low), abs(high))
    if high - low <= smallest_span:
        margin = 0.05 * abs(high) or 1.0
        low, high = low - margin, high + margin
    rough = (high - low) / _TICKS
    power = 10.0 ** math.floor(math.log10(rough))
    step = power * next(m for m in (1, 2, 2.5, 5, 10) if rough <= m * power * (1 + 1e-9))
    first, last = math.floor(low / step + 1e-9), math.ceil(high / step - 1e-9)
    return tuple(index * step for index in range(first, last + 1))


def log_ticks(values: Iterable[NDArray[np.float64]]) -> tuple[float, ...]:
    """Ticks at 1, 2 and 5 times powers of ten, or at powers alone, that enclose ``values`` (> 0).

    ``values`` that do not fill a step are widened to one.
    """
    all_values = np.concatenate([np.empty(0), *values])
    if not all_values.size:
        return (1.0, 10.0)
    low, high = float(all_values.min()) * (1 + 1e-9), float(all_values.max()) * (1 - 1e-9)
    decades = range(math.floor(math.log10(low)), math.floor(math.log10(high)) + 2)
    mantissas = (1, 2, 5) if len(decades) <= _FEW_DECADES else (1,)
    steps = [float(f"{m}e{n}") for n in decades for m in mantissas]
    first = max(index for index, step in enumerate(steps) if step <= low)
    last = min(index for index, step in enumerate(steps) if step >= high)
    return tuple(steps[first : max(last, first + 1) + 1])


def grid(x_axis: Axis, y_axis: Axis) -> Iterator[str]:
    """Lines and numbers at the ticks of both axes, and the axes."""
    left, right, top, bottom = x_axis.start, x_axis.end, y_axis.end, y_axis.start
    for x, text in x_axis.labels():
        yield f'<path class="grid" d="M{x:.2f} {top}V{bottom}"/>'
        yield f'<text class="tick" x="{x:.2f}" y="{bottom + 17}">{text}</text>'
    for y, text in y_axis.labels():
        yield f'<path class="grid" d="M{left} {y:.2f}H{right}"/>'
        yield f'<text class="tick y" x="{left - 7}" y="{y + 4:.2f}">{text}</text>'
    x_zero = x_axis.pixel(0.0) if 0.0 in x_axis.ticks else left
    y_zero = y_axis.pixel(0.0) if 0.0 in y_axis.ticks else bottom
    yield f'<path class="axis" d="M{left} {y_zero:.2f}H{right}M{x_zero:.2f} {top}V{bottom}"/>'


def titles(x_axis: Axis, y_axis: Axis, x_text: str, y_text: str) -> Iterator[str]:
    """What the axes show, under the numbers along x and at the left of those along y."""
    middle_x, middle_y = (x_axis.start + x_axis.end) / 2, (y_axis.start + y_axis.end) / 2
    below = y_axis.start + 38
    yield f'<text class="label" x="{middle_x:g}" y="{below}">{_safe(x_text)}</text>'
    place = f"translate(14 {middle_y:g}) rotate(-90)"
    yield f'<text class="label" transform="{place}">{_safe(y_text)}</text>'


def _curve(points: NDArray[np.float64], x_axis: Axis, y_axis: Axis, classes: str) -> str:
    xs, ys = x_axis.pixels(points[:, 0]), y_axis.pixels(points[:, 1])
    if len(points) == 1:
        return f'<circle class="{classes} point" cx="{xs[0]:.2f}" cy="{ys[0]:.2f}" r="3.5"/>'
    path = "L".join(f"{x:.2f} {y:.2f}" for x, y in zip(xs, ys, strict=True))
    return f'<path class="{classes}" d="M{path}"/>'


def _classes(index: int, series: Series) -> str:
    return f"curve c{index % _COLOURS}" + (" dashed" if series.dashed else "")


def _description(plot: Plot) -> str:
    x_text, y_text = _with_unit(plot.x_label, plot.x_unit), _with_unit(plot.y_label, plot.y_unit)
    return f"{y_text} over {x_text}: " + "; ".join(entry.label for entry in legend(plot))


def _with_unit(label: str, unit: str) -> str:
    shown = typeset(display_unit(unit).label)
    return f"{label} ({shown})" if shown else label


def _safe(text: str) -> str:
    return escape(printable(text))
