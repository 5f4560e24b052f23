"""Plane-stress finite elements for large deflections, with contact: the second opinion."""
