"""Full disks, read-only disks and kills: the earlier files survive, and nothing is ever torn."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from springcad.errors import OutputError
from springcad.export.files import check_writable, write_files

Mount = Callable[[str], Path]


def all_files(folder: Path) -> dict[str, bytes]:
    return {p.relative_to(folder).as_posix(): p.read_bytes() for p in folder.rglob("*.*")}


def test_a_full_disk_keeps_the_old_set(mount: Mount) -> None:
    disk = mount("size=64k")
    old = {"knee/a.dxf": b"a" * 8192, "knee/manifest.json": b"{}"}
    write_files(disk, old)
    with pytest.raises(OutputError, match="no space left on the disk"):
        write_files(disk, {"knee/a.dxf": b"b" * 8192, "knee/manifest.json": b"m" * 80_000})
    assert all_files(disk) == old


def test_a_full_disk_is_known_before_the_calculation(mount: Mount) -> None:
    disk = mount("size=16k")
    with pytest.raises(OSError, match="No space left"):
        (disk / "filler").write_bytes(b"x" * 65536)
    with pytest.raises(OutputError, match="no space left on the disk"):
        check_writable(disk, ["knee/manifest.json"])


def test_a_read_only_disk(mount: Mount) -> None:
    disk = mount("size=64k")
    old = {"knee/a.dxf": b"a"}
    write_files(disk, old)
    subprocess.run(["mount", "-o", "remount,ro", str(disk)], check=True)
    for attempt in (check_writable, write_files):
        with pytest.raises(OutputError, match="the file system is read-only"):
            attempt(disk, {"knee/a.dxf": b"b"})
    assert all_files(disk) == old


@pytest.mark.skipif(os.name != "nt" and os.geteuid() == 0, reason="root may write anywhere")
def test_a_folder_without_permission(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    try:
        with pytest.raises(OutputError, match="permission denied"):
            check_writable(tmp_path, ["knee/a.dxf"])
    finally:
        tmp_path.chmod(0o700)


WRITER = textwrap.dedent("""
    import itertools, sys
    from pathlib import Path
    from springcad.export.files import write_files

    for i in itertools.count():
        letter = "ab"[i % 2]
        write_files(Path(sys.argv[1]), {"knee/x.dxf": letter * 2_000_000, "knee/y.json": letter})
        print(i, flush=True)
""")


def test_a_kill_leaves_whole_files_and_the_next_run_sweeps(tmp_path: Path) -> None:
    """Killed at ten moments of writing: each file is entirely old or entirely new."""
    for k in range(10):
        writer = subprocess.Popen(
            [sys.executable, "-c", WRITER, str(tmp_path)], stdout=subprocess.PIPE
        )
        assert writer.stdout is not None
        writer.stdout.readline()
        time.sleep(0.003 * k)
        writer.send_signal(signal.SIGKILL)
        writer.wait()
        writer.stdout.close()
        drawing = (tmp_path / "knee/x.dxf").read_text()
        assert drawing in ("a" * 2_000_000, "b" * 2_000_000)
        assert (tmp_path / "knee/y.json").read_text() in ("a", "b")
    write_files(tmp_path, {"knee/x.dxf": "", "knee/y.json": ""})
    assert sorted(p.name for p in (tmp_path / "knee").iterdir()) == ["x.dxf", "y.json"]
