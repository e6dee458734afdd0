"""Which versions made a result."""

from __future__ import annotations

import platform
from importlib import metadata

from gbnbench import __version__

LIBRARIES = ("numpy", "scipy", "pandas", "matplotlib", "pyopencl", "scikit-image")


def versions() -> dict[str, str]:
    """Of Python, gbnbench and the libraries that it stands on, where they are installed."""
    found = {"python": platform.python_version(), "gbnbench": __version__}
    for library in LIBRARIES:
        try:
            found[library] = metadata.version(library)
        except metadata.PackageNotFoundError:
            continue
    return found
