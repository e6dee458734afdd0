"""Where gbnbench may keep what it learnt: a folder that is known to be writable."""

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
    """Whether a file can really be made in folder, which is created if need be."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            return True
    except OSError:
        return False


@cache
def cache_folder() -> Path:
    """``$GBNBENCH_CACHE``, else the user's cache folder, else a temporary one: the first that is writable."""
    import platformdirs

    asked = os.environ.get("GBNBENCH_CACHE")
    for folder in ([Path(asked)] if asked else []) + [Path(platformdirs.user_cache_dir("gbnbench"))]:
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
    """Keep a JSON value under name, whole or not at all; a cache that cannot be written costs only time."""
    with contextlib.suppress(OSError):
        write_whole(cache_folder() / f"{name}.json", json.dumps(value).encode())
