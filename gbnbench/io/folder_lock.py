"""A lock that keeps a second process off a folder of results."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path
from typing import Self

import filelock

from gbnbench.core.errors import InputError


class FolderLock:
    """Keep a second process off a folder while the first one lives.

    Parameters
    ----------
    folder : Path
        Must exist; the lock is its file ``.lock``, which stays behind unlocked and names the last process
        that held it.

    Notes
    -----
    The operating system drops the lock with its process, however that ended, so there is no stale lock.
    """

    NAME = ".lock"

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._lock = filelock.FileLock(folder / self.NAME, timeout=0)

    def __enter__(self) -> Self:
        """Take the lock.

        Raises
        ------
        InputError
            If another process has it.
        """
        path = self._folder / self.NAME
        try:
            self._lock.acquire()
        except filelock.Timeout:
            raise InputError(
                f"{self._folder} is being written by another gbnbench (process {_holder(path)}); "
                "wait for it, or choose another folder with --out"
            ) from None
        with contextlib.suppress(OSError):  # Windows lets nobody write a locked file
            path.write_text(f"{os.getpid()}\n", encoding="ascii")
        return self

    def __exit__(self, *exception: object) -> None:
        """Give the lock back."""
        self._lock.release()


def _holder(path: Path) -> str:
    """Read which process holds the lock."""
    try:
        return path.read_text(encoding="ascii").strip() or "unknown"
    except (OSError, ValueError):
        return "unknown"
