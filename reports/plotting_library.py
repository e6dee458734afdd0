"""The import of matplotlib, which neither another machine's settings nor an unwritable home can stop."""

from __future__ import annotations

import contextlib
import os
import sys

from gbnbench.core.writable_caches import lead_caches


def import_matplotlib() -> None:
    """Import matplotlib where it is not yet, with caches that it can write, whatever MPLBACKEND says.

    Pictures are drawn into files and need no window. A backend that matplotlib knows is kept for the figures
    that the user shows; one that it does not know, such as a mistyped one, would stop the import.
    """
    if "matplotlib" in sys.modules:
        return
    with contextlib.suppress(OSError):  # without any folder matplotlib says so itself
        lead_caches()
    backend = os.environ.pop("MPLBACKEND", None)
    try:
        import matplotlib as mpl
    finally:
        if backend is not None:
            os.environ["MPLBACKEND"] = backend
    if backend:
        with contextlib.suppress(ValueError):
            mpl.rcParams["backend"] = backend
