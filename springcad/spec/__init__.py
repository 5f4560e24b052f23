"""Reads a YAML spec into a validated model in SI units, with the line and column of every key."""
