"""The memory of the machine, and sizes that it cannot hold, refused before they are tried."""

from __future__ import annotations

from functools import cache


@cache
def physical_memory() -> int:
    """Bytes of memory that the machine has."""
    import psutil

    return int(psutil.virtual_memory().total)


def too_large(nbytes: float) -> str | None:
    """Say in words that nbytes are more than the machine has; None where they are not.

    Examples
    --------
    >>> too_large(1000) is None
    True
    """
    if nbytes <= physical_memory():
        return None
    return f"take about {nbytes / 1e9:.3g} GB of memory, and this machine has {physical_memory() / 1e9:.3g}"
