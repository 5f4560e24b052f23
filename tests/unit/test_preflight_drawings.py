"""Any drawing is read as a shop would: what is wrong is said, damaged files get one clear line."""

from __future__ import annotations

import math
import os
import random
from dataclasses import dataclass

import ezdxf
import pytest
from ezdxf import units
from geometry_shapes import finger_ring, on_circle, toothed_shaft

from springcad.export.dxf import part_to_dxf
from springcad.geometry.clearance import smallest_gap, smallest_web
from springcad.geometry.polyline import signed_area
from springcad.result import Part
from springcad.verify.drawing import LARGEST_FILE, DrawingError, read_drawing
from springcad.verify.preflight import preflight


@dataclass(frozen=True)
class Rule:
    name: str = "wire-edm"
    min_web: float = 0.3e-3
    min_gap: float = 0.3e-3
    min_inside_radius: float = 0.15e-3


class Sheet:
    """A drawing under construction; ``checks`` saves it and looks at it."""

    def __init__(self, folder, unit=units.MM):
        self.path = folder / "drawing.dxf"
        self.document = ezdxf.new("R2010", units=unit)
        self.space = self.document.modelspace()

    def square(self, size=10.0, at=(0.0, 0.0), layer="CUT_OUTER"):
        x, y = at
        corners = [(x, y), (x + size, y), (x + size, y + size), (x, y + size)]
        self.space.add_lwpolyline(corners, close=True, dxfattribs={"layer": layer})
        return self

    def checks(self, rule=None):
        self.document.saveas(self.path)
        return {item.name: item for item in preflight(self.path, rule)}


@pytest.fixture
def sheet(tmp_path):
    return Sheet(tmp_path)


def failing(checks):
    return {name for name, item in checks.items() if item.status == "fail"}


def write(path, profile):
    path.write_text(part_to_dxf(Part("", "part", profile, 4.5e-3, "steel")), encoding="utf-8")
    return path


def test_what_springcad_writes_passes_and_measures_like_the_model(tmp_path):
    model = finger_ring(fitted=True)
    checks = {c.name: c for c in preflight(write(tmp_path / "a.dxf", model), Rule())}
    # The roots of this ring are sharp on purpose.
    assert failing(checks) == {"smallest inside radius"}
    assert {c.status for c in checks.values()} == {"pass", "fail"}
    assert checks["smallest web"].value == pytest.approx(smallest_web(model).distance, abs=2e-8)
    assert checks["smallest gap"].value == pytest.approx(smallest_gap(model).distance, abs=2e-8)


def test_a_part_that_is_just_wide_enough_passes(sheet):
    sheet.square()
    for y in (0.3, 1.3):
        sheet.space.add_lwpolyline(
            [(2, y), (8, y), (8, y + 0.3), (2, y + 0.3)], close=True, format="xy"
        )
    checks = sheet.checks(Rule(min_inside_radius=0.0))
    assert failing(checks) == set()
    assert checks["smallest web"].value == pytest.approx(0.3e-3, rel=1e-12)
    assert checks["smallest gap"].value == pytest.approx(0.3e-3, rel=1e-12)


def test_widths_below_the_rules_of_the_process_fail_and_say_where(sheet):
    sheet.square()
    sheet.space.add_circle((0.7, 5.0), 0.5)
    sheet.space.add_circle((5.0, 5.0), 0.1)
    checks = sheet.checks(Rule())
    assert failing(checks) == {"smallest web", "smallest gap", "smallest inside radius"}
    assert checks["smallest web"].value == pytest.approx(0.2e-3, abs=1.2e-7)
    assert checks["smallest gap"].value == pytest.approx(0.2e-3, abs=1.2e-7)
    assert checks["smallest inside radius"].value == pytest.approx(0.1e-3, abs=1e-9)
    assert "x = 0." in checks["smallest web"].remedy


def test_without_a_process_widths_are_told_and_nothing_is_demanded(sheet):
    checks = sheet.square().checks()
    assert failing(checks) == set()
    assert checks["smallest web"].value == pytest.approx(10e-3, rel=1e-9)


def test_inches_are_read_as_inches(tmp_path):
    checks = Sheet(tmp_path, units.IN).square(1.0).checks()
    assert failing(checks) == set()
    assert checks["smallest web"].value == pytest.approx(25.4e-3, rel=1e-9)
    assert "inches, 1 drawing unit = 25.4 mm" in checks["length unit stated"].source


@pytest.mark.parametrize("unit", [0, 6, 13])
def test_a_drawing_without_millimetres_or_inches_fails(tmp_path, unit):
    assert failing(Sheet(tmp_path, unit).square().checks()) == {"length unit stated"}


def test_an_open_polyline_fails_with_the_place_of_its_end(sheet):
    sheet.space.add_lwpolyline([(0, 0), (10, 0), (10, 10)])
    checks = sheet.checks()
    assert failing(checks) == {"open ends", "parts in the drawing"}
    assert checks["open ends"].value == 2
    assert "near x = 0.000 mm, y = 0.000 mm" in checks["open ends"].remedy


