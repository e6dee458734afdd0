"""Versions of Python, gbnbench and its libraries, for the manifest of a result."""

from __future__ import annotations

import platform
from importlib import metadata

from gbnbench import __version__

LIBRARIES = ("numpy", "scipy", "pandas", "matplotlib", "pyopencl", "scikit-image")


def versions() -> dict[str, str]:
    """Return the versions of Python, of gbnbench and of the libraries that are installed."""
    found = {"python": platform.python_version(), "gbnbench": __version__}
    for library in LIBRARIES:
        try:
            found[library] = metadata.version(library)
        except metadata.PackageNotFoundError:
            continue
    return found
