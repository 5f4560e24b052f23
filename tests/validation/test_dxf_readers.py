"""Other programs read our drawings: GDAL/OGR and FreeCAD see the part that the model describes.

Closed contours, their number, area, length and the Hausdorff distance to the model are compared.
The model is the exact outline before any fit: the tolerance of the fit is part of the claim.
"""

from __future__ import annotations

import json
import os
import subprocess
from dataclasses import dataclass

import numpy as np
import pytest
import shapely
from geometry_shapes import both_ways, finger_ring, toothed_shaft

from springcad.export.dxf import part_to_dxf
from springcad.geometry.biarc import exact_polyline
from springcad.geometry.outline import Profile
from springcad.geometry.outline_ops import contour_area, contour_length, contour_points
from springcad.geometry.polyline import sweeps
from springcad.result import Part

FIT = 2e-3  # mm, the tolerance of the biarcs
PARTS = {
    "ring with fingers and dowel notches": (finger_ring(), FIT),
    "shaft of lines, arcs and holes": (toothed_shaft(), 0.0),
}
"""Model, and how far (mm) its drawing may be from it."""


@dataclass(frozen=True)
class Seen:
    """A contour as another program sees it, in mm: its points, closed or not, area and length."""

    points: np.ndarray
    closed: bool
    area: float
    length: float


def contours(profile: Profile):
    return (profile.outer, *profile.inner)


def compare(profile: Profile, seen: list[Seen], deviation: float, chord: float):
    """``chord`` (mm) is what the other program's own points may be off the arcs."""
    assert len(seen) == len(contours(profile))
    assert all(contour.closed for contour in seen)
    by_area = sorted(contours(profile), key=lambda c: abs(contour_area(c)))
    for model, read in zip(by_area, sorted(seen, key=lambda s: s.area), strict=True):
        length = contour_length(model) * 1e3
        slack = deviation + chord
        assert read.area == pytest.approx(abs(contour_area(model)) * 1e6, abs=slack * length)
        # A line moved by e along its normals changes its length by e times its turn.
        turn = float(np.sum(np.abs(sweeps(exact_polyline(model)))))
        assert read.length == pytest.approx(length, abs=deviation * turn + 2e-6 * length)
        outline = contour_points(model, 1e-7) * 1e3
        assert both_ways(read.points, np.vstack((outline, outline[:1]))) <= slack + 1e-4


@pytest.fixture(params=PARTS)
def drawing(request, tmp_path):
    profile, deviation = PARTS[request.param]
    path = tmp_path / "part.dxf"
    text = part_to_dxf(Part("", request.param, profile, 4.5e-3, "steel"))
    path.write_text(text, encoding="utf-8", newline="\n")
    return path, profile, deviation


def test_gdal_reads_the_part(drawing, require_tool):
    path, profile, deviation = drawing
    arguments = ["-f", "GeoJSON", "/vsistdout/", str(path), "-lco", "COORDINATE_PRECISION=9"]
    step = 0.1  # degrees; GDAL's own default of 4 degrees would cut 20 um off a rim
    done = subprocess.run(
        [require_tool("ogr2ogr"), *arguments, "--config", "OGR_ARC_STEPSIZE", str(step)],
        capture_output=True,
        text=True,
        check=True,
    )
    features = json.loads(done.stdout)["features"]
    layers = sorted(feature["properties"]["Layer"] for feature in features)
    assert layers == ["CUT_INNER"] * len(profile.inner) + ["CUT_OUTER"]
    seen = []
    for feature in features:
        points = np.array(feature["geometry"]["coordinates"])[:, :2]
        ring = shapely.LineString(points)
        closed = bool(np.hypot(*(points[0] - points[-1])) < 1e-6)
        seen.append(Seen(points, closed, shapely.Polygon(points).area, ring.length))
    sagitta = 33.5 * (1.0 - np.cos(0.5 * np.radians(step)))
    compare(profile, seen, deviation, sagitta + 2e-6)


FREECAD = """
import json, os
import FreeCAD, Import, Part

FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Draft").SetBool("joingeometry", False)
document = FreeCAD.newDocument("read")
Import.readDXF(os.environ["DRAWING"], document.Name)
edges = [edge for o in document.Objects if hasattr(o, "Shape") for edge in o.Shape.Edges]
seen = []
for chain in Part.sortEdges(edges):
    wire = Part.Wire(chain)
    points = []
    for edge in wire.OrderedEdges:
        part = edge.discretize(Number=33)
        part = part if edge.Orientation == "Forward" else part[::-1]
        points += [(p.x, p.y) for p in part]
    area = Part.Face(wire).Area if wire.isClosed() else 0.0
    seen.append([points, wire.isClosed(), area, wire.Length])
with open(os.environ["ANSWER"], "w") as stream:
    json.dump(seen, stream)
"""


def test_freecad_reads_the_part(drawing, tmp_path, require_tool):
    path, profile, deviation = drawing
    script, answer = tmp_path / "look.py", tmp_path / "seen.json"
    script.write_text(FREECAD, encoding="utf-8")
    done = subprocess.run(
        [require_tool("freecadcmd"), str(script)],
        env={
            **{key: os.environ[key] for key in ("PATH", "LANG") if key in os.environ},
            "HOME": str(tmp_path),
            "QT_QPA_PLATFORM": "offscreen",
            "DRAWING": str(path),
            "ANSWER": str(answer),
        },
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=120,
        check=False,
    )
    assert answer.exists(), done.stdout[-2000:] + done.stderr[-2000:]
    seen = [
        Seen(np.array(points), closed, area, length)
        for points, closed, area, length in json.loads(answer.read_text())
    ]
    # 32 chords to an arc: the largest arc is a dowel notch or a full circle of 4 mm.
    sagitta = max(2.0 * (1.0 - np.cos(np.pi / 32)), 33.5 * (1.0 - np.cos(np.pi / 8 / 64)))
    compare(profile, seen, deviation, sagitta)
