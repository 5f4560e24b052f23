"""CalculiX as a stopwatch: run a deck of springcad's and read the last displacements back."""

from __future__ import annotations

import os
import re
import resource
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

PROGRAM = shutil.which("ccx")


def run(deck: str, nodes: int, timeout: float = 900.0) -> tuple[float, NDArray[np.float64]]:
    """Processor seconds of the whole run, one thread, and last displacements (nodes, 2) [m]."""
    if PROGRAM is None:
        raise RuntimeError("ccx is not installed")
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "job.inp").write_text(deck)
        began = _processor_time()
        done = subprocess.run(
            [PROGRAM, "job"],
            cwd=folder,
            env={**os.environ, "OMP_NUM_THREADS": "1"},
            capture_output=True,
            text=True,
            timeout=timeout,
            check=True,
        )
        seconds = _processor_time() - began
        if "*ERROR" in done.stdout:
            raise RuntimeError(done.stdout[-2000:])
        return seconds, _last_displacements((Path(folder) / "job.dat").read_text(), nodes)


def _processor_time() -> float:
    """Of all finished child processes."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def version() -> str | None:
    """As the program says it; None where it is not installed."""
    if PROGRAM is None:
        return None
    done = subprocess.run([PROGRAM, "-v"], capture_output=True, text=True, check=False)
    return done.stdout.strip()


def _last_displacements(printed: str, nodes: int) -> NDArray[np.float64]:
    last = printed.split(" displacements (vx,vy,vz) for set PART ")[-1]
    block = re.split(r"\n\s*\n(?= [a-z])", last)[0]
    rows = re.findall(r"^\s+(\d+)\s+(\S+)\s+(\S+)\s+\S+$", block, flags=re.MULTILINE)
    found = np.full((nodes, 2), np.nan)
    for node, x, y in rows:
        found[int(node) - 1] = float(x), float(y)
    return found
