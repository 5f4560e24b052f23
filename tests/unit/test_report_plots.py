"""Plots: round ticks around the data, every curve and limit inside the frame, gaps left open."""

from __future__ import annotations

import dataclasses
import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from report_example import example_result

from springcad.report.plots import legend, log_ticks, nice_ticks, plot_svg
from springcad.result import Plot, Series

FRAME_X, FRAME_Y = (62, 456), (12, 252)


def curves(svg, kind="curve"):
    """Points (N, 2) in pixels of each path of the class ``kind``."""
    paths = [e.get("d") for e in ET.fromstring(svg).iter("path") if kind in e.get("class").split()]
    return [np.array(re.findall(r"-?[\d.]+", d), dtype=float).reshape(-1, 2) for d in paths]


def tick_labels(svg):
    """Texts along x and along y, the minus sign of print as a hyphen."""
    texts = [e for e in ET.fromstring(svg).iter("text") if "tick" in e.get("class")]
    split = {True: [], False: []}
    for e in texts:
        split["y" in e.get("class").split()].append(e.text.replace("\N{MINUS SIGN}", "-"))
    return split[False], split[True]


def line(x, y, limit=None, **units):
    units = {"x_unit": "rad", "y_unit": "Pa"} | units
    series = (Series("curve", np.asarray(x, float), np.asarray(y, float)),)
    return Plot("t", "x", units["x_unit"], "y", units["y_unit"], series, limit)


@given(
    st.floats(-1e9, 1e9).filter(lambda x: x == 0 or abs(x) > 1e-9),
    st.floats(1e-6, 1e9),
)
def test_ticks_are_few_round_evenly_spaced_and_enclose_the_data(low, span):
    high = low + span
    ticks = nice_ticks(low, high)
    steps = np.diff(ticks)
    step = steps.mean()
    slack = 1e-6 * max(step, abs(low), abs(high))
    assert ticks[0] <= low + slack
    assert ticks[-1] >= high - slack
    assert 2 <= len(ticks) <= 10
    assert steps == pytest.approx(step, rel=1e-6, abs=slack)
    mantissa = step / 10 ** np.floor(np.log10(step * (1 + 1e-6)))
    assert min(abs(mantissa - m) for m in (1, 2, 2.5, 5)) < 1e-5


def test_a_constant_is_drawn_in_the_middle_of_an_axis_of_its_own():
    ticks = nice_ticks(5.0, 5.0)
    assert ticks[0] < 5.0 < ticks[-1]
    assert nice_ticks(0.0, 0.0)[0] < 0.0 < nice_ticks(0.0, 0.0)[-1]


def test_axes_are_labelled_in_degrees_and_megapascals():
    angle = np.radians(np.linspace(-14.5, 14.5, 5))
    svg = plot_svg(line(angle, [900e6, 400e6, 0.0, 400e6, 900e6]), "p")
    x, y = tick_labels(svg)
    assert x == ["-15", "-10", "-5", "0", "5", "10", "15"]
    assert y == ["0", "200", "400", "600", "800", "1000"]
    labels = [e.text for e in ET.fromstring(svg).iter("text") if e.get("class") == "label"]
    assert labels == ["x (deg)", "y (MPa)"]


def test_quarter_steps_show_the_decimals_they_need():
    _, y = tick_labels(plot_svg(line([0, 1], [0, 1.5], y_unit="J"), "p"))
    assert y == ["0.00", "0.25", "0.50", "0.75", "1.00", "1.25", "1.50"]


def test_a_point_of_the_curve_stands_where_the_axes_say():
    svg = plot_svg(line(np.radians([0, 10, 20, 30]), [0, 2e6, 4e6, 6e6]), "p")
    (points,) = curves(svg)
    assert points[:, 0] == pytest.approx(np.linspace(*FRAME_X, 4), abs=0.01)
    assert points[:, 1] == pytest.approx(np.linspace(*FRAME_Y[::-1], 4), abs=0.01)


