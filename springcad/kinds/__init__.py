"""The kinds of compliant element that springcad designs, each a package with the same rooms.

Nothing outside this package asks which kind it has: it takes a ``Kind`` from the registry.
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from springcad.result import Check, Judgement, Progress, Result
    from springcad.spec.common import CommonSpec
    from springcad.spec.source import Spec
    from springcad.written import WrittenDesign

KINDS = {
    "rotary-flexure": (
        "springcad.kinds.rotary_flexure",
        "ring of tapered straight or serpentine flexures and its camshaft (paper 004)",
    ),
    "roller-cam": (
        "springcad.kinds.roller_cam",
        "cantilever and contact profile for a roller, for any torque law (paper 001)",
    ),
}
"""Name in the spec → (package, one line for people). Packages are imported only when needed."""


class Kind(Protocol):
    """What each package of a kind offers at its top level."""

    SPEC_MODEL: type[CommonSpec]
    TEMPLATE: str

    def check_spec(self, spec: Spec) -> tuple[Check, ...]:
        """Closed-form checks, no optimisation, well under a second."""
        ...

    def design_spec(self, spec: Spec, progress: Progress) -> Result:
        """The whole design; raises ``InfeasibleError`` when no part can meet the spec."""
        ...

    def judge_design(self, design: WrittenDesign, progress: Progress) -> Judgement:
        """The design judged by another model; ``IncompleteDesignError`` if a number is missing."""
        ...

    def judge_decks(self, design: WrittenDesign) -> Mapping[str, str]:
        """Name (to follow that of the design) → input deck of each analysis of the judge."""
        ...


def load_kind(name: str) -> Kind:
    """The package of the kind ``name``; KeyError for an unknown name."""
    package, _ = KINDS[name]
    return import_module(package)
