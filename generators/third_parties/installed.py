"""Generators of installed packages, by the entry point group ``gbnbench.generators``."""

from __future__ import annotations

import importlib.metadata
import sys
from functools import lru_cache
from importlib.metadata import EntryPoint

from gbnbench.core.errors import InputError
from gbnbench.core.readable_text import in_one_line
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


def package_of(kind: type[object]) -> str | None:
    """Name the package that brings a class by its entry point, with its version; None where none does."""
    named = f"{kind.__module__}:{kind.__qualname__}"
    return next((package(entry) for entry in entry_points() if entry.value == named), None)


def error_text(error: BaseException) -> str:
    """Write an error as its class and the first line of what it says.

    Examples
    --------
    >>> error_text(ValueError("no luck"))
    'ValueError: no luck'
    """
    said = in_one_line((str(error).strip().splitlines() or [""])[0])
    return f"{type(error).__name__}{f': {said}' if said else ''}"


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
        why = f"its import failed: {error_text(error)}"
    else:
        try:
            return checked_kind(loaded, entry.name)
        except InputError as error:
            why = str(error)
    raise InputError(f"generator {entry.name!r} of the package {package(entry)} cannot be used: {why}")