@pytest.mark.parametrize("index", range(3))
def test_all_curves_and_the_limit_lie_inside_the_frame(index):
    plot = example_result().plots[index]
    svg = plot_svg(plot, "p")
    drawn = curves(svg)
    assert len(drawn) == len(plot.series)
    points = np.concatenate(drawn)
    assert ((points[:, 0] >= FRAME_X[0]) & (points[:, 0] <= FRAME_X[1])).all()
    assert ((points[:, 1] >= FRAME_Y[0]) & (points[:, 1] <= FRAME_Y[1])).all()
    heights = re.findall(r'class="limit" d="M62 ([\d.]+)H456"', svg)
    assert len(heights) == (plot.limit is not None)
    assert all(FRAME_Y[0] <= float(h) <= FRAME_Y[1] for h in heights)


def test_a_limit_far_above_the_curve_is_still_shown():
    svg = plot_svg(line([0, 1], [1e6, 2e6], limit=100e6), "p")
    assert tick_labels(svg)[1][-1] == "100"


def test_missing_values_leave_a_gap_and_a_lone_point_is_marked():
    svg = plot_svg(line([0, 1, 2, 3, 4], [1, 2, np.nan, 3, np.inf]), "p")
    assert [len(points) for points in curves(svg)] == [2]
    assert svg.count("<circle") == 1
    assert "nan" not in svg
    assert "inf" not in svg


@pytest.mark.parametrize("y", [[], [np.nan], [0.0]])
def test_a_plot_with_next_to_no_data_is_still_a_plot(y):
    ET.fromstring(plot_svg(line(np.zeros(len(y)), y), "p"))


def test_the_legend_tells_curves_apart_and_names_the_limit():
    torque, stress, _ = example_result().plots
    assert [entry.classes for entry in legend(torque)] == ["curve c0", "curve c1 dashed"]
    assert legend(stress)[-1] == ("limit 1350\N{NO-BREAK SPACE}MPa", "limit")


def test_a_plot_tells_its_content_to_those_who_cannot_see_it():
    root = ET.fromstring(plot_svg(example_result().plots[0], "plot-1"))
    assert root.get("role") == "img"
    assert root.get("aria-labelledby") == "plot-1-title plot-1-desc"
    assert root.find("title").text == "Torque over angle, both directions"
    assert root.find("desc").text == (
        "torque (N\N{MIDDLE DOT}m) over angle (deg): computed; target, 150 N*m/rad"
    )


def test_texts_are_escaped():
    series = (Series("<b>", np.zeros(2), np.arange(2.0)),)
    plot = Plot("<script>", "a & b", "rad", '"y"', "</svg>", series)
    root = ET.fromstring(plot_svg(plot, "p"))
    assert root.find("title").text == "<script>"


@given(st.floats(1e-6, 1e8), st.floats(1.0, 1e8))
def test_logarithmic_ticks_are_round_and_enclose_the_data(low, ratio):
    ticks = log_ticks([np.array([low, low * ratio])])
    assert ticks[0] <= low * (1 + 1e-8)
    assert ticks[-1] >= low * ratio * (1 - 1e-8)
    assert 2 <= len(ticks) <= 17
    mantissas = {f"{tick:e}".split("e")[0] for tick in ticks}
    assert mantissas <= {"1.000000", "2.000000", "5.000000"}


def test_equal_ratios_are_equally_far_apart_on_a_logarithmic_axis():
    plot = line([0, 1, 2, 3], [1e6, 1e7, 0.0, 1e9])
    svg = plot_svg(dataclasses.replace(plot, y_scale="log"), "p")
    assert tick_labels(svg)[1] == ["1", "2", "5", "10", "20", "50", "100", "200", "500", "1000"]
    (points,) = curves(svg)
    assert points[:, 1] == pytest.approx([252, 172], abs=0.01)
    assert 'cy="12.00"' in svg
