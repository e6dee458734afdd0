"""Atomic writes: files and folders that are whole or absent, whatever stops the process."""

from __future__ import annotations

import contextlib
import hashlib
import os
import secrets
import shutil
import sys
import time
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import IO

from gbnbench.core.errors import InputError

if sys.platform != "win32":
    import fcntl

Writer = Callable[[IO[bytes]], object]
YOUNG = 1.0  # seconds that a temporary file has to be locked after it was made


def write_whole(path: Path, data: bytes | Iterable[bytes], *, make_folder: bool = True) -> None:
    """Write a file so that a reader, a crash or a full disk sees the old content or the new, never a part.

    Parameters
    ----------
    path : Path
        Where it shall stand.
    data : bytes or iterable of bytes
        The whole content, or its parts in turn.
    make_folder : bool
        Make its folder where it is missing.

    Raises
    ------
    OSError
        If the disk is full or the place cannot be written; nothing is left behind.
    """
    if make_folder:
        path.parent.mkdir(parents=True, exist_ok=True)
    remove_leftovers_of(path)
    temporary = _temporary(path)
    try:
        with temporary.open("xb") as file:
            with contextlib.suppress(OSError):  # a file system without locks
                _hold(file)
            file.writelines((data,) if isinstance(data, bytes) else data)
            file.flush()
            os.fsync(file.fileno())
            if sys.platform != "win32":  # still held, so that nobody takes it for a leftover
                temporary.replace(path)
        if sys.platform == "win32":  # no open file can be renamed there
            temporary.replace(path)
    except BaseException as error:
        with contextlib.suppress(OSError):
            temporary.unlink(missing_ok=True)
        if isinstance(error, OSError) and error.errno is not None:  # the name that the user knows
            raise OSError(error.errno, error.strerror, os.fspath(path)) from error
        raise
    _sync_folder(path.parent)


def check_folder(path: Path | None) -> None:
    """Refuse, before any work, a file that could not be written.

    Parameters
    ----------
    path : Path or None
        Where it shall stand; None is no file.

    Raises
    ------
    InputError
        If there is no such folder, or no permission.
    """
    if path is None:
        return
    if not path.parent.is_dir():
        raise InputError(f"{path} cannot be written: there is no folder {path.parent}; make it first")
    if not os.access(path if path.exists() else path.parent, os.W_OK):
        raise InputError(f"{path} cannot be written: permission denied; give another place")


def write_folder_whole(path: Path, files: Mapping[str, bytes | Writer]) -> None:
    """Write a folder of files under a temporary name and rename it: all of it appears at once or none.

    Parameters
    ----------
    path : Path
        The folder; one that is there is replaced.
    files : mapping of str to bytes or callable
        Names and contents, or what writes them into an open file.

    Raises
    ------
    OSError
        If the disk is full or the place cannot be written; nothing is left behind.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = _temporary(path)
    try:
        temporary.mkdir()
        for name, data in files.items():
            _write_synced(temporary / name, data)
        _sync_folder(temporary)
        if path.exists():
            shutil.rmtree(path)
        temporary.replace(path)
    except BaseException:
        shutil.rmtree(temporary, ignore_errors=True)
        raise
    _sync_folder(path.parent)


def remove_leftovers(folder: Path) -> None:
    """Delete the temporary files and folders that a killed process left anywhere below a folder."""
    for leftover in list(folder.rglob(".*.tmp")):
        if leftover.is_dir():
            shutil.rmtree(leftover, ignore_errors=True)
        else:
            leftover.unlink(missing_ok=True)


def remove_leftovers_of(path: Path) -> None:
    """Delete the temporary files that killed processes left of this one file, none that is being written."""
    for leftover in path.parent.glob(f"{_stem(path)}*.tmp"):
        with contextlib.suppress(OSError):  # another process has it, or was faster
            if time.time() - leftover.stat().st_mtime > YOUNG:
                with leftover.open("r+b") as file:
                    _hold(file)
                leftover.unlink()


def is_temporary(path: Path) -> bool:
    """Whether a file has a name under which one is written here before it is whole."""
    return path.name.startswith(".gbnbench-") and path.name.endswith(".tmp")


def _temporary(path: Path) -> Path:
    """Name a file beside path that no other process writes, short enough for any file system."""
    return path.parent / f"{_stem(path)}{secrets.token_hex(4)}.tmp"


def _stem(path: Path) -> str:
    """Begin the names of a file's temporary ones."""
    return f".gbnbench-{hashlib.sha256(os.fsencode(path.name)).hexdigest()[:8]}-"


def _hold(file: IO[bytes]) -> None:
    """Lock a file until it is closed.

    Raises
    ------
    OSError
        If another process has it, or the file system has no locks.
    """
    if sys.platform != "win32":  # where nobody deletes an open file
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)


def _write_synced(path: Path, data: bytes | Writer) -> None:
    with path.open("xb") as file:
        if isinstance(data, bytes):
            file.write(data)
        else:
            data(file)
        file.flush()
        os.fsync(file.fileno())


def _sync_folder(folder: Path) -> None:
    if sys.platform == "win32":  # folders cannot be opened there
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    finally:
        os.close(descriptor)
