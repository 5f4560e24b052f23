"""Torque of a written spring on a test bench, in microseconds for any modulus, root and friction.

The flexures as beams are seated on the flank of the camshaft's drawing, with friction, once for
some root compliances and coefficients of friction; between these the secant compliance (angle over
torque) is interpolated. The elastic modulus needs no table: of a ring and a camshaft of given
shape, with every compliance in proportion to 1/E, all torques are in proportion to E, at any
deflection and with dry friction (docs/theory/calibration.md).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from springcad.kinds.rotary_flexure.drawn_flank import drawn_flank
from springcad.kinds.rotary_flexure.flexure_contact import NOSE_ALLOWANCE, flexure_part
from springcad.kinds.rotary_flexure.written_spring import WrittenSpring
from springcad.mechanics.beam import PreparedBeam, prepare
from springcad.mechanics.cam_contact import Seat, seat
from springcad.mechanics.lobatto import lagrange_basis_at
from springcad.written import IncompleteDesignError, WrittenDesign

Floats = NDArray[np.float64]

ANGLES = 32
"""Angles up to the design deflection at which the spring is seated."""
ROOTS = np.array([0.0, 8.0, 24.0])
"""Coefficients of extra root compliance in the table; -4 to 24 are within 0.02 % of a seat."""
FRICTIONS = np.array([-0.4, -0.2, 0.0, 0.2, 0.4])
"""Coefficients of friction in the table, negative where the tip is dragged the other way."""