def test_lines_and_arcs_are_joined_and_it_is_said(sheet):
    sheet.space.add_line((-5, -2), (5, -2))
    sheet.space.add_arc((5, 0), 2, -90, 90)
    sheet.space.add_line((-5, 2), (5.000004, 2))  # 4 nm off and run through backwards
    sheet.space.add_arc((-5, 0), 2, 90, 270)
    checks = sheet.checks(Rule())
    assert failing(checks) == set()
    joined = checks["contours joined from separate entities"]
    assert (joined.status, joined.value) == ("warn", 1.0)
    (contour,) = read_drawing(sheet.path).contours
    assert contour.joined_from == 4
    assert checks["smallest web"].value == pytest.approx(4e-3, rel=1e-6)


def test_ends_that_are_too_far_apart_are_not_joined(sheet):
    sheet.space.add_line((0, 0), (10, 0))
    sheet.space.add_line((10, 0.02), (5, 8))
    sheet.space.add_line((5, 8), (0, 0))
    assert sheet.checks()["open ends"].value == 2


def test_a_fork_is_not_guessed(sheet):
    sheet.square()
    for end in ((20, 0), (25, 5), (20, 10)):
        sheet.space.add_line((22, 5), end)
    checks = sheet.checks()
    assert checks["open ends"].value == 6


def test_a_contour_that_cuts_itself_fails_and_is_not_measured(sheet):
    sheet.space.add_lwpolyline([(0, 0), (10, 10), (10, 0), (0, 8)], close=True)
    checks = sheet.checks(Rule())
    assert failing(checks) == {"contours that cut themselves"}
    assert "smallest web" not in checks


def test_repeated_touching_and_crossing_contours_fail(sheet):
    sheet.square().square().square(5.0, at=(10.0, 0.0)).square(10.0, at=(40.0, 0.0))
    sheet.square(10.0, at=(45.0, 5.0))
    checks = sheet.checks()
    # The two equal squares, each of them with the one that touches, and the two that cross.
    assert checks["pairs of contours that meet, cross or repeat"].value == 4
    assert failing(checks) == {"pairs of contours that meet, cross or repeat"}


def test_layers_are_held_against_the_nesting(sheet):
    sheet.square(layer="CUT_INNER").square(2.0, at=(4.0, 4.0), layer="CUT_OUTER")
    assert sheet.checks()["contours on the wrong layer"].value == 2


def test_other_layers_are_nobodys_business(sheet):
    sheet.square(layer="0").square(2.0, at=(4.0, 4.0), layer="holes")
    assert failing(sheet.checks()) == set()


def test_a_part_within_the_hole_of_another_is_a_part(sheet):
    sheet.square(30.0).square(20.0, at=(5.0, 5.0)).square(10.0, at=(10.0, 10.0))
    checks = sheet.checks()
    assert checks["parts in the drawing"].value == 2
    assert checks["smallest gap"].value == pytest.approx(5e-3, rel=1e-9)


def test_text_points_hatches_and_blocks_are_strays(sheet):
    sheet.square()
    sheet.space.add_text("hello")
    sheet.space.add_point((1, 1))
    sheet.space.add_hatch()
    sheet.document.blocks.new("B")
    sheet.space.add_blockref("B", (0, 0))
    checks = sheet.checks()
    assert failing(checks) == {"entities that are no contour"}
    stray = checks["entities that are no contour"]
    assert stray.value == 4
    assert stray.remedy.endswith("1 HATCH, 1 INSERT, 1 POINT, 1 TEXT")


def test_circles_ellipses_splines_and_old_polylines_are_contours(sheet):
    sheet.square(100.0)
    sheet.space.add_circle((20, 20), 5)
    sheet.space.add_ellipse((50, 20), (8, 0), 0.5)
    sheet.space.add_spline([(70, 70), (80, 70), (80, 80), (70, 80), (70, 70)])
    sheet.space.add_polyline2d([(20, 70), (30, 70), (30, 80)], close=True)
    assert failing(sheet.checks()) == set()
    areas = [abs(signed_area(c.polyline)) for c in read_drawing(sheet.path).contours]
    assert areas[1] == pytest.approx(math.pi * 25e-6, rel=1e-12)
    assert areas[2] == pytest.approx(math.pi * 32e-6, abs=1e-7 * 40e-3)  # chords of 0.1 um
    assert areas[4] == pytest.approx(50e-6, rel=1e-12)


