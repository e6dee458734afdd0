"""The folder in which gbnbench keeps what it has measured of this machine, and the values in it."""

from __future__ import annotations

import contextlib
import getpass
import json
import os
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

from gbnbench.core.atomic_write import write_whole


def is_writable(folder: Path) -> bool:
    """Return whether a file can really be made in a folder, which is created if need be."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


@cache
def cache_folder() -> Path:
    """Choose the first writable of ``$GBNBENCH_CACHE``, the user's cache folder and a temporary one."""
    import platformdirs

    named = os.environ.get("GBNBENCH_CACHE")
    for folder in ([Path(named)] if named else []) + [Path(platformdirs.user_cache_dir("gbnbench"))]:
        if is_writable(folder):
            return folder
    own = Path(tempfile.gettempdir()) / f"gbnbench-cache-{getpass.getuser()}"
    with contextlib.suppress(OSError):
        own.mkdir(mode=0o700, exist_ok=True)
        if own.owner() == getpass.getuser() and is_writable(own):  # nobody else's prepared one
            return own
    return Path(tempfile.mkdtemp(prefix="gbnbench-cache-"))


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
