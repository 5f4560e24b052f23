"""The drawing is at true size, shows every part and dimension, and takes no text as markup."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import numpy as np
import pytest
from geometry_shapes import finger_ring, polygon, toothed_shaft

from springcad.export.svg import result_to_svg
from springcad.export.svg_dimensions import arrange, dimension_text
from springcad.export.svg_text import number
from springcad.geometry.outline import Arc, Circle, Line, Outline, Profile
from springcad.result import Dimension, Part, Result, Shape, View

SVG = "{http://www.w3.org/2000/svg}"


def result(parts, name="knee-s2", views=()):
    return Result("rotary-flexure", name, {}, {}, {}, (), (), tuple(parts), tuple(views))


def ring(dimensions=(), role="flexure ring", material="AISI 420"):
    return Part("", role, finger_ring(fitted=True), 4.5e-3, material, dimensions=tuple(dimensions))


def shaft(dimensions=()):
    return Part(
        "camshaft", "camshaft", toothed_shaft(), 4.5e-3, "AISI 420", dimensions=tuple(dimensions)
    )


DIMENSIONS = (
    Dimension("rim", "radius", (0.0, 0.0), (20e-3, 26.87e-3)),
    Dimension("root", "radius", (0.0, 0.0), (25e-3, 18.33e-3)),
    Dimension("tip circle", "diameter", (0.0, 0.0), (-8.5e-3, 0.0)),
    Dimension("tip thickness", "linear", (8.5e-3, -0.35e-3), (8.5e-3, 0.35e-3)),
    Dimension("flexure", "linear", (-8.5e-3, 0.0), (-31e-3, 0.0)),
)
BORE = Dimension("bore", "diameter", (0.0, 0.0), (2e-3, 0.0))


def texts(root):
    return ["".join(node.itertext()) for node in root.iter(f"{SVG}text")]


def test_width_and_height_are_the_size_of_the_view_box_in_millimetres():
    root = ElementTree.fromstring(result_to_svg(result([ring(DIMENSIONS), shaft([BORE])])))
    _, _, width, height = root.attrib["viewBox"].split()
    assert root.attrib["width"] == f"{width}mm"
    assert root.attrib["height"] == f"{height}mm"
    assert float(width) > 67.0 + 15.0


def test_the_parts_are_drawn_at_true_size_with_true_arcs():
    stadium = Outline(
        (
            Line((-5e-3, -2e-3), (5e-3, -2e-3)),
            Arc((5e-3, 0.0), 2e-3, -np.pi / 2, np.pi),
            Line((5e-3, 2e-3), (-5e-3, 2e-3)),
            Arc((-5e-3, 0.0), 2e-3, np.pi / 2, np.pi),
        )
    )
    root = ElementTree.fromstring(
        result_to_svg(result([Part("", "pad", Profile(stadium), 1e-3, "x")]))
    )
    (path,) = [p for p in root.iter(f"{SVG}path") if "fill-rule" in p.attrib]
    found = re.fullmatch(
        r"M(\S+) (\S+)L(\S+) (\S+)A2 2 0 0 0 (\S+) (\S+)L(\S+) (\S+)A2 2 0 0 0 (\S+) (\S+)Z",
        path.attrib["d"],
    )
    x0, y0, x1, y1, x2, y2, x3, y3, x4, y4 = map(float, found.groups())
    assert (x1 - x0, y1 - y0) == pytest.approx((10.0, 0.0), abs=1e-9)
    assert (x2 - x1, y2 - y1) == pytest.approx((0.0, -4.0), abs=1e-9)  # y runs downwards
    assert (x3 - x2, y3 - y2) == pytest.approx((-10.0, 0.0), abs=1e-9)
    assert (x4, y4) == (x0, y0)


def test_every_part_is_named_with_its_thickness_material_and_file():
    root = ElementTree.fromstring(result_to_svg(result([ring(), shaft()])))
    assert [group.find(f"{SVG}title").text for group in root.iter(f"{SVG}g")] == [
        "flexure ring",
        "camshaft",
    ]
    assert "4.5 mm AISI 420, knee-s2.dxf" in texts(root)
    assert "4.5 mm AISI 420, knee-s2-camshaft.dxf" in texts(root)


def test_every_dimension_is_told_once_with_its_value():
    root = ElementTree.fromstring(result_to_svg(result([ring(DIMENSIONS), shaft([BORE])])))
    for text in (
        "R33.496 rim",
        "R31 root",
        "\u230017 tip circle",
        "0.7 tip thickness",
        "22.5 flexure",
        "\u23004 bore",
    ):
        assert texts(root).count(text) == 1


def test_a_label_that_states_the_value_stands_alone():
    outer = Dimension("R33.5", "radius", (0.0, 0.0), (33.5e-3, 0.0))
    assert dimension_text(outer) == "R33.5"


def test_a_number_that_only_contains_the_value_does_not_state_it():
    spring = Dimension("lever tilted by 10.08 deg", "linear", (0.0, 0.0), (8e-3, 0.0))
    assert dimension_text(spring) == "8 lever tilted by 10.08 deg"


def test_no_two_dimension_texts_share_a_row_of_their_column():
    crowd = [
        Dimension(f"hole {i}", "diameter", (0.0, 0.0), (1e-3 * (i + 1), 0.0)) for i in range(12)
    ]
    root = ElementTree.fromstring(result_to_svg(result([ring(crowd)])))
    rows = sorted(
        float(node.attrib["y"])
        for node in root.iter(f"{SVG}text")
        if "hole" in "".join(node.itertext())
    )
    assert len(rows) == 12
    assert min(np.diff(rows)) >= 2.4


def test_dimensions_stand_on_the_side_of_their_feature():
    callouts = arrange(DIMENSIONS, 0.0)
    assert {d.label for d in callouts.left} == {"tip circle", "flexure"}
    assert [d.label for d in callouts.right] == ["rim", "root", "tip thickness"]


@pytest.mark.parametrize("text", ["<script>alert(1)</script>", "a\"b'&c", "]]>", "\x00\x1b[31m"])
def test_hostile_names_stay_text(text):
    label = Dimension(text, "radius", (0.0, 0.0), (1e-3, 0.0))
    written = result_to_svg(result([ring([label], text, text)], name=text))
    root = ElementTree.fromstring(written)
    assert not list(root.iter(f"{SVG}script"))
    shown = "".join(c if c >= " " else "\ufffd" for c in text)
    assert root.find(f"{SVG}title").text == shown
    assert shown in texts(root)


def test_the_drawing_needs_no_style_sheet_no_script_and_no_reference():
    written = result_to_svg(result([ring(DIMENSIONS), shaft([BORE])]))
    assert not re.search(r"<style|style=|<script|href|url\(|\bid=", written)


def test_the_same_result_gives_the_same_bytes():
    first, second = (result_to_svg(result([ring(DIMENSIONS), shaft([BORE])])) for _ in range(2))
    assert first == second


def test_numbers_have_at_most_four_decimals_and_no_minus_zero():
    assert [number(x) for x in (-0.00001, 1.0, 0.12345678, -2.5)] == ["0", "1", "0.1235", "-2.5"]
    with pytest.raises(ValueError, match="finite"):
        number(float("nan"))


def test_a_part_that_is_not_finite_is_not_drawn():
    with pytest.raises(ValueError, match="finite"):
        result_to_svg(result([Part("", "x", Profile(Circle((0.0, np.inf), 1e-3)), 1e-3, "x")]))


def test_a_part_without_dimensions_and_a_plain_polygon_are_drawn():
    square = Part("", "plate", Profile(polygon((0, 0), (10, 0), (10, 10), (0, 10))), 1e-3, "x")
    assert "A" not in re.search(r' d="(M[^"]*Z)"', result_to_svg(result([square]))).group(1)


ROLLER = View(
    "at rest",
    (
        Shape(polygon((0, 0), (30, 0), (30, 10), (0, 10)), "part"),
        Shape(Circle((15e-3, 14e-3), 4e-3), "mate"),
        Shape(Circle((15e-3, 12e-3), 4e-3), "moved"),
        Shape(np.array([[-2e-3, 20e-3], [32e-3, 20e-3]]), "limit"),
        Shape(np.array([[-2e-3, 14e-3], [15e-3, 14e-3], [32e-3, 14e-3]]), "axis"),
    ),
    (Dimension("sunk", "linear", (15e-3, 12e-3), (15e-3, 14e-3)),),
)


def view_groups(root):
    return [g for g in root.iter(f"{SVG}g") if g.find(f"{SVG}title").text == ROLLER.title]


def numbers_of(path):
    return [float(x) for x in re.findall(r"-?[0-9.]+", path.attrib["d"])]


def test_views_stand_below_the_parts_at_true_size_with_title_and_dimensions():
    bare = ElementTree.fromstring(result_to_svg(result([ring()])))
    root = ElementTree.fromstring(result_to_svg(result([ring()], views=[ROLLER])))
    (group,) = view_groups(root)
    part, roller, moved, limit, axis = list(group.iter(f"{SVG}path"))[:5]
    assert numbers_of(roller)[2:4] == [4.0, 4.0]  # true arcs, millimetres
    (x0, y0, x1, y1, x2, y2) = numbers_of(axis)
    assert (x1 - x0, x2 - x1) == pytest.approx((17.0, 17.0), abs=1e-9)
    assert y0 == y1 == y2
    assert "Z" not in axis.attrib["d"]
    assert numbers_of(limit)[1] == pytest.approx(y0 - 6.0, abs=1e-9)  # y runs downwards
    assert numbers_of(moved)[1] == pytest.approx(numbers_of(roller)[1] + 2.0, abs=1e-9)
    assert texts(root).count("at rest") == texts(root).count("2 sunk") == 1
    height = float(root.attrib["height"][:-2])
    assert height > float(bare.attrib["height"][:-2]) + 20.0
    (ring_path,) = [p for p in bare.iter(f"{SVG}path") if "fill-rule" in p.attrib]
    assert min(numbers_of(part)[1::2]) > 8.0 + 12.0 + 67.0
    assert ring_path.attrib["d"] in {p.attrib.get("d") for p in root.iter(f"{SVG}path")}


def test_roles_are_told_apart_by_line_and_tone_without_colour():
    root = ElementTree.fromstring(result_to_svg(result([ring()], views=[ROLLER])))
    (group,) = view_groups(root)
    part, mate, moved, limit, axis = list(group.iter(f"{SVG}path"))[:5]
    dashes = [p.attrib.get("stroke-dasharray") for p in (part, mate, moved, limit, axis)]
    assert dashes[:2] == [None, None]
    assert len(set(dashes[2:])) == 3
    assert {p.attrib["fill"] for p in (moved, limit, axis)} == {"none"}
    assert "none" not in {part.attrib["fill"], mate.attrib["fill"]}
    assert part.attrib["fill"] != mate.attrib["fill"]


def test_a_part_in_a_view_shows_its_holes():
    plate = Profile(Circle((0.0, 0.0), 5e-3), (Circle((0.0, 0.0), 2e-3),))
    view = View("at rest", (Shape(plate, "part"),))
    (group,) = view_groups(ElementTree.fromstring(result_to_svg(result([ring()], views=[view]))))
    assert group.find(f"{SVG}path").attrib["d"].count("Z") == 2
    assert group.find(f"{SVG}path").attrib["fill-rule"] == "evenodd"


@pytest.mark.parametrize(("count", "rows"), [(1, 1), (3, 1), (8, 2)])
def test_views_go_on_in_a_new_row_where_the_sheet_ends(count, rows):
    root = ElementTree.fromstring(result_to_svg(result([ring()], views=[ROLLER] * count)))
    tops = {numbers_of(group.find(f"{SVG}path"))[1] for group in view_groups(root)}
    assert len(view_groups(root)) == count
    assert len(tops) == rows
    width, height = (float(root.attrib[side][:-2]) for side in ("width", "height"))
    for group in view_groups(root):
        corners = numbers_of(group.find(f"{SVG}path"))
        assert 4.0 < min(corners[::2]) < max(corners[::2]) < width - 4.0
        assert max(corners[1::2]) < height - 13.0


def test_a_caption_wider_than_what_it_names_stays_on_the_sheet():
    view = View(
        "a title much longer than the roller is wide", (Shape(ROLLER.shapes[1].line, "mate"),)
    )
    root = ElementTree.fromstring(result_to_svg(result([], views=[view])))
    (title,) = [t for t in root.iter(f"{SVG}text") if t.text == view.title]
    half = 0.5 * 0.6 * 3.0 * len(view.title)
    assert half + 4.0 < float(title.attrib["x"]) < float(root.attrib["width"][:-2]) - half - 4.0


def test_rsvg_renders_it(tmp_path, require_tool):
    import subprocess

    source, target = tmp_path / "drawing.svg", tmp_path / "drawing.png"
    source.write_text(result_to_svg(result([ring(DIMENSIONS), shaft([BORE])])), encoding="utf-8")
    subprocess.run([require_tool("rsvg-convert"), source, "-o", target], check=True)
    assert target.read_bytes().startswith(b"\x89PNG")
