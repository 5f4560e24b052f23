"""The drawing says what the part is: contours, layers, units, exact arcs, the same bytes."""

from __future__ import annotations

import io
import locale
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from ezdxf.filemanagement import read
from geometry_shapes import finger_ring, polygon, toothed_shaft

from springcad.export.dxf import drawing_vertices, part_to_dxf
from springcad.geometry.biarc import fit_outline
from springcad.geometry.outline import Arc, Circle, Line, Outline, Profile
from springcad.geometry.outline_ops import contour_area, contour_length
from springcad.geometry.polyline import BulgePolyline, length, signed_area
from springcad.result import Part


def part(profile, role="flexure ring"):
    return Part("", role, profile, 4.5e-3, "aisi-420")


def opened(profile):
    return read(io.StringIO(part_to_dxf(part(profile))))


def drawn(entity):
    table = np.array(entity.get_points("xyb"))
    return BulgePolyline(table[:, :2] * 1e-3, table[:, 2])


@pytest.fixture(scope="module")
def ring_text():
    return part_to_dxf(part(finger_ring(fitted=True)))


def test_the_audit_is_clean_and_the_units_are_millimetres(ring_text):
    document = read(io.StringIO(ring_text))
    audit = document.audit()
    assert not audit.errors
    assert not audit.fixes
    assert document.dxfversion == "AC1024"
    assert document.header["$INSUNITS"] == 4
    assert document.header["$MEASUREMENT"] == 1


def test_there_are_two_layers_and_nothing_but_contours(ring_text):
    document = read(io.StringIO(ring_text))
    assert "Defpoints" not in ring_text
    assert {"CUT_OUTER", "CUT_INNER"} <= {layer.dxf.name for layer in document.layers}
    entities = [(e.dxftype(), e.dxf.layer, e.closed) for e in document.modelspace()]
    assert entities == [("LWPOLYLINE", "CUT_OUTER", True), ("LWPOLYLINE", "CUT_INNER", True)]


def test_full_circles_are_circles():
    circles = opened(toothed_shaft()).modelspace().query("CIRCLE")
    assert [(c.dxf.layer, *c.dxf.center, c.dxf.radius) for c in circles] == [
        ("CUT_INNER", 0.0, 0.0, 0.0, 2.0),
        ("CUT_INNER", 3.5, 0.0, 0.0, 0.8),
    ]


def test_arcs_come_back_with_their_radius_and_sweep():
    slot = Outline(
        (
            Line((-5e-3, -2e-3), (5e-3, -2e-3)),
            Arc((5e-3, 0.0), 2e-3, -np.pi / 2, np.pi),
            Line((5e-3, 2e-3), (-5e-3, 2e-3)),
            Arc((-5e-3, 0.0), 2e-3, np.pi / 2, np.pi),
        )
    )
    (entity,) = opened(Profile(slot)).modelspace()
    assert entity.get_points("xyb") == [
        (-5.0, -2.0, 0.0),
        (5.0, -2.0, 1.0),
        (5.0, 2.0, 0.0),
        (-5.0, 2.0, 1.0),
    ]


def test_area_and_length_survive_the_rounding(ring_text):
    model = finger_ring(fitted=True)
    entities = list(read(io.StringIO(ring_text)).modelspace())
    for contour, entity in zip((model.outer, *model.inner), entities, strict=True):
        read_back = drawn(entity)
        # Rounding moves a vertex by 0.7e-9 m at most.
        assert abs(signed_area(read_back)) == pytest.approx(
            abs(contour_area(contour)), abs=1e-9 * contour_length(contour)
        )
        assert length(read_back) == pytest.approx(contour_length(contour), rel=1e-6)


def test_outer_contours_run_counter_clockwise_and_inner_ones_clockwise():
    square = polygon((0, 0), (0, 10), (10, 10), (10, 0))
    hole = polygon((2, 2), (4, 2), (4, 4), (2, 4))
    outer, inner = opened(Profile(square, (hole,))).modelspace()
    assert signed_area(drawn(outer)) == pytest.approx(1e-4)
    assert signed_area(drawn(inner)) == pytest.approx(-4e-6)


