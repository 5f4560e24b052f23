"""The kinds of compliant element that springcad designs, each a package with the same rooms.

Nothing outside this package asks which kind it has: it takes a ``Kind`` from the registry.
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Protocol, cast

if TYPE_CHECKING:
    from springcad.kinds.calibrating import Calibration, Stiffness
    from springcad.result import Check, Judgement, Progress, Result
    from springcad.sheet import Sheet
    from springcad.spec.common import CommonSpec
    from springcad.spec.source import Spec
    from springcad.spec.torque_curve import TorqueFile
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
    "lever-arm": (
        "springcad.kinds.lever_arm",
        "leaf spring behind a lever with a moving pivot, for a variable stiffness (paper 000)",
    ),
    "leaf-2dof": (
        "springcad.kinds.leaf_2dof",
        "leaf springs of adjustable length for a wrist with two axes (paper 003)",
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

    def explain_spec(self, spec: Spec, progress: Progress) -> Sheet:
        """The calculation sheet of the design, up to where it is refused if it is."""
        ...

    def judge_design(self, design: WrittenDesign, progress: Progress) -> Judgement:
        """The design judged by another model; ``IncompleteDesignError`` if a number is missing."""
        ...

    def judge_decks(self, design: WrittenDesign) -> Mapping[str, str]:
        """Name (to follow that of the design) → input deck of each analysis of the judge."""
        ...


class CompensatingKind(Kind, Protocol):
    """A kind whose designs can be made up for what the user's own simulation or test shows."""

    def next_spec(self, design: WrittenDesign) -> Spec:
        """The spec of the next design, with a name of its own."""
        ...

    def compensate_design(
        self, spec: Spec, design: WrittenDesign, curve: TorqueFile, progress: Progress
    ) -> Result:
        """The next design, from a torque curve of the written one; ``SpecError`` if it is bad."""
        ...


class CalibratingKind(Kind, Protocol):
    """A kind of which a bench test can say what the next design should take for granted."""

    def calibrate_design(
        self, design: WrittenDesign, curve: TorqueFile, stiffness: Stiffness, progress: Progress
    ) -> Calibration:
        """What the test of a written design tells; ``SpecError`` if it is bad or too little."""
        ...


def load_kind(name: str) -> Kind:
    """The package of the kind ``name``; KeyError for an unknown name."""
    package, _ = KINDS[name]
    return import_module(package)


def compensating_kind(name: str) -> CompensatingKind | None:
    """The same for a kind that offers compensation; None for one that does not."""
    kind = load_kind(name)
    return cast(CompensatingKind, kind) if hasattr(kind, "compensate_design") else None


def calibrating_kind(name: str) -> CalibratingKind | None:
    """The same for a kind that offers calibration; None for one that does not."""
    kind = load_kind(name)
    return cast(CalibratingKind, kind) if hasattr(kind, "calibrate_design") else None
