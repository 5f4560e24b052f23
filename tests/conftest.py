"""Fixtures that every test may use; nothing numeric is imported before the threads are fixed."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import settings

for _variable in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ.setdefault(_variable, "1")

settings.register_profile("springcad", deadline=None, derandomize=True, print_blob=True)
settings.load_profile("springcad")


LONGEST_FIRST = ("unit/test_docs.py", "cli/test_rotary_infeasible.py")
"""Files with the longest tests: begun first, or a processor would wait for one at the end."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    items.sort(key=lambda item: not str(item.path).endswith(LONGEST_FIRST))


IN_CI = bool(os.environ.get("SPRINGCAD_CI"))
"""Set by .ci/run, which installs every tool: there a missing tool is a failure, not a skip."""


def skip_or_fail(reason: str) -> None:
    """Skip the running test for ``reason``; in CI, where nothing may be missing, fail it."""
    if IN_CI:
        pytest.fail(f"{reason}, and SPRINGCAD_CI is set: here it has to be there")
    pytest.skip(reason)


@pytest.fixture
def require_tool() -> Callable[[str], str]:
    """``require_tool("ogrinfo")``: path of an external program; skips (in CI: fails) without it."""

    def find(program: str) -> str:
        path = shutil.which(program)
        if path is None:
            skip_or_fail(f"{program} is not installed")
        assert path is not None
        return path

    return find


Run = Callable[..., subprocess.CompletedProcess[str]]


@pytest.fixture
def run_springcad(tmp_path: Path) -> Run:
    """``run_springcad("design", "a.yaml", cwd=..., env={...})``: a real process, as a user has it.

    The working directory is ``tmp_path`` unless told; ``env`` is added to a plain environment.
    """
    return _runner([sys.executable, "-m", "springcad"], tmp_path)


@pytest.fixture
def run_with_fake_kind(tmp_path: Path) -> Run:
    """The same with the kind of ``tests/cli/fake_springcad.py``, which designs in no time."""
    return _runner([sys.executable, str(Path(__file__).parent / "cli/fake_springcad.py")], tmp_path)


def _runner(command: list[str], directory: Path) -> Run:
    def run(
        *arguments: str | Path, cwd: Path | None = None, env: dict[str, str] | None = None
    ) -> subprocess.CompletedProcess[str]:
        # With PYTHONPATH the process runs the very code that the tests import.
        kept = ("PATH", "PYTHONPATH", "HOME", "TMPDIR", "SYSTEMROOT", "LD_LIBRARY_PATH")
        plain = {name: os.environ[name] for name in kept if name in os.environ}
        return subprocess.run(
            [*command, *map(str, arguments)],
            cwd=cwd or directory,
            env={**plain, "PYTHONIOENCODING": "utf-8", **(env or {})},
            capture_output=True,
            text=True,
            encoding="utf-8",
            timeout=120,
            check=False,
        )

    return run