def test_an_outline_of_arcs_is_not_fitted_again():
    outline = finger_ring(fitted=True).inner[0]
    entity = (
        opened(Profile(Circle((0, 0), 33.5e-3), (outline,))).modelspace().query("LWPOLYLINE")[0]
    )
    assert len(entity) == len(outline.pieces)


def test_vertices_that_rounding_makes_one_are_merged():
    outline = Outline(
        (
            Line((0.0, 0.0), (1e-2, 0.0)),
            Line((1e-2, 0.0), (1e-2, 8e-10)),
            Line((1e-2, 8e-10), (0.0, 1e-2)),
            Line((0.0, 1e-2), (0.0, 0.0)),
        )
    )
    vertices = drawing_vertices(fit_outline(outline))
    assert len(vertices) == 3
    assert len(set(vertices)) == 3


def test_there_is_no_minus_zero(ring_text):
    assert "-0.0\n" not in ring_text
    vertices = drawing_vertices(fit_outline(polygon((-1e-9, -1e-9), (1, -1e-9), (1, 1))))
    assert all(str(x) != "-0.0" for vertex in vertices for x in vertex)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_a_coordinate_that_is_not_finite_is_never_written(bad):
    with pytest.raises(ValueError, match="not a finite number"):
        part_to_dxf(part(Profile(Circle((0.0, bad), 1e-3))))
    with pytest.raises(ValueError, match="not a finite number"):
        part_to_dxf(
            part(
                Profile(
                    Outline((Line((0, 0), (bad, 0)), Line((bad, 0), (1, 1)), Line((1, 1), (0, 0))))
                )
            )
        )


def test_names_and_materials_never_enter_the_drawing():
    hostile = "x\n  0\nSECTION\n  2\nENTITIES\n"
    profile = toothed_shaft()
    plain = part_to_dxf(part(profile))
    assert part_to_dxf(Part(hostile, hostile, profile, 4.5e-3, hostile)) == plain


def test_the_same_part_gives_the_same_bytes(ring_text):
    assert part_to_dxf(part(finger_ring(fitted=True))) == ring_text


WRITE = """
import hashlib, sys
sys.path.insert(0, sys.argv[1])
from geometry_shapes import toothed_shaft
from springcad.export.dxf import part_to_dxf
from springcad.result import Part
print(hashlib.sha256(part_to_dxf(Part("", "", toothed_shaft(), 1e-3, "")).encode()).hexdigest())
"""


def run_writer(folder, **environment):
    tests = str(Path(__file__).parents[1])
    done = subprocess.run(
        [sys.executable, "-c", WRITE, tests],
        cwd=folder,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout.strip(), done.stderr


def test_the_bytes_depend_on_neither_folder_nor_clock_nor_locale_nor_an_ezdxf_ini(tmp_path):
    (tmp_path / "a").mkdir()
    (tmp_path / "b").mkdir()
    (tmp_path / "b" / "ezdxf.ini").write_text(
        "[core]\nwrite_fixed_meta_data_for_testing = false\nlog_unprocessed_tags = true\n"
    )
    first, _ = run_writer(tmp_path / "a", TZ="UTC", PYTHONHASHSEED="1", LC_ALL="C")
    time.sleep(1.1)  # dates in a DXF have a resolution of one second
    second, _ = run_writer(
        tmp_path / "b", TZ="Pacific/Auckland", PYTHONHASHSEED="2", LC_ALL="C.UTF-8"
    )
    assert len(first) == 64
    assert second == first


def test_a_broken_ezdxf_ini_is_named(tmp_path):
    (tmp_path / "ezdxf.ini").write_text("no section\n")
    _, errors = run_writer(tmp_path)
    assert "SpringcadError: ezdxf.ini cannot be read" in errors


def test_a_locale_with_decimal_commas_changes_nothing(ring_text):
    before = locale.setlocale(locale.LC_NUMERIC)
    try:
        locale.setlocale(locale.LC_NUMERIC, "de_DE.UTF-8")
    except locale.Error:
        pytest.skip("this machine has no German locale")
    try:
        assert part_to_dxf(part(finger_ring(fitted=True))) == ring_text
    finally:
        locale.setlocale(locale.LC_NUMERIC, before)
