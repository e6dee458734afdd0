"""Caches of the libraries below gbnbench, led to a folder that can be written where the user's own cannot.

PoCL with an unwritable cache offers a platform without devices, PyOpenCL with one cannot be imported, and
matplotlib and fontconfig search all fonts again in every process.
"""

from __future__ import annotations

import os
from functools import cache
from pathlib import Path

from gbnbench.core.cache_folder import VARIABLE, cache_folder, is_writable, user_folder


@cache
def lead_caches() -> None:
    """Set the environment variables of caches that cannot be written, for this process and its children.

    ``POCL_CACHE_DIR`` is kept where it can be written, ``MPLCONFIGDIR`` where matplotlib's folders can, and
    ``XDG_CACHE_HOME`` where PyOpenCL's can, whose cache of kernel calls no argument leads elsewhere.

    Raises
    ------
    OSError
        If no folder of this machine takes the files of compiled kernels.
    """
    if not _all_writable(os.environ.get("POCL_CACHE_DIR")):
        os.environ["POCL_CACHE_DIR"] = str(cache_folder() / "pocl")
    named = os.environ.get("MPLCONFIGDIR")
    usual = (user_folder("config", "matplotlib"), user_folder("cache", "matplotlib"))
    if not (_all_writable(named) if named else _all_writable(*usual)):
        os.environ["MPLCONFIGDIR"] = str(cache_folder() / "matplotlib")
    if not _all_writable(user_folder("cache", "pytools")):
        os.environ["XDG_CACHE_HOME"] = str(cache_folder())
        os.environ[VARIABLE] = str(cache_folder())  # not a folder within it, in the processes started here


def _all_writable(*folders: str | Path | None) -> bool:
    return all(folder and Path(folder).is_absolute() and is_writable(Path(folder)) for folder in folders)
