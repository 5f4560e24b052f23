"""Meshes and analyses that the finite-element tests share."""

from __future__ import annotations

import re
import subprocess

import numpy as np

from springcad.mechanics.fem.assembly import Sheet, prepare_solid
from springcad.mechanics.fem.blocks import join
from springcad.mechanics.fem.constraints import prescribe, solve_constraints
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import prepare_model

STEEL = Sheet(200e9, 0.3, 4.5e-3)

SIDES = ("south", "east", "north", "west")


def grid(shape, columns, rows):
    """Mesh of the unit square mapped by ``shape(u, v) -> (x, y)``, with its four sides as sets."""
    u, v = np.meshgrid(
        np.linspace(0.0, 1.0, 2 * columns + 1), np.linspace(0.0, 1.0, 2 * rows + 1), indexing="ij"
    )
    points = np.stack(shape(u, v), axis=-1)
    return join({"part": points}, {side: [("part", side)] for side in SIDES})


def distorted_square(size=1.0):
    """Five by four elements, straight-sided and badly shaped, in a square."""

    def shape(u, v):
        bubble = u * (1.0 - u) * v * (1.0 - v)
        x, y = u + 0.9 * bubble * np.sin(5.0 * v + 1.0), v + 0.9 * bubble * np.cos(7.0 * u)
        return size * x, size * y

    return straight_sided(grid(shape, 5, 4))


def straight_sided(mesh):
    """The mesh with its mid-side nodes moved to the middle of straight edges."""
    nodes, elements = mesh.nodes.copy(), mesh.elements
    corners = nodes[elements[:, :4]]
    nodes[elements[:, 4:]] = 0.5 * (corners + np.roll(corners, -1, axis=1))
    return Mesh(nodes, elements, mesh.node_sets, mesh.edge_sets)


def cantilever(length, root_half, tip_half, columns=40, rows=4, origin=(0.0, 0.0)):
    """A straight ribbon along x, tapered linearly, its root ("west") at ``origin``."""

    def shape(u, v):
        half = root_half + (tip_half - root_half) * u
        return origin[0] + length * u, origin[1] + (2.0 * v - 1.0) * half

    return grid(shape, columns, rows)


def arch(inner, outer, angle, columns, rows):
    """A ring segment from the x axis to ``angle``; "west" at angle 0, "south" the outer radius."""

    def shape(u, v):
        radius = outer + (inner - outer) * v
        return radius * np.cos(angle * u), radius * np.sin(angle * u)

    return grid(shape, columns, rows)


def clamped(mesh, sheet=STEEL, side="west"):
    """Model of a mesh clamped at one side."""
    held = prescribe(mesh.node_sets[side])
    return prepare_model(prepare_solid(mesh, sheet), solve_constraints(mesh.unknowns, held))


def circle(radius, center=(0.0, 0.0), count=721):
    """Closed points of a circle, counter-clockwise."""
    angle = np.linspace(0.0, 2.0 * np.pi, count)
    return np.array(center) + radius * np.stack([np.cos(angle), np.sin(angle)], axis=-1)


def run_calculix(program, deck, directory, count, timeout=120):
    """Displacements and forces (count, 2) at the last increment of a deck run in CalculiX."""
    printed = calculix_prints(program, deck, directory, timeout)
    numbers = np.arange(count)
    return [printed_vectors(printed, name, "PART", numbers)[-1] for name in VECTORS]


VECTORS = ("displacements", "forces")


def calculix_prints(program, deck, directory, timeout=120):
    """What CalculiX prints of the results of a deck; it leaves ``job.frd`` in the directory."""
    (directory / "job.inp").write_text(deck)
    done = subprocess.run(
        [program, "job"], cwd=directory, capture_output=True, text=True, timeout=timeout, check=True
    )
    assert "*ERROR" not in done.stdout, done.stdout[-2000:]
    return (directory / "job.dat").read_text()


def printed_vectors(printed, name, node_set, numbers):
    """Vectors (increments, nodes, 2) of a *NODE PRINT at the nodes of these numbers, from 0."""
    heading = rf" {name} \(\w+,\w+,\w+\) for set {node_set} and time .*\n\s*\n((?:\s+\d.*\n)+)"
    increments = []
    for block in re.findall(heading, printed):
        rows = {int(row[0]): row[1:3] for row in (line.split() for line in block.splitlines())}
        increments.append([[float(number) for number in rows[int(k) + 1]] for k in numbers])
    return np.array(increments)


def nodal_stresses(path, numbers):
    """Stresses (steps, nodes, 6: xx, yy, zz, xy, yz, zx) in an .frd at these nodes, from 0."""
    steps = []
    for block in path.read_text().split(" -4  STRESS")[1:]:
        lines = block.split(" -3")[0].splitlines()
        rows = {int(line[3:13]): line[13:] for line in lines if line.startswith(" -1")}
        steps.append([[float(rows[k + 1][i : i + 12]) for i in range(0, 72, 12)] for k in numbers])
    return np.array(steps)
