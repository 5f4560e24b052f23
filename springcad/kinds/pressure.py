"""What a contact may bear, for every kind."""

PRESSURE_OVER_ULTIMATE = 1.6
"""Hertzian pressure over tensile strength that hardened steel bears statically: a common rule of
thumb (1.6 to 1.8), not a limit of any standard."""
