"""The analysis as an input deck of CalculiX and Abaqus, so that others can repeat it.

Text only, in SI units. CalculiX makes solids of plane-stress elements: at the true thickness of a
narrow ribbon they are several per cent too stiff. ``slice_deck`` therefore writes a thin slice of
the sheet and scales the forces with it; displacements and stresses are those of the whole sheet,
reactions, torques and energies the slice's share of them.

Both programs eliminate the first variable of an *EQUATION, and Abaqus lets it appear nowhere else
("Linear constraint equations" of its manual); the equations are therefore written solved.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from springcad.mechanics.fem.assembly import Sheet
from springcad.mechanics.fem.constraints import Constraints
from springcad.mechanics.fem.deck_contact import (
    RigidStrip,
    contact_lines,
    contact_prints,
    element_lines,
    node_lines,
    strip_motion,
)
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import Load

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

SLICE = 2e-5
"""Thickness that is written [m]: thin enough for plane stress in CalculiX."""

_TERMS_PER_LINE = 3  # numbers have 12 digits: CalculiX reads no field beyond 20 characters
_NUMBERS_PER_LINE = 8


def slice_deck(
    mesh: Mesh,
    sheet: Sheet,
    constraints: Constraints,
    loads: Sequence[Load],
    *,
    strip: RigidStrip | None = None,
    shares: Floats | None = None,
    nonlinear: bool = True,
    title: str = "springcad",
    notes: Sequence[str] = (),
) -> str:
    """Input deck with one step for each load, as ``solve_path`` takes them; two with a strip.

    CalculiX keeps the directions of contact that it found at the start of an increment. So each
    load of a deck with contact is followed by a step that holds it, in which they are found anew.

    Args:
        strip: the rigid profile as elements that follow the rotation of the loads.
        shares: thickness of each element over the sheet's (E,), where it differs.
        nonlinear: large displacements; a linear deck takes one load and no strip.
        title: heading.
        notes: comments, below the heading.

    Raises:
        ValueError: an equation has both masters and a prescribed value, which *EQUATION cannot
            hold, or title and notes are not lines of plain ASCII.
    """
    if not all(line.isascii() and line.isprintable() for line in (title, *notes)):
        raise ValueError("title and notes of a deck must each be one line of plain ASCII")
    lines = [
        "*HEADING",
        f"{title}: SI units; a slice of {SLICE:g} m of a sheet of {sheet.thickness:g} m",
        *(f"** {note}".rstrip() for note in notes),
        "*NODE, NSET=PART",
        *node_lines(mesh, 0),
        "*ELEMENT, TYPE=CPS8, ELSET=SHEET",
        *element_lines(mesh, 0, 0),
        *_set_lines(mesh),
        *(contact_lines(mesh, strip) if strip else []),
        "*MATERIAL, NAME=SHEET",
        "*ELASTIC",
        f"{sheet.elastic_modulus:.12g}, {sheet.poisson_ratio:.12g}",
        *(_section("SHEET", 1.0) if shares is None else _section_lines(shares)),
        *_equation_lines(constraints),
    ]
    for load in loads:
        moved = strip_motion(strip, len(mesh.nodes), load.rotation) if strip else []
        step = [
            "*STEP, NLGEOM, INC=1000" if nonlinear else "*STEP",
            "*STATIC",
            "1., 1., 1e-6, 1.",
            *_under("*BOUNDARY", [*_held_lines(constraints, load.prescribed), *moved]),
            *_under("*CLOAD, OP=NEW", _force_lines(load.force * (SLICE / sheet.thickness))),
            *(contact_prints(strip) if strip else []),
            "*NODE PRINT, NSET=PART",
            "U, RF",
            "*NODE FILE",
            "U, RF",
            "*EL FILE",
            "S",
            "*END STEP",
        ]
        lines += step * 2 if strip else step
    return "\n".join(lines) + "\n"


def _section(elements: str, share: float) -> list[str]:
    return [f"*SOLID SECTION, ELSET={elements}, MATERIAL=SHEET", f"{SLICE * share:.12g}"]


def _section_lines(shares: Floats) -> list[str]:
    """A section, with its set of elements, for each thickness (six digits)."""
    lines: list[str] = []
    rounded = np.array([float(f"{share:.6g}") for share in shares])
    for number, share in enumerate(np.unique(rounded), start=1):
        members = [str(element + 1) for element in np.flatnonzero(rounded == share)]
        name = f"SHEET-{number}"
        lines += [f"*ELSET, ELSET={name}", *_wrapped(members, _NUMBERS_PER_LINE)]
        lines += _section(name, float(share))
    return lines


def _equation_lines(constraints: Constraints) -> list[str]:
    """*EQUATION blocks of all slaves that follow free components."""
    unknowns = constraints.transform.shape[0]
    free = np.setdiff1d(np.arange(unknowns), constraints.equations.slaves)
    lines: list[str] = []
    for slave in constraints.equations.slaves:
        factors, masters = _row(constraints, int(slave))
        if len(masters):
            entries = [_term(int(slave), 1.0)]
            entries += [_term(int(free[k]), -f) for k, f in zip(masters, factors, strict=True)]
            lines += ["*EQUATION", str(len(entries)), *_wrapped(entries, _TERMS_PER_LINE)]
    return lines


def _row(constraints: Constraints, number: int) -> tuple[Floats, Indices]:
    """Factors and numbers of the free components that a component follows."""
    matrix = constraints.transform
    entries = slice(matrix.indptr[number], matrix.indptr[number + 1])
    return matrix.data[entries], np.asarray(matrix.indices[entries], dtype=np.intp)


def _held_lines(constraints: Constraints, prescribed: Floats) -> list[str]:
    """Data lines of *BOUNDARY of all slaves that follow no free component."""
    values = np.asarray(constraints.lift @ prescribed)
    lines: list[str] = []
    for slave in np.sort(constraints.equations.slaves):
        if not len(_row(constraints, int(slave))[1]):
            lines.append(_at(int(slave), float(values[slave])))
        elif values[slave] != 0.0:
            raise ValueError("an equation with masters cannot have a prescribed value in a deck")
    return lines


def _force_lines(force: Floats) -> list[str]:
    """Data lines of *CLOAD."""
    return [_term(int(k), float(force[k])) for k in np.flatnonzero(force)]


def _at(number: int, value: float) -> str:
    """A prescribed displacement: node, first and last direction, value."""
    return f"{number // 2 + 1}, {number % 2 + 1}, {number % 2 + 1}, {value:.12g}"


def _term(number: int, factor: float) -> str:
    """One term of an equation, or a force: node, direction, number."""
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
