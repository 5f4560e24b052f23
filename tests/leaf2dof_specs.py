"""Specs of the kind leaf-2dof, for its tests."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from springcad.kinds.leaf_2dof.case import Case
from springcad.kinds.leaf_2dof.design import make_leaves
from springcad.kinds.leaf_2dof.inputs import case_of, leaf_spec
from springcad.kinds.leaf_2dof.made import MadeLeaves
from springcad.spec.source import read_spec

SPECS = Path(__file__).parents[1] / "specs"


def shipped_case(name: str, *overrides: str) -> Case:
    """A shipped spec read by the real reader, with overrides as on the command line."""
    return case_of(read_spec(SPECS / f"leaf2-{name}.yaml", overrides).model)


@cache
def made_leaves(name: str, *overrides: str) -> MadeLeaves:
    """The same, designed; once for all tests."""
    spec = read_spec(SPECS / f"leaf2-{name}.yaml", overrides)
    return make_leaves(leaf_spec(spec.model), lambda _: None)
