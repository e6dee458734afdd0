"""Sizes that a machine's memory cannot hold, refused before they are tried."""

from __future__ import annotations

import os


def physical() -> float:
    """Bytes of memory that the machine has; inf where it does not say."""
    try:
        return float(os.sysconf("SC_PAGE_SIZE")) * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, OSError, ValueError):  # not POSIX
        return float("inf")


def too_large(nbytes: float) -> str | None:
    """Say in words that nbytes are more than the machine has; None where they are not.

    Examples
    --------
    >>> too_large(1000) is None
    True
    """
    if nbytes <= physical():
        return None
    return f"take about {nbytes / 1e9:.3g} GB of memory, and this machine has {physical() / 1e9:.3g}"
