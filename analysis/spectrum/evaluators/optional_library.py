"""Presence of libraries that are used where they are installed."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from importlib.util import find_spec


@cache
def loads(package: str) -> bool:
    """Tell whether a package is installed and loads here; only then is it imported."""
    if find_spec(package) is None:
        return False
    try:
        import_module(package)
    except (ImportError, OSError, RuntimeError):
        return False
    return True
