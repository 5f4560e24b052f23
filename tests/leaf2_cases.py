"""The actuator of paper 003, for the tests of the kind leaf-2dof."""

from __future__ import annotations

import numpy as np

from springcad.kinds.leaf_2dof.leaf import Leaf, Lever

MM = 1e-3
DEGREE = np.pi / 180.0
LEAVES = 2
"""Under load per axis and direction; not in the paper, but Table 1 has their stiffness."""
YIELD = 726e6
PAPER_LEAF = Leaf(10 * MM, 0.6 * MM, 208e9, 0.3)
PAPER_LEVER = Lever(25 * MM, 5 * MM, "outboard")
INBOARD = Lever(25 * MM, 5 * MM, "inboard")
PAPER_BEND = 12.04 * DEGREE
PAPER_TURN = 14.83 * DEGREE
