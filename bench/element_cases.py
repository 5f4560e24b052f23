"""Analyses that springcad's finite elements and CalculiX both do, on the same mesh."""

from __future__ import annotations

import math
import subprocess
import sys
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

import calculix
import numpy as np
from stopwatch import best_time

from springcad.kinds.rotary_flexure.deck import sector_deck
from springcad.kinds.rotary_flexure.root_compliance import sector_supports
from springcad.kinds.rotary_flexure.sector_blocks import FINE
from springcad.kinds.rotary_flexure.sector_contact import sector_contact, turn_through
from springcad.kinds.rotary_flexure.sector_mesh import sector_mesh
from springcad.kinds.rotary_flexure.written_spring import WrittenSpring, written_spring
from springcad.mechanics.fem.assembly import edge_load, prepare_solid
from springcad.mechanics.fem.deck import slice_deck
from springcad.mechanics.fem.mesh import Mesh
from springcad.mechanics.fem.model import Load, State, prepare_model
from springcad.mechanics.fem.newton import linear_solution, solve_path
from springcad.verify.read_design import read_design

SECONDS = 5.0
"""Ours are repeated for so long; CalculiX runs once."""
TIP_FORCE = 285.0
"""N; turns the tip of S1 by about ten degrees."""


@dataclass(frozen=True)
class Case:
    """One analysis by both; processor seconds from the mesh to the displacements.

    ``calculix_seconds`` are of its whole process. ``difference`` is the largest of displacements
    over the largest displacement. None: CalculiX was not run.
    """

    name: str
    unknowns: int
    steps: int
    seconds: float
    calculix_seconds: float | None
    difference: float | None
    note: str = ""


def designed(spec: Path) -> WrittenSpring:
    """The spring of a spec, as ``springcad design`` writes it."""
    with tempfile.TemporaryDirectory() as folder:
        tool = [sys.executable, "-m", "springcad"]
        command = [*tool, "design", str(spec), "-o", folder, "--no-verify"]
        subprocess.run(command, check=True, capture_output=True)
        return written_spring(read_design(Path(folder) / spec.stem)[0])


def tip_force(spring: WrittenSpring, *, nonlinear: bool) -> Case:
    """A force on the tip of a sector with fillets and rim, the bore held."""
    mesh = sector_mesh(spring.sector, FINE)
    load = Load(edge_load(mesh, "tip", np.array([0.0, -TIP_FORCE])), np.zeros(mesh.unknowns))

    def ours() -> list[State]:
        held = sector_supports(mesh, spring.sector.count, "bore")
        model = prepare_model(prepare_solid(mesh, spring.sheet), held)
        return list(solve_path(model, [load])) if nonlinear else [linear_solution(model, load)]

    held = sector_supports(mesh, spring.sector.count, "bore")
    seconds, (state,) = best_time(ours, SECONDS)
    deck = slice_deck(mesh, spring.sheet, held, [load], nonlinear=nonlinear)
    name = "tip force, large displacements" if nonlinear else "tip force, linear"
    note = f"tip turned by {_tip_turn(mesh, state):.1f} deg"
    return _against_calculix(Case(name, mesh.unknowns, 1, seconds, None, None, note), state, deck)


def _tip_turn(mesh: Mesh, state: State) -> float:
    """Rotation of the line between the ends of the tip's edge in degrees."""
    ends = mesh.node_sets["tip"][[0, -1]]
    before, after = (
        np.diff(points[ends], axis=0)[0]
        for points in (mesh.nodes, mesh.nodes + state.displacement.reshape(-1, 2))
    )
    cross = before[0] * after[1] - before[1] * after[0]
    return math.degrees(abs(math.atan2(cross, before @ after)))


def torque_curve(spring: WrittenSpring, count: int, *, against: bool) -> Case:
    """The second opinion on one direction: the sector pushed by its camshaft as drawn.

    Args:
        count: angles, evenly spaced up to the design deflection.
        against: whether CalculiX does it too; it takes its time.
    """
    angles = (spring.deflection * np.linspace(0.0, 1.0, count + 1)[1:]).tolist()
    seconds, turns = best_time(lambda: turn_through(sector_contact(spring, 1), angles), SECONDS)
    iterations = sum(turn.state.iterations for turn in turns)
    last = turns[-1].state
    case = Case(
        "camshaft on the sector, contact",
        len(last.displacement),
        len(turns),
        seconds,
        None,
        None,
        f"{iterations} iterations of ours, mesh included",
    )
    if not against:
        return case
    return _against_calculix(case, last, sector_deck(sector_contact(spring, 1), turns, "bench"))


def _against_calculix(case: Case, state: State, deck: str) -> Case:
    """The case with CalculiX's time and its difference from our last state."""
    if calculix.PROGRAM is None:
        return replace(case, note="ccx is not installed")
    mine = state.displacement.reshape(-1, 2)
    seconds, theirs = calculix.run(deck, len(mine))
    difference = float(np.abs(theirs - mine).max() / np.abs(mine).max())
    return replace(case, calculix_seconds=seconds, difference=difference)
