"""Reproducible random numbers: raw PCG64 integers, mapped here.

The mapping is ours because numpy promises the raw stream of a bit generator for ever, but not
what its distributions make of it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def uniform(seed: int, stream: int, count: int) -> NDArray[np.float64]:
    """``count`` numbers in [0, 1) that depend on ``seed`` and ``stream`` alone.

    Start number ``stream`` of a search thus begins at the same point however many starts there
    are, and in whatever order or process they run.
    """
    raw = np.random.PCG64(np.random.SeedSequence([seed, stream])).random_raw(count)
    return (np.asarray(raw, dtype=np.uint64) >> np.uint64(11)).astype(np.float64) * 2.0**-53
