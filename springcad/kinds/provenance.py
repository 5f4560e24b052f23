"""Where the numbers of a design come from, as every report tells it."""

from __future__ import annotations

from collections.abc import Mapping

from springcad.result import Value
from springcad.spec.common import ProcessSpec
from springcad.spec.material import MaterialSpec


def sources(material: MaterialSpec, process: ProcessSpec) -> Mapping[str, Value]:
    """Values and sources of the material (SI), name and source of the shop rules."""
    values = material.values
    return {
        "material": {
            key: {"value": value.value, "source": value.source}
            for key, value in (
                ("elastic_modulus_Pa", values.elastic_modulus),
                ("poisson_ratio", values.poisson_ratio),
                ("density", values.density),
                ("yield_strength_Pa", values.yield_strength),
            )
        },
        "process": {"name": process.name, "source": process.rules.source},
    }