def test_entities_seen_from_below_are_mirrored(sheet):
    sheet.square(40.0, at=(-20.0, -20.0))
    down = {"extrusion": (0, 0, -1)}
    sheet.space.add_circle((10, 5), 2, dxfattribs=down)
    sheet.space.add_lwpolyline(
        [(5, -5, 1.0), (5, -9, 1.0)], format="xyb", close=True, dxfattribs=down
    )
    assert failing(sheet.checks()) == set()
    contours = read_drawing(sheet.path).contours
    assert contours[1].polyline.points[:, 0].mean() == pytest.approx(-10e-3, rel=1e-12)
    assert contours[2].polyline.points[:, 0].mean() == pytest.approx(-5e-3, rel=1e-12)


def test_curves_out_of_the_plane_are_strays(sheet):
    sheet.square()
    sheet.space.add_line((0, 0, 0), (1, 1, 1))
    sheet.space.add_polyline3d([(0, 0, 0), (1, 1, 1), (2, 0, 3)])
    assert sheet.checks()["entities that are no contour"].value == 2


@pytest.mark.parametrize("bad", ["nan", "inf", "1e999", "-1e300"])
def test_numbers_that_are_no_coordinates_make_a_stray(tmp_path, bad):
    path = write(tmp_path / "a.dxf", toothed_shaft())
    path.write_text(path.read_text().replace("\n3.5\n", f"\n{bad}\n"))
    checks = {c.name: c for c in preflight(path)}
    assert checks["entities that are no contour"].value == 1
    assert checks["entities that are no contour"].status == "fail"


def test_a_bore_of_many_chords_is_measured_by_its_shape(sheet):
    sheet.square(10.0, at=(-5.0, -5.0))
    bore = [on_circle(2.0, math.tau * i / 180) for i in range(180)]
    sheet.space.add_lwpolyline(bore, close=True)
    checks = sheet.checks(Rule())
    assert failing(checks) == set()
    assert checks["smallest inside radius"].value == pytest.approx(2e-3, rel=1e-3)
    assert checks["smallest web"].value == pytest.approx(3e-3, rel=1e-3)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "not a readable DXF"),
        (b"hello\nworld\n", "not a readable DXF"),
        (b"%PDF-1.7\n\x00\xff", "binary"),
        (b"AutoCAD Binary DXF\r\n\x1a\x00", "binary"),
        (b"\xff\xfe\xfd" * 100, "not a readable DXF"),
        (b"  0\nSECTION\n  2\nENTITIES\n  0\nLINE\n", "not a readable DXF"),
        (b"0\n" * 200_000, "not a readable DXF"),
        (b"  0\nSECTION\n  2\nHEADER\n  9\n$ACADVER\n  1\nAC9999\n  0\nENDSEC\n  0\nEOF\n", ""),
    ],
)
def test_what_is_no_drawing_gets_one_clear_line(tmp_path, content, words):
    path = tmp_path / "bad.dxf"
    path.write_bytes(content)
    told, checks = looked_at(path)
    assert words in told
    assert told or any(item.status == "fail" for item in checks)


def looked_at(path):
    """The one line that a refused file gets, or the checks of a readable one."""
    try:
        return "", preflight(path)
    except DrawingError as error:
        told, code = str(error), error.exit_code
    assert code == 3
    assert "\n" not in told
    assert len(told) < 300
    return told, ()


def test_missing_huge_and_strange_files_are_refused(tmp_path):
    with pytest.raises(DrawingError, match="no such file"):
        preflight(tmp_path / "none.dxf")
    with pytest.raises(DrawingError, match="not a plain file"):
        preflight(tmp_path)
    os.mkfifo(tmp_path / "pipe.dxf")
    with pytest.raises(DrawingError, match="not a plain file"):
        preflight(tmp_path / "pipe.dxf")
    huge = tmp_path / "huge.dxf"
    with huge.open("wb") as stream:
        stream.truncate(LARGEST_FILE + 1)
    with pytest.raises(DrawingError, match="larger than 8 MiB"):
        preflight(huge)


def test_damaged_drawings_never_end_in_a_traceback(tmp_path):
    path = write(tmp_path / "a.dxf", toothed_shaft())
    lines = path.read_text().split("\n")
    chance = random.Random(1)
    for _ in range(40):
        damaged = list(lines)
        for _ in range(chance.randrange(1, 6)):
            i = chance.randrange(len(damaged))
            damaged[i] = chance.choice(
                ["", "-1", "nan", "0", "LINE", "70", "1e400", damaged[i][:1]]
            )
        path.write_text("\n".join(damaged[: chance.randrange(len(damaged) // 2, len(damaged) + 1)]))
        told, checks = looked_at(path)
        assert told or checks


def test_too_many_contours_are_refused_soon(sheet):
    for i in range(2001):
        sheet.space.add_circle((5.0 * i, 0.0), 1.0)
    with pytest.raises(DrawingError, match="2001 contours"):
        sheet.checks()


def test_a_thousand_ends_in_one_point_are_open_ends(sheet):
    for i in range(1000):
        sheet.space.add_line((0, 0), on_circle(5.0, i * 0.006))
    assert sheet.checks()["open ends"].value == 2000
