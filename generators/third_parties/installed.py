"""Generators of installed packages, by the entry point group ``gbnbench.generators``."""

from __future__ import annotations

import importlib.metadata
import sys
from functools import lru_cache
from importlib.metadata import EntryPoint

from gbnbench.core.errors import InputError
from gbnbench.generators.kind_check import checked_kind
from gbnbench.generators.protocol import Generator

GROUP = "gbnbench.generators"


def entry_points() -> tuple[EntryPoint, ...]:
    """List the entry points of all installed packages, by package and name; nothing is imported."""
    return _of_path(tuple(sys.path))


@lru_cache(maxsize=1)
def _of_path(_: tuple[str, ...]) -> tuple[EntryPoint, ...]:
    """Search the path once: packages that are installed meanwhile need a new Python, as imports do."""
    return tuple(sorted(importlib.metadata.entry_points(group=GROUP), key=lambda e: (package(e), e.name)))


def package(entry: EntryPoint) -> str:
    """Name the package of an entry point, with its version."""
    return "an unknown package" if entry.dist is None else f"{entry.dist.name} {entry.dist.version}"


def load(entry: EntryPoint) -> type[Generator]:
    """Import the generator of an entry point.

    Raises
    ------
    InputError
        If the import fails or what it gives is no generator; the text names the package.
    """
    try:
        loaded = entry.load()
    except (Exception, SystemExit) as error:  # whatever a stranger's module does when it is imported
        said = (str(error).strip().splitlines() or [""])[0]
        why = f"its import failed: {type(error).__name__}{f': {said}' if said else ''}"
    else:
        try:
            return checked_kind(loaded, entry.name)
        except InputError as error:
            why = str(error)
    raise InputError(f"generator {entry.name!r} of the package {package(entry)} cannot be used: {why}")
