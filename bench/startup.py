"""How long the command line takes before it does anything, each as a median."""

from __future__ import annotations

import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

REPEATS = 9
BAD_SPEC = "springcad: 1\nkind: rotary-flexure\nname: wrong\nstifness: 150 N*m/rad\n"


def startup_times() -> dict[str, float]:
    """Seconds of wall time of: python alone, the import, the help, a spec error."""
    with tempfile.TemporaryDirectory() as folder:
        spec = Path(folder) / "wrong.yaml"
        spec.write_text(BAD_SPEC)
        tool = ["-m", "springcad"]
        return {
            "python alone": _median(["-c", "pass"], 0),
            "import springcad": _median(["-c", "import springcad"], 0),
            "springcad --help": _median([*tool, "--help"], 0),
            "spec error": _median([*tool, "check", str(spec)], 3),
        }


def _median(arguments: list[str], exit_code: int) -> float:
    times = []
    for _ in range(REPEATS + 1):
        began = time.perf_counter()
        done = subprocess.run([sys.executable, *arguments], capture_output=True, check=False)
        times.append(time.perf_counter() - began)
        if done.returncode != exit_code:
            raise RuntimeError(f"{arguments}: exit code {done.returncode}\n{done.stderr.decode()}")
    return statistics.median(times[1:])  # the first fills the disk cache
