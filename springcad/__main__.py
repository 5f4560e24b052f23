"""``python -m springcad`` and the ``springcad`` command."""

from __future__ import annotations

import gc
import os
import sys

_COLLECTED_AFTER = 50_000
"""New objects between two searches of the garbage collector."""


def main() -> None:
    """Run the command line and leave with its exit code."""
    # One thread, set before anything numeric loads: same bytes on every machine, and faster for
    # the small matrices of a spring.
    for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(variable, "1")
    # Arrays are freed by reference counts; the search for cycles among what was just imported is a
    # tenth of the time of a design and finds next to nothing.
    gc.set_threshold(_COLLECTED_AFTER)
    try:
        from springcad.cli.run import run

        exit_code = run(sys.argv[1:])
    except KeyboardInterrupt:  # while still loading
        exit_code = 130
    sys.exit(exit_code)


if __name__ == "__main__":
    main()
