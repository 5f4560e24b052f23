"""Words that the calculation sheets of all kinds share."""

from __future__ import annotations

import math


def chosen_within(length: float, low: float, high: float) -> str:
    """Between which bounds a length [m] was chosen, and which of them holds it."""
    ends = {"its lower bound": low, "its upper bound": high}
    at = [words for words, end in ends.items() if math.isclose(length, end, rel_tol=1e-6)]
    return f"from {1e3 * low:g} to {1e3 * high:g} mm{', at ' + at[0] if at else ''}"
