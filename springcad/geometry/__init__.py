"""Planar geometry: outlines, ribbons, splines, biarcs, offsets, clearance; numbers in and out."""
