"""Leaves and fittings that several tests of the lever arm share.

The omega leaves are stored results of the search: enclosure of 50 mm radius, 10 mm to both sides,
corridor of 12 mm, in steel (210 GPa, 950 MPa) and POM (2.6 GPa, 90 MPa), the materials of paper
000, III-D.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from springcad.kinds.lever_arm.omega import OmegaCase, OmegaLeaf
from springcad.kinds.lever_arm.straight import Fittings

FITTINGS = Fittings(
    pin_diameter=4e-3,
    eye_wall=2e-3,
    eye_fillet=1e-3,
    root_fillet=1e-3,
    min_web=1e-3,
    block_length=12e-3,
    block_height=0.0,
    hole_count=2,
    hole_diameter=4e-3,
)

STEEL = OmegaCase(
    enclosure_radius=50e-3,
    stroke=10e-3,
    elastic_modulus=210e9,
    poisson_ratio=0.3,
    allowable_stress=950e6,
    min_web=0.3e-3,
    min_gap=0.3e-3,
    hub_radius=5e-3,
)
POM = replace(
    STEEL,
    elastic_modulus=2.6e9,
    poisson_ratio=0.35,
    allowable_stress=90e6,
    min_web=0.8e-3,
    hub_radius=6e-3,
)
STEEL_LEAF = OmegaLeaf(
    np.array([0.852984, 2.562775, 0.955498, -1.487604, -3.710630, 3.577874, -3.362361, -2.607839,
              0.480381, 1.975638, -0.271628]),
    1e-3 * np.array([1.955025, 2.915933, 5.184112, 3.171035, 0.707050, 4.459015, 0.642349,
                     4.311109, 2.973077, 0.365664]),
    245.363208e-3, 0.000000e-3, 5e-3,
)  # fmt: skip
POM_LEAF = OmegaLeaf(
    np.array([0.087532, -0.154035, -0.589789, -0.863572, -0.693007, -1.608966, -2.214288, -2.168577,
              -2.173962, -2.168127, -2.170195]),
    1e-3 * np.array([5.983964, 7.894768, 7.483643, 5.456961, 4.856765, 8.681849, 12.404391,
                     15.602665, 18.342050, 19.565187]),
    101.558724e-3, 37.789294e-3, 6e-3,
)  # fmt: skip
