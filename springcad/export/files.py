"""Writing a set of files so that neither a crash nor a full disk ever leaves a torn or lost one.

Every file is first written in full to a temporary file beside its target and synced; only when all
of them are on the disk are they moved into place, one after another in the order given. A failure
before that leaves the earlier files as they were; the name of a temporary file
(``.NAME.springcad-RANDOM.tmp``) lets the next run find and remove what a killed run left behind.
"""

from __future__ import annotations

import errno
import os
import secrets
import sys
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import BinaryIO

from springcad.errors import OutputError

if sys.platform != "win32":
    import fcntl

_PLAIN_WORDS = {
    errno.ENOSPC: "no space left on the disk",
    errno.EDQUOT: "the disk quota is used up",
    errno.EROFS: "the file system is read-only",
    errno.EACCES: "permission denied",
    errno.EPERM: "permission denied",
    errno.ENOTDIR: "a file stands where a folder is needed",
    errno.EEXIST: "a file stands where a folder is needed",
    errno.EISDIR: "a folder stands in the place of the file",
    errno.ENAMETOOLONG: "the name is too long",
}


def write_files(directory: Path, files: Mapping[str, bytes | str]) -> tuple[Path, ...]:
    """Write ``files`` atomically: name relative to ``directory`` (``a/b.txt``) → content.

    Text is written as UTF-8 with the line ends it has. Missing folders are made. The files are
    moved into place in the order of the mapping: the last, a manifest, vouches for the others.

    Raises:
        OutputError: a name leaves ``directory``, a folder or target is a symbolic link or not what
            it has to be, an entry that differs only in case is there, or the system refuses.
    """
    targets = _check_targets(directory, files)
    with _plain_errors(directory), _new_folders(path.parent for path in targets.values()):
        for folder in dict.fromkeys(path.parent for path in targets.values()):
            _sweep(folder)
        _write_all({targets[name]: _encode(content) for name, content in files.items()})
    return tuple(targets.values())


def check_writable(directory: Path, names: Iterable[str]) -> None:
    """Raise the ``OutputError`` that ``write_files`` would raise, as far as can be known before.

    Called before a long calculation. Leaves nothing behind.
    """
    targets = _check_targets(directory, names)
    with _plain_errors(directory):
        for folder in dict.fromkeys(path.parent for path in targets.values()):
            existing = next(parent for parent in (folder, *folder.parents) if parent.exists())
            _sweep(existing)
            temporary = _open_temporary(existing / "probe")
            try:
                temporary.write(b"springcad")
                temporary.flush()
            finally:
                _discard(temporary)


def _encode(content: bytes | str) -> bytes:
    return content.encode("utf-8") if isinstance(content, str) else content


def _check_targets(directory: Path, names: Iterable[str]) -> dict[str, Path]:
    """Name → path for every name, all of them safe to write."""
    targets: dict[str, Path] = {}
    for name in names:
        path = directory
        for component in name.split("/"):
            if not _is_safe(component):
                raise OutputError(f"{name!r} is not a safe name for a file inside {directory}")
            path = path / component
            _check_entry(path)
        if path.exists() and not path.is_file():
            raise OutputError(f"{path} is there already and is not an ordinary file")
        targets[name] = path
    if len({name.casefold() for name in targets}) < len(targets):
        raise OutputError(f"{directory}: two of the files differ only in the case of letters")
    return targets


def _is_safe(component: str) -> bool:
    """Whether ``component`` names an entry of its folder on every system, and nothing else."""
    hostile = any(c in "\\:" or not c.isprintable() for c in component)
    return component not in ("", ".", "..") and not hostile


def _check_entry(path: Path) -> None:
    """Refuse what stands at ``path``, or beside it, if it would lead the writing elsewhere."""
    with _plain_errors(path):
        try:
            siblings = os.listdir(path.parent)
        except FileNotFoundError:
            return
        for entry in siblings:
            if entry != path.name and entry.casefold() == path.name.casefold():
                raise OutputError(
                    f"{path}: {entry!r} is there already and differs only in the case of letters;"
                    " many file systems take the two for one"
                )
        if path.is_symlink():
            raise OutputError(f"{path} is a symbolic link; nothing is written through it")


@contextmanager
def _plain_errors(place: Path) -> Iterator[None]:
    """Turn the system's refusals into an ``OutputError`` in plain words."""
    try:
        yield
    except OSError as error:
        reason = _PLAIN_WORDS.get(error.errno or 0) or error.strerror or type(error).__name__
        where = error.filename or place
        message = f"cannot write {where}: {reason}; what was there before is kept"
        raise OutputError(message) from error


@contextmanager
def _new_folders(folders: Iterable[Path]) -> Iterator[None]:
    """Make the missing folders; take the new ones away again when the writing fails."""
    made: list[Path] = []
    try:
        for folder in folders:
            missing = [parent for parent in (folder, *folder.parents) if not parent.exists()]
            for path in reversed(missing):
                path.mkdir()
                made.append(path)
        yield
    except BaseException:
        for path in reversed(made):
            with suppress(OSError):
                path.rmdir()
        raise
    for path in made:
        _sync_folder(path.parent)


def _write_all(contents: Mapping[Path, bytes]) -> None:
    """Write every content beside its target, then move them all into place."""
    staged: list[tuple[BinaryIO, Path]] = []
    try:
        for target, content in contents.items():
            temporary = _open_temporary(target)
            staged.append((temporary, target))
            temporary.write(content)
            temporary.flush()
            os.fsync(temporary.fileno())
        for temporary, target in staged:
            if sys.platform == "win32":  # which cannot move an open file
                temporary.close()
            os.replace(temporary.name, target)
        for folder in dict.fromkeys(target.parent for target in contents):
            _sync_folder(folder)
    finally:
        for temporary, _ in staged:
            _discard(temporary)


def _open_temporary(target: Path) -> BinaryIO:
    """A new file beside ``target``, locked as long as it is open so that no other run sweeps it."""
    name = target.with_name(f".{target.name}.springcad-{secrets.token_hex(4)}.tmp")
    temporary = open(name, "xb")  # noqa: SIM115 (closed by _discard)
    with suppress(OSError):  # a file system without locks
        _lock(temporary)
    return temporary


def _lock(file: BinaryIO) -> None:
    """Mark ``file`` as in use; OSError when another process holds it."""
    if sys.platform != "win32":  # where an open file cannot be removed anyway
        fcntl.flock(file.fileno(), fcntl.LOCK_EX | fcntl.LOCK_NB)


def _discard(temporary: BinaryIO) -> None:
    """Close and remove a temporary file, wherever its life ended."""
    with suppress(OSError):  # what a full disk did not take is flushed again on closing
        temporary.close()
    Path(temporary.name).unlink(missing_ok=True)


def _sweep(folder: Path) -> None:
    """Remove the temporary files of killed runs; those of a run at work are locked and stay."""
    for path in sorted(folder.glob(".*.springcad-????????.tmp")):
        with suppress(OSError), open(path, "rb") as left_behind:
            _lock(left_behind)
            path.unlink()


def _sync_folder(folder: Path) -> None:
    """Make the new names in ``folder`` last through a power cut, where the system can."""
    with suppress(OSError):
        descriptor = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(descriptor)
        finally:
            os.close(descriptor)
