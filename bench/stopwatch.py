"""Time of the processor, so that what else runs on the machine counts as little as possible.

On one thread and a machine of its own it is the time that passes.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import TypeVar

Result = TypeVar("Result")


def best_time(run: Callable[[], Result], seconds: float) -> tuple[float, Result]:
    """Shortest processor time of the runs that fit into ``seconds``, two at least, and a result."""
    times: list[float] = []
    while len(times) < 2 or sum(times) < seconds:
        began = time.process_time()
        result = run()
        times.append(time.process_time() - began)
    return min(times), result
