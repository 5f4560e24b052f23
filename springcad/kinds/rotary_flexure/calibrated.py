"""A spec with the numbers of its calibration in their places, and what a report says of them."""

from __future__ import annotations

from collections.abc import Mapping

from springcad.kinds.provenance import sources
from springcad.kinds.rotary_flexure.calibration_spec import Calibration
from springcad.kinds.rotary_flexure.spec import RotaryFlexureSpec
from springcad.result import Value
from springcad.spec.units import STRESS, show


def calibrated(spec: RotaryFlexureSpec) -> RotaryFlexureSpec:
    """The spec with elastic modulus and friction of the calibration, if it has one.

    The root coefficient stays where it is: ``sizing`` adds it to the compliance of the root.
    """
    found = spec.calibration
    if found is None:
        return spec
    material = spec.material.model_copy(update={"elastic_modulus": found.elastic_modulus})
    changes: dict[str, object] = {"material": material}
    if found.friction is not None:
        changes["camshaft"] = spec.camshaft.model_copy(update={"friction": found.friction})
    return spec.model_copy(update=changes)


def root_coefficient(spec: RotaryFlexureSpec) -> float:
    """Extra root compliance of the calibration, over 1/(E t h^2)."""
    return 0.0 if spec.calibration is None else spec.calibration.root_coefficient


def calibrated_sources(spec: RotaryFlexureSpec) -> Mapping[str, Value]:
    """Values and sources as every report tells them, with those of the calibration."""
    known, found = dict(sources(spec.material, spec.process)), spec.calibration
    if found is None:
        return known
    material = known["material"]
    assert isinstance(material, Mapping)
    modulus: Mapping[str, Value] = {
        "value": found.elastic_modulus,
        "source": f"calibration: {_test(found)}",
    }
    return {
        **known,
        "material": {**material, "elastic_modulus_Pa": modulus},
        "calibration": {
            "design": found.design,
            "curve": found.curve,
            "elastic_modulus_Pa": found.elastic_modulus,
            "elastic_modulus_error_Pa": found.elastic_modulus_error,
            "root_coefficient": found.root_coefficient,
            "root_coefficient_error": found.root_coefficient_error,
            "friction": found.friction,
            "friction_error": found.friction_error,
        },
    }


def calibration_assumptions(spec: RotaryFlexureSpec) -> tuple[str, ...]:
    """What a calibrated design takes for granted; nothing for another."""
    found = spec.calibration
    if found is None:
        return ()
    words = []
    if found.elastic_modulus_error is not None:
        modulus, error = (
            show(value, STRESS) for value in (found.elastic_modulus, found.elastic_modulus_error)
        )
        words.append(f"an elastic modulus of {modulus} (standard error {error})")
    if found.root_coefficient_error is not None:
        words.append(
            f"an extra root compliance of {found.root_coefficient:.3g}/(E t h^2) "
            f"(standard error {found.root_coefficient_error:.2g})"
        )
    if found.friction is not None:
        words.append(f"a friction of {found.friction:.3g}")
    return (
        f"The design is calibrated by the {_test(found)}: {', '.join(words) or 'nothing new'}. "
        "One test of stiffness cannot tell a modulus from a root or a thickness: the calibration "
        "holds for the same sheet, cut and mounting.",
    )


def _test(found: Calibration) -> str:
    return f"bench test {found.curve} of {found.design}"
