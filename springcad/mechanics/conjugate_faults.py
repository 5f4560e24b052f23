"""Why a part cannot follow a torque law: at which angle, and by how much."""

from __future__ import annotations

from typing import NoReturn

import numpy as np
from numpy.typing import NDArray

from springcad.errors import InfeasibleError
from springcad.mechanics.conjugate_contact import TOUCH, Search
from springcad.mechanics.elastic_part import ElasticPart
from springcad.mechanics.torque_law import TorqueLaw

Floats = NDArray[np.float64]

_STATIONS = 33


def refuse_search(
    part: ElasticPart, law: TorqueLaw, count: int, limits: tuple[float, float], search: Search
) -> NoReturn:
    """Say why there is no contact at the first angle at which none was found.

    Args:
        law: of all ``count`` parts.
        search: for one of them.

    Raises:
        InfeasibleError: always.
    """
    first = int(np.argmin(search.found))
    if first == 0 and law.begins_at_rest:
        raise _wrong_slope(part, law, count, limits)
    if np.isnan(search.contact.excess[first]):
        claim = f"torque at {_degrees(law.angle[first])}, which no force on the part gives"
        raise InfeasibleError(claim, float(law.torque[first]), np.nan, "N*m")
    raise _wrong_energy(part, law, search, first)


def _wrong_slope(
    part: ElasticPart, law: TorqueLaw, count: int, limits: tuple[float, float]
) -> InfeasibleError:
    """The law is stiffer or softer at rest than the part with any contact."""
    station = np.linspace(*limits, _STATIONS)
    rest = part(np.full_like(station, law.angle[0]), np.full_like(station, TOUCH), station)
    with np.errstate(all="ignore"):
        stiffness = 0.5 * count * (TOUCH * rest.arm) ** 2 / rest.energy
    softest, stiffest = int(np.nanargmin(stiffness)), int(np.nanargmax(stiffness))
    bounds = [f"{stiffness[i]:.4g} N*m/rad ({_contact(rest.arc[i])})" for i in (softest, stiffest)]
    claim = f"slope of the law at rest, where the stiffness can be {bounds[0]} to {bounds[1]}"
    nearest = softest if law.stiffness_at_rest < stiffness[softest] else stiffest
    return InfeasibleError(claim, law.stiffness_at_rest, float(stiffness[nearest]), "N*m/rad")


def _wrong_energy(part: ElasticPart, law: TorqueLaw, search: Search, first: int) -> InfeasibleError:
    """Giving the torque the part holds more or less than the law has stored, at any contact."""
    angle, stored = law.angle[first], float(law.energy[first])
    held = []
    for trial in (search.contact, search.farthest):
        force, station = trial.force[[first]], trial.station[[first]]
        arc = part(law.angle[[first]], force, station).arc[0]
        held.append((stored * float(np.exp(trial.excess[first])), _contact(arc)))
    soft = held[0][0] > stored
    excess = np.where(search.found, 0.0, np.nan_to_num(search.contact.excess))
    worst = int(np.argmax(excess if soft else -excess))
    bounds = " to ".join(f"{energy:.4g} J ({contact})" for energy, contact in sorted(held))
    claim = (
        f"energy that the law stores up to {_degrees(angle)}; giving its {law.torque[first]:.4g} "
        f"N*m there the elastic parts hold {bounds}: they are too {'soft' if soft else 'stiff'}, "
        f"by a factor of {np.exp(abs(excess[worst])):.4f} in stiffness at "
        f"{_degrees(law.angle[worst])}"
    )
    return InfeasibleError(claim, stored, held[0][0], "J")


def _contact(arc: float) -> str:
    return f"contact {1e3 * arc:.3f} mm along the surface"


def _degrees(angle: float) -> str:
    return f"{np.degrees(angle):.4g} deg"
