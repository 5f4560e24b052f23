"""The whole element pressed by the roller: contact finite elements over the stroke.

Nonlinear plane stress of mount, cantilever and contact part against a rigid roller. Nothing of the
design's models is in it: no beam, no compliance, no point of contact, no torque law.

The roller goes down by R sin β; here it stays and the mount goes up by as much. Seen along the
axis of bending it is an ellipse that grows flatter with β, so each angle has its own.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.roller_cam.contact_compliance import element_model
from springcad.kinds.roller_cam.element import ElementGeometry
from springcad.kinds.roller_cam.element_mesh import Density, fine
from springcad.kinds.roller_cam.joint import Roller
from springcad.mechanics.fem.contact import prepare_contact
from springcad.mechanics.fem.model import Load, Model, State, with_contact
from springcad.mechanics.fem.newton import NoEquilibriumError, solve_path
from springcad.mechanics.fem.recovery import edge_points, edge_stress
from springcad.mechanics.fem.rigid_profile import RigidProfile, rigid_profile

Floats = NDArray[np.float64]

PENALTY = 100.0
"""Pressure per penetration of the contact before its multipliers are updated once, over the elastic
modulus per radius of the roller."""
_CONTACT_POINTS = 6
"""Per edge: at small angles the strip of contact is shorter than an edge."""
_OUTLINE = 720


@dataclass(frozen=True)
class ElementContact:
    """The element and its roller; made by ``element_contact``."""

    geometry: ElementGeometry
    roller: Roller
    model: Model


@dataclass(frozen=True)
class Press:
    """The element with the drum turned to ``angle``, a magnitude [rad]."""

    angle: float
    state: State

    @property
    def force(self) -> Floats:
        """Of the roller on the element (2,) [N]."""
        assert self.state.contact is not None
        return self.state.contact.force


def element_contact(
    geometry: ElementGeometry, roller: Roller, density: Density | None = None
) -> ElementContact:
    """Mesh, a fine one unless another is given, supports and contact.

    Raises:
        InfeasibleError: the parts of the element do not fit together.
    """
    held = element_model(geometry, density or fine(roller.radius))
    contact = prepare_contact(
        held.solid,
        "contact",
        _tilted(roller, 0.0),
        PENALTY * geometry.cantilever.elastic_modulus / roller.radius,
        points_per_edge=_CONTACT_POINTS,
        augmentations=1,
    )
    return ElementContact(geometry, roller, with_contact(held, contact))


def press_through(element: ElementContact, angles: Sequence[float]) -> list[Press]:
    """Turn the drum to each of ``angles`` (ascending magnitudes, rad); as far as it goes.

    The list ends before the first angle for which no equilibrium is found.
    """
    presses: list[Press] = []
    state: State | None = None
    for angle in angles:
        try:
            (state,) = solve_path(turned(element, angle), [raised(element, angle)], state)
        except NoEquilibriumError:
            break
        presses.append(Press(angle, state))
    return presses


def torque(element: ElementContact, press: Press) -> float:
    """Of one group against the drum by exact virtual work, positive (N m).

    A point of the roller at the height y over its centre goes down by R cos β + y tan β per angle.
    """
    contact, pair, roller = press.state.contact, element.model.contact, element.roller
    assert contact is not None
    assert pair is not None
    push = -pair.weights * contact.pressure * contact.near.normal[..., 1]
    height = contact.positions[..., 1] - roller.offset
    reach = roller.drum_radius * np.cos(press.angle) + height * np.tan(press.angle)
    return float(np.sum(push * reach))


def root_stress(element: ElementContact, press: Press) -> float:
    """Largest stress where the cantilever begins: in its root fillets and beside them (Pa)."""
    return max(
        float(np.max(np.abs(_stress(element, press, edges))))
        for edges in ("root", "upper side", "lower side")
    )


def side_stress(element: ElementContact, press: Press) -> float:
    """Largest stress along the sides of the cantilever, farther from its ends than its height (Pa).

    There it is that of a beam: without the notch of the fillets.
    """
    mesh, beam = element.model.solid.mesh, element.geometry.cantilever
    ends = (beam.height - beam.length, element.geometry.foot.center[0] - beam.height)
    largest = 0.0
    for edges in ("upper side", "lower side"):
        x = edge_points(mesh, edges)[..., 0].ravel()
        stress = np.abs(_stress(element, press, edges)).ravel()
        order = np.argsort(x)
        plain = stress[(x > ends[0]) & (x < ends[1])]
        at_ends = np.interp(ends, x[order], stress[order])
        largest = max(largest, float(np.max(plain, initial=0.0)), float(np.max(at_ends)))
    return largest


def contact_part_stress(element: ElementContact, press: Press) -> float:
    """Largest stress along the back of the contact part and in the fillet at its foot (Pa)."""
    return max(float(np.max(np.abs(_stress(element, press, edges)))) for edges in ("back", "foot"))


def _stress(element: ElementContact, press: Press, edges: str) -> Floats:
    return edge_stress(element.model.solid, press.state.displacement, edges)


def _tilted(roller: Roller, angle: float) -> RigidProfile:
    """The roller at rest, tilted by ``angle``: an ellipse."""
    around = np.linspace(0.0, 2.0 * np.pi, _OUTLINE + 1)
    half = roller.radius * np.array([1.0, np.cos(angle)])
    points = half * np.column_stack([np.cos(around), np.sin(around)])
    tangents = half * np.column_stack([-np.sin(around), np.cos(around)])
    return rigid_profile(points + np.array([roller.start, roller.offset]), tangents)


def turned(element: ElementContact, angle: float) -> Model:
    """The model with the roller as it is seen at an angle."""
    contact = element.model.contact
    assert contact is not None
    return replace(element.model, contact=replace(contact, profile=_tilted(element.roller, angle)))


def raised(element: ElementContact, angle: float) -> Load:
    """The mount moved up by what the roller moves down."""
    unknowns = element.model.solid.mesh.unknowns
    prescribed = np.zeros(unknowns)
    slaves = element.model.constraints.equations.slaves
    prescribed[slaves[slaves % 2 == 1]] = element.roller.drum_radius * np.sin(angle)
    return Load(np.zeros(unknowns), prescribed)
