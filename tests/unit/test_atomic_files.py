"""Files are written whole or not at all, under safe names, and only where they belong."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from springcad.errors import OutputError
from springcad.export.files import check_writable, write_files

OLD = {"knee/knee.dxf": "old drawing", "knee/manifest.json": "old manifest"}
NEW = {"knee/knee.dxf": "new drawing", "knee/manifest.json": "new manifest"}


def contents(folder: Path) -> dict[str, str]:
    """Relative path → text of every file below ``folder``, hidden ones too."""
    return {
        path.relative_to(folder).as_posix(): path.read_text(encoding="utf-8")
        for path in folder.rglob("*")
        if path.is_file()
    }


def test_text_and_bytes_land_as_they_are_in_new_folders(tmp_path: Path) -> None:
    out = tmp_path / "a" / "b"
    written = write_files(out, {"knee/a.txt": "µm\r\nline\n", "knee/b.bin": b"\x00\xff"})
    assert written == (out / "knee/a.txt", out / "knee/b.bin")
    assert (out / "knee/a.txt").read_bytes() == "µm\r\nline\n".encode()
    assert (out / "knee/b.bin").read_bytes() == b"\x00\xff"


def test_writing_again_replaces_and_leaves_nothing_else(tmp_path: Path) -> None:
    write_files(tmp_path, OLD)
    (tmp_path / "knee" / "notes.txt").write_text("mine")
    write_files(tmp_path, NEW)
    assert contents(tmp_path) == {**NEW, "knee/notes.txt": "mine"}


def test_files_get_the_rights_that_the_umask_gives(tmp_path: Path) -> None:
    (path,) = write_files(tmp_path, {"a.txt": "a"})
    (tmp_path / "plain").write_text("")
    assert path.stat().st_mode == (tmp_path / "plain").stat().st_mode


@pytest.mark.parametrize("failing_file", [0, 1])
def test_failure_while_writing_keeps_the_old_set(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, failing_file: int
) -> None:
    """Every temporary is on the disk before the first file is replaced."""
    write_files(tmp_path, OLD)
    synced: list[int] = []

    def fsync(descriptor: int) -> None:
        synced.append(descriptor)
        if len(synced) > failing_file:
            raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", fsync)
    with pytest.raises(OutputError, match="no space left on the disk"):
        write_files(tmp_path, NEW)
    assert contents(tmp_path) == OLD


def test_interrupt_while_writing_cleans_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupt(_: int) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "fsync", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write_files(tmp_path / "out", NEW)
    assert list(tmp_path.iterdir()) == [], "neither files nor the folders made for them stay"


def test_the_last_file_is_moved_into_place_last(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    moved: list[str] = []
    replace = os.replace
    monkeypatch.setattr(os, "replace", lambda a, b: (moved.append(Path(b).name), replace(a, b)))
    write_files(tmp_path, NEW)
    assert moved == ["knee.dxf", "manifest.json"]


@pytest.mark.parametrize(
    "name",
    ["../a", "knee/../../a", "/etc/a", "", "a/", "a//b", ".", "..", "a\\b", "C:a", "a\0b", "a\nb"],
)
def test_names_that_leave_the_folder_are_refused(tmp_path: Path, name: str) -> None:
    out = tmp_path / "out"
    with pytest.raises(OutputError, match="not a safe name"):
        write_files(out, {"good.txt": "good", name: "bad"})
    assert not out.exists()


def test_a_symbolic_link_in_place_of_a_file_is_refused(tmp_path: Path) -> None:
    victim = tmp_path / "victim"
    victim.write_text("precious")
    out = tmp_path / "out"
    (out / "knee").mkdir(parents=True)
    (out / "knee" / "knee.dxf").symlink_to(victim)
    with pytest.raises(OutputError, match="symbolic link"):
        write_files(out, NEW)
    assert victim.read_text() == "precious"
    assert contents(out / "knee") == {"knee.dxf": "precious"}


def test_a_symbolic_link_in_place_of_the_folder_is_refused(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "knee").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(OutputError, match="symbolic link"):
        write_files(tmp_path / "out", NEW)
    assert contents(tmp_path / "elsewhere") == {}


def test_the_output_folder_itself_may_be_a_link_that_the_user_made(tmp_path: Path) -> None:
    (tmp_path / "big-disk").mkdir()
    (tmp_path / "out").symlink_to(tmp_path / "big-disk")
    write_files(tmp_path / "out", NEW)
    assert contents(tmp_path / "big-disk") == NEW


@pytest.mark.parametrize("there", ["Knee/x", "knee/KNEE.dxf"])
def test_an_entry_that_differs_only_in_case_is_refused(tmp_path: Path, there: str) -> None:
    write_files(tmp_path, {there: "theirs"})
    with pytest.raises(OutputError, match="differs only in the case"):
        write_files(tmp_path, NEW)
    assert contents(tmp_path) == {there: "theirs"}


def test_two_new_files_that_differ_only_in_case_are_refused(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="case of letters"):
        write_files(tmp_path, {"a.txt": "1", "A.txt": "2"})
    assert contents(tmp_path) == {}


def test_a_file_where_a_folder_is_needed(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("a file")
    with pytest.raises(OutputError, match="a file stands where a folder is needed"):
        write_files(tmp_path / "out", NEW)
    assert (tmp_path / "out").read_text() == "a file"


def test_a_folder_where_a_file_is_needed(tmp_path: Path) -> None:
    (tmp_path / "knee" / "knee.dxf").mkdir(parents=True)
    with pytest.raises(OutputError, match="not an ordinary file"):
        write_files(tmp_path, NEW)
    assert not (tmp_path / "knee" / "manifest.json").exists()


def test_a_name_that_the_system_cannot_hold(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="name is too long"):
        write_files(tmp_path, {"n" * 300: "x"})
    assert contents(tmp_path) == {}


def test_temporaries_of_a_killed_run_are_swept_at_the_next(tmp_path: Path) -> None:
    write_files(tmp_path, OLD)
    (tmp_path / "knee" / ".knee.dxf.springcad-0123abcd.tmp").write_text("half")
    (tmp_path / "knee" / ".other.tmp").write_text("not ours")
    write_files(tmp_path, NEW)
    assert contents(tmp_path) == {**NEW, "knee/.other.tmp": "not ours"}


@pytest.mark.skipif(os.name == "nt", reason="POSIX file locks")
def test_temporaries_of_a_run_at_work_are_left_alone(tmp_path: Path) -> None:
    import fcntl

    live = tmp_path / "knee" / ".knee.dxf.springcad-0123abcd.tmp"
    write_files(tmp_path, OLD)
    with live.open("w") as held:
        fcntl.flock(held, fcntl.LOCK_EX)
        write_files(tmp_path, NEW)
        assert live.exists()
    write_files(tmp_path, NEW)
    assert not live.exists()


def test_asking_whether_a_folder_can_be_written_leaves_nothing(tmp_path: Path) -> None:
    check_writable(tmp_path / "a" / "b", ["knee/manifest.json"])
    assert contents(tmp_path) == {}
    assert list(tmp_path.iterdir()) == []


def test_asking_finds_what_writing_would_find(tmp_path: Path) -> None:
    (tmp_path / "knee").write_text("a file")
    with pytest.raises(OutputError, match="a file stands where a folder is needed"):
        check_writable(tmp_path, ["knee/manifest.json"])
