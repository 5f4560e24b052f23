"""The analysis as an input deck of CalculiX and Abaqus, so that others can repeat it.

Text only, in SI units. CalculiX makes solids of plane-stress elements: at the true thickness of a
narrow ribbon they are several per cent too stiff. ``slice_deck`` therefore writes a thin slice of
the sheet and scales the forces with it; displacements and stresses are those of the whole sheet,
reactions, torques and energies the slice's share of them.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.fem.assembly import Sheet
from springcad.mechanics.fem.constraints import Equations
from springcad.mechanics.fem.deck_contact import (
    RigidStrip,
    contact_lines,
    element_lines,
    node_lines,
    strip_motion,
)
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.newton import Load

Floats = NDArray[np.float64]

SLICE = 2e-5
"""Thickness that is written [m]: thin enough for plane stress in CalculiX."""

_TERMS_PER_LINE = 3  # numbers have 12 digits: CalculiX reads no field beyond 20 characters
_NUMBERS_PER_LINE = 8


def slice_deck(
    mesh: Mesh,
    sheet: Sheet,
    equations: Equations,
    loads: Sequence[Load],
    *,
    strip: RigidStrip | None = None,
    nonlinear: bool = True,
    title: str = "springcad",
) -> str:
    """Input deck with one step for each load, as ``solve_path`` takes them.

    Args:
        equations: supports and ties, as given to ``solve_constraints`` (with ``combine``).
        strip: the rigid profile as elements that follow the rotation of the loads; CalculiX finds
            the direction of contact at the start of an increment, so let the last steps be short.
        nonlinear: large displacements; a linear deck takes one load and no strip.
        title: heading, one line of plain ASCII.

    Raises:
        ValueError: an equation has both masters and a prescribed value, which *EQUATION cannot
            hold, or the title is not one line of plain ASCII.
    """
    if not title.isascii() or not title.isprintable():
        raise ValueError("the title of a deck must be one line of plain ASCII")
    lines = [
        "*HEADING",
        f"{title}: SI units; a slice of {SLICE:g} m of a sheet of {sheet.thickness:g} m",
        "*NODE, NSET=PART",
        *node_lines(mesh, 0),
        "*ELEMENT, TYPE=CPS8, ELSET=SHEET",
        *element_lines(mesh, 0, 0),
        *_set_lines(mesh),
        *(contact_lines(mesh, strip) if strip else []),
        "*MATERIAL, NAME=SHEET",
        "*ELASTIC",
        f"{sheet.elastic_modulus:.12g}, {sheet.poisson_ratio:.12g}",
        "*SOLID SECTION, ELSET=SHEET, MATERIAL=SHEET",
        f"{SLICE:.12g}",
        *_equation_lines(equations),
    ]
    for load in loads:
        moved = strip_motion(strip, len(mesh.nodes), load.rotation) if strip else []
        lines += [
            "*STEP, NLGEOM, INC=1000" if nonlinear else "*STEP",
            "*STATIC",
            "1., 1.",
            *_under("*BOUNDARY", [*_held_lines(equations, load.prescribed), *moved]),
            *_under("*CLOAD, OP=NEW", _force_lines(load.force * (SLICE / sheet.thickness))),
            "*NODE PRINT, NSET=PART",
            "U, RF",
            "*NODE FILE",
            "U, RF",
            "*EL FILE",
            "S",
            "*END STEP",
        ]
    return "\n".join(lines) + "\n"


def _equation_lines(equations: Equations) -> list[str]:
    """*EQUATION blocks of all equations with masters."""
    lines: list[str] = []
    for i, slave in enumerate(equations.slaves):
        terms = np.flatnonzero(equations.rows == i)
        if len(terms):
            entries = [_term(int(slave), 1.0)]
            entries += [_term(int(equations.masters[k]), -equations.factors[k]) for k in terms]
            lines += ["*EQUATION", str(len(entries)), *_wrapped(entries, _TERMS_PER_LINE)]
    return lines


def _held_lines(equations: Equations, prescribed: Floats) -> list[str]:
    """Data lines of *BOUNDARY of all equations without masters."""
    tied = np.isin(np.arange(len(equations.slaves)), equations.rows)
    if np.any(prescribed[equations.slaves[tied]] != 0.0):
        raise ValueError("an equation with masters cannot have a prescribed value in a deck")
    held = sorted(int(slave) for slave in equations.slaves[~tied])
    return [f"{k // 2 + 1}, {k % 2 + 1}, {k % 2 + 1}, {prescribed[k]:.12g}" for k in held]


def _force_lines(force: Floats) -> list[str]:
    """Data lines of *CLOAD."""
    return [f"{k // 2 + 1}, {k % 2 + 1}, {force[k]:.12g}" for k in np.flatnonzero(force)]


def _term(number: int, factor: float) -> str:
    """One term of an equation: node, direction, factor."""
    return f"{number // 2 + 1}, {number % 2 + 1}, {factor:.12g}"


def _set_lines(mesh: Mesh) -> list[str]:
    """Node sets by name."""
    lines: list[str] = []
    for name in sorted(mesh.node_sets):
        numbers = [str(node + 1) for node in mesh.node_sets[name]]
        lines += [f"*NSET, NSET={name.upper()}", *_wrapped(numbers, _NUMBERS_PER_LINE)]
    return lines


def _wrapped(items: list[str], count: int) -> list[str]:
    """Items with commas, ``count`` to a line."""
    return [", ".join(items[i : i + count]) for i in range(0, len(items), count)]


def _under(keyword: str, lines: Iterable[str]) -> list[str]:
    """The keyword and its data lines; nothing without data."""
    data = list(lines)
    return [keyword, *data] if data else []
