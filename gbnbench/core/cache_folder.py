"""The folder in which gbnbench keeps what it has measured of this machine, and the values in it."""

from __future__ import annotations

import atexit
import contextlib
import json
import os
import shutil
import stat
import tempfile
from functools import cache
from pathlib import Path
from typing import Any, Literal

from gbnbench.core.atomic_write import write_whole

VARIABLE = "GBNBENCH_CACHE"
ROOM = 1 << 20  # bytes that a usable folder takes: without room a compiler of kernels ends the process


def is_writable(folder: Path) -> bool:
    """Return whether a file of ``ROOM`` bytes can really be made in a folder, which is created if need be."""
    try:
        _try(folder)
        return True
    except OSError:
        return False


def user_folder(kind: Literal["cache", "config"], program: str) -> Path | None:
    """Return the folder of a program's cache or settings, or None where no home is known.

    Parameters
    ----------
    kind : {"cache", "config"}
        What it holds.
    program : str
        Whose folder.

    Returns
    -------
    Path or None
        It need not exist, or be writable.
    """
    import platformdirs

    find = platformdirs.user_cache_dir if kind == "cache" else platformdirs.user_config_dir
    try:
        folder = Path(find(program, program))
    except RuntimeError:  # neither HOME nor a user of this number; older versions answer "~/.cache"
        return None
    return folder if folder.is_absolute() else None


@cache
def cache_folder() -> Path:
    """Choose the first writable of ``$GBNBENCH_CACHE``, the user's cache folder and a temporary one.

    Raises
    ------
    OSError
        If no folder of this machine takes a file of ``ROOM`` bytes, not even a temporary one.
    """
    named = os.environ.get(VARIABLE)
    for folder in (Path(named) if named else None, user_folder("cache", "gbnbench")):
        if folder is not None and is_writable(folder):
            return folder
    return _temporary_folder()


def _temporary_folder() -> Path:
    """Make a temporary cache, the same for every process of this user where the system tells users apart."""
    if hasattr(os, "getuid"):
        own = Path(tempfile.gettempdir()) / f"gbnbench-cache-{os.getuid()}"  # a user id may have no name
        with contextlib.suppress(OSError):
            own.mkdir(mode=0o700, exist_ok=True)
            found = own.lstat()  # nobody else's prepared one, and no link of theirs
            if stat.S_ISDIR(found.st_mode) and found.st_uid == os.getuid() and is_writable(own):
                return own
    passing = Path(tempfile.mkdtemp(prefix="gbnbench-cache-"))
    atexit.register(shutil.rmtree, passing, ignore_errors=True)
    _try(passing)
    os.environ[VARIABLE] = str(passing)  # worker processes share it
    return passing


def _try(folder: Path) -> None:
    """Make a file of ``ROOM`` bytes in a folder, which leaves nothing; an OSError names the folder."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder) as file:
            file.write(bytes(ROOM))
            file.flush()
    except OSError as error:
        raise OSError(error.errno, error.strerror, str(folder)) from None


def recall(name: str) -> Any | None:
    """Read the JSON value kept under name; None where there is none that can be read."""
    try:
        return json.loads((cache_folder() / f"{name}.json").read_text())
    except (OSError, ValueError):
        return None


def remember(name: str, value: Any) -> None:
    """Keep a value for later runs; a cache that cannot be written costs only time.

    Parameters
    ----------
    name : str
        The value's name, safe in a file name.
    value : object
        JSON-ready.
    """
    with contextlib.suppress(OSError):
        write_whole(cache_folder() / f"{name}.json", json.dumps(value).encode())
