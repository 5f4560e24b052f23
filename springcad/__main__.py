"""``python -m springcad`` and the ``springcad`` command."""

from __future__ import annotations

import os
import sys


def main() -> None:
    """Run the command line and leave with its exit code."""
    # One thread, set before anything numeric loads: same bytes on every machine, and faster for
    # the small matrices of a spring.
    for variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
        os.environ.setdefault(variable, "1")
    try:
        from springcad.cli.run import run

        exit_code = run(sys.argv[1:])
    except KeyboardInterrupt:  # while still loading
        exit_code = 130
    sys.exit(exit_code)


if __name__ == "__main__":
    main()
