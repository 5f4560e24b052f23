"""A whole run against full or read-only disks, kills, hostile folders; the same bytes twice."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
FAKE = ROOT / "tests" / "cli" / "fake_springcad.py"
THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
Mount = Callable[[str], Path]
Run = Callable[..., "subprocess.CompletedProcess[str]"]


def write_spec(folder: Path, behaviour: str = "good") -> Path:
    path = folder / "knee.yaml"
    text = "springcad: 1\nkind: fake\nname: knee\nsize: 20 mm\nprocess: laser\n"
    path.write_text(f"{text}behaviour: {behaviour}\n")
    return path


def contents(folder: Path) -> dict[str, bytes]:
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in folder.rglob("*")
        if path.is_file()
    }


def assert_not_written(run: subprocess.CompletedProcess[str], reason: str) -> None:
    """Exit code 6 and one plain line."""
    assert (run.returncode, run.stdout) == (6, "")
    (line,) = run.stderr.splitlines()
    assert line.startswith("knee.yaml: ")
    assert reason in line


def test_a_full_disk_is_6_and_keeps_the_earlier_design(
    run_with_fake_kind: Run, mount: Mount, tmp_path: Path
) -> None:
    disk = mount("size=128k")
    write_spec(tmp_path)
    assert run_with_fake_kind("design", "knee.yaml", "-o", disk).returncode == 0
    before = contents(disk)
    free = os.statvfs(disk).f_bavail * os.statvfs(disk).f_frsize
    (disk / "filler").write_bytes(b"x" * (free - 8192))
    run = run_with_fake_kind("design", "knee.yaml", "-o", disk, "--set", "size=30mm")
    assert_not_written(run, "no space left on the disk")
    (disk / "filler").unlink()
    assert contents(disk) == before


def test_a_read_only_disk_is_6(run_with_fake_kind: Run, mount: Mount, tmp_path: Path) -> None:
    disk = mount("size=128k,ro")
    write_spec(tmp_path)
    run = run_with_fake_kind("design", "knee.yaml", "-o", disk)
    assert_not_written(run, "the file system is read-only")


def test_no_room_for_temporary_files_is_6(
    run_with_fake_kind: Run, mount: Mount, tmp_path: Path
) -> None:
    disk = mount("size=4k")
    write_spec(tmp_path)
    run = run_with_fake_kind("design", "knee.yaml", env={"TMPDIR": str(disk)})
    assert_not_written(run, "no temporary copy of the drawings")
    assert not (tmp_path / "out").exists()


def test_a_file_in_place_of_the_folder_is_6(run_with_fake_kind: Run, tmp_path: Path) -> None:
    write_spec(tmp_path)
    (tmp_path / "out").write_text("mine")
    assert_not_written(run_with_fake_kind("design", "knee.yaml"), "where a folder is needed")
    assert (tmp_path / "out").read_text() == "mine"


def test_a_link_in_place_of_the_folder_is_6(run_with_fake_kind: Run, tmp_path: Path) -> None:
    write_spec(tmp_path)
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "knee").symlink_to(tmp_path / "elsewhere")
    assert_not_written(run_with_fake_kind("design", "knee.yaml"), "symbolic link")
    assert list((tmp_path / "elsewhere").iterdir()) == []


def test_an_output_folder_that_cannot_be_used_is_known_before_the_calculation(
    run_with_fake_kind: Run, tmp_path: Path
) -> None:
    """The kind would take a minute."""
    write_spec(tmp_path, "slow")
    (tmp_path / "out").write_text("mine")
    assert_not_written(run_with_fake_kind("design", "knee.yaml"), "where a folder is needed")


@pytest.mark.parametrize("name", ["../evil", "/etc/evil", "a/b", "..", "con", "a\\b", "-rf"])
def test_a_hostile_name_is_3_and_writes_nothing(
    run_with_fake_kind: Run, tmp_path: Path, name: str
) -> None:
    spec = write_spec(tmp_path)
    spec.write_text(spec.read_text().replace("knee", f"'{name}'"))
    run = run_with_fake_kind("design", "knee.yaml", "-o", "deep/out")
    assert (run.returncode, run.stdout) == (3, "")
    assert run.stderr.startswith("knee.yaml:3:7: name: ")
    assert list(tmp_path.iterdir()) == [spec]


@pytest.mark.parametrize(
    ("sent", "exit_code", "said"),
    [(signal.SIGINT, 130, "interrupted\n"), (signal.SIGTERM, -signal.SIGTERM, "")],
)
def test_an_interrupt_writes_nothing_and_keeps_the_earlier_design(
    run_with_fake_kind: Run, tmp_path: Path, sent: signal.Signals, exit_code: int, said: str
) -> None:
    write_spec(tmp_path)
    run_with_fake_kind("design", "knee.yaml")
    before = contents(tmp_path / "out")
    command = [sys.executable, str(FAKE), "design", "knee.yaml", "--set", "behaviour=slow"]
    # What runs in the background of a script is started with SIGINT ignored, and hands that on.
    run = subprocess.Popen(
        command,
        cwd=tmp_path,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )
    assert run.stderr is not None
    assert run.stderr.readline() == "at work\n"
    run.send_signal(sent)
    assert run.stderr.read() == said
    assert run.wait() == exit_code
    run.stderr.close()
    assert contents(tmp_path / "out") == before


def test_a_kill_while_writing_leaves_whole_files(run_with_fake_kind: Run, tmp_path: Path) -> None:
    """Two sizes by turns; each file stays one of the two whole ones, and what is left is swept."""
    write_spec(tmp_path)
    out = tmp_path / "out"
    whole: dict[str, set[bytes]] = {}
    for size in ("20mm", "30mm"):
        run_with_fake_kind("design", "knee.yaml", "--set", f"size={size}")
        for name, data in contents(out).items():
            whole.setdefault(name, set()).add(data)
    command = [sys.executable, str(FAKE), "design", "knee.yaml", "--set"]
    for k in range(4):
        size = ("20mm", "30mm")[k % 2]
        run = subprocess.Popen([*command, f"size={size}"], cwd=tmp_path, stdout=subprocess.DEVNULL)
        while run.poll() is None and not any(out.glob("knee/.knee.dxf.*.tmp")):
            time.sleep(0.0005)
        time.sleep(0.001 * k)
        run.kill()
        run.wait()
        for name, data in contents(out).items():
            assert name.endswith(".tmp") or data in whole[name], name
    assert run_with_fake_kind("design", "knee.yaml").returncode == 0
    assert set(contents(out)) == set(whole)


def same_bytes_everywhere(run: Run, spec: Path, tmp_path: Path, *options: str) -> dict[str, bytes]:
    """Design ``spec`` twice in surroundings that differ in all that should not matter.

    Numbers do not depend on the threads of the libraries either.
    The hash seeds are two for which sets of ezdxf's class names come in different orders.
    """
    here, there = tmp_path / "here", tmp_path / "there" / "with space"
    here.mkdir()
    there.mkdir(parents=True)
    (there / "ezdxf.ini").write_text("[core]\nwrite_fixed_meta_data_for_testing = false\n")
    first = run(
        "design",
        spec,
        *options,
        "-o",
        "out",
        cwd=here,
        env={"TZ": "UTC", "PYTHONHASHSEED": "1", "LANG": "C", **dict.fromkeys(THREADS, "1")},
    )
    second = run(
        "design",
        os.path.relpath(spec, there),
        *options,
        "-o",
        there / "elsewhere",
        cwd=there,
        env={
            "TZ": "Asia/Tokyo",
            "PYTHONHASHSEED": "4",
            "LANG": "de_DE.UTF-8",
            "COLUMNS": "200",
            **dict.fromkeys(THREADS, "2"),
        },
    )
    assert (first.returncode, second.returncode) == (0, 0), first.stderr + second.stderr
    files = contents(here / "out")
    assert files == contents(there / "elsewhere")
    return files


def test_the_same_spec_gives_the_same_bytes(run_with_fake_kind: Run, tmp_path: Path) -> None:
    files = same_bytes_everywhere(run_with_fake_kind, write_spec(tmp_path), tmp_path)
    assert len(files) == 5


@pytest.mark.slow
def test_a_real_design_gives_the_same_bytes(run_springcad: Run, tmp_path: Path) -> None:
    """Of S2 without its second opinion: search, beam and the finite elements of root and teeth."""
    spec = ROOT / "specs" / "S2.yaml"
    fewer = ("--no-verify", "--set", "optimiser.starts=2")
    files = same_bytes_everywhere(run_springcad, spec, tmp_path, *fewer)
    assert {Path(name).suffix for name in files} == {".dxf", ".svg", ".html", ".json"}
