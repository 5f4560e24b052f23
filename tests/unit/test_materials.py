"""The material table and the shop rules: plausible, sourced, and the same as the papers print."""

from __future__ import annotations

import dataclasses
import subprocess
import sys

import pytest

from springcad.materials.data import MATERIALS, Material, Value, material
from springcad.materials.process import PROCESSES, process

VALUES = [
    (entry.name, field.name, value)
    for entry in MATERIALS.values()
    for field in dataclasses.fields(Material)
    if isinstance(value := getattr(entry, field.name), Value)
]
PLAUSIBLE = {
    "elastic_modulus": (1e9, 220e9),
    "poisson_ratio": (0.25, 0.4),
    "density": (1000.0, 9000.0),
    "yield_strength": (50e6, 2500e6),
    "flexural_strength": (50e6, 500e6),
    "ultimate_strength": (50e6, 2500e6),
    "fatigue_strength": (50e6, 1000e6),
}


@pytest.mark.parametrize(
    ("name", "key", "value"), VALUES, ids=[f"{name}-{key}" for name, key, _ in VALUES]
)
def test_every_value_has_a_source_a_range_that_holds_it_and_si_units(
    name: str, key: str, value: Value
) -> None:
    assert value.source
    low, high = PLAUSIBLE[key]
    assert low <= value.value <= high
    assert (value.low is None) == (value.high is None)
    if value.low is not None and value.high is not None:
        assert value.low <= value.value <= value.high


@pytest.mark.parametrize("entry", MATERIALS.values(), ids=lambda entry: entry.name)
def test_strengths_are_in_order(entry: Material) -> None:
    if entry.ultimate_strength is not None:
        assert entry.yield_strength.value < entry.ultimate_strength.value
    if entry.fatigue_strength is not None:
        assert entry.fatigue_strength.value < entry.yield_strength.value
    if entry.flexural_strength is not None:
        assert entry.family == "polymer"
        assert entry.flexural_strength.value > entry.yield_strength.value
    if entry.fatigue_cycles is not None:
        assert entry.fatigue_strength is not None
        assert "1e7 cycles" in entry.fatigue_strength.source


def test_the_steel_of_paper_001_is_as_printed_but_for_the_modulus() -> None:
    entry = material("50crva")
    assert entry.yield_strength.value == 1.32e9
    assert entry.poisson_ratio.value == 0.29
    assert entry.elastic_modulus.value == 100 * 2.06e9


def test_the_steel_of_paper_003() -> None:
    entry = material("65mn")
    assert entry.elastic_modulus.value == 208e9
    assert entry.yield_strength.value == 726e6


def test_the_steel_of_paper_004() -> None:
    entry = material("aisi-420")
    assert entry.elastic_modulus.value == 200e9
    assert entry.density.value == 7700.0
    assert entry.yield_strength.value == 1310e6


def test_weak_sources_are_marked() -> None:
    weak = {name for name, key, value in VALUES if key == "yield_strength" and value.weak}
    assert weak == {"maraging-300", "al-7075-t6"}


@pytest.mark.parametrize("name", PROCESSES)
def test_a_slot_is_as_wide_as_the_corner_radius_needs(name: str) -> None:
    rules = process(name)
    assert rules.name == name
    assert rules.source.startswith("springcad's default")
    assert 0.0 < 2.0 * rules.min_inside_radius <= rules.min_gap


def test_wire_edm_has_the_wire_and_the_spark_gap() -> None:
    rules = process("wire-edm")
    assert rules.min_inside_radius == pytest.approx(0.25e-3 / 2 + 0.025e-3)
    assert rules.min_gap == pytest.approx(0.25e-3 + 2 * 0.025e-3)


def test_unknown_names_are_key_errors() -> None:
    with pytest.raises(KeyError):
        material("unobtainium")
    with pytest.raises(KeyError):
        process("laserr")


def test_the_tables_load_nothing_heavy() -> None:
    code = (
        "import sys\n"
        "import springcad.materials.data, springcad.materials.process\n"
        "assert not {'numpy', 'pydantic', 'pint'} & set(sys.modules)\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True, timeout=60)
