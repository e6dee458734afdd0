"""The memory that this process may have, and sizes that it cannot hold, refused before they are tried."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

LEAST = 850_000_000  # bytes of address space in which Python, numpy, scipy and an OpenCL device still start
PROCESS_BYTES = 270_000_000  # of Python, the libraries and the kernels of a measurement, once compiled anew
_CGROUPS = Path("/sys/fs/cgroup")


@cache
def memory_limit() -> int:
    """Bytes of the machine, of its container or of the limits set by ``ulimit``, whichever is least."""
    import psutil

    return min([int(psutil.virtual_memory().total), *_limits(), *_container_limits()])


def too_large(nbytes: float) -> str | None:
    """Say in words that nbytes are more than there may be; None where they are not.

    Examples
    --------
    >>> too_large(1000) is None
    True
    """
    if nbytes <= memory_limit():
        return None
    return f"take about {nbytes / 1e9:.3g} GB of memory, and this machine has {memory_limit() / 1e9:.3g}"


def too_little() -> str | None:
    """Say in words that the limits set by ``ulimit`` leave too little for any work; None where they do not.

    Notes
    -----
    Below it the libraries end the process in their own ways, which no handler can put into words.
    """
    least = min(_limits(), default=LEAST)
    if least >= LEAST:
        return None
    return (
        f"the memory of this process is limited to {least / 1e6:.0f} MB (ulimit -v or -d), and gbnbench with "
        f"its libraries needs {LEAST / 1e6:.0f} MB: raise the limit, such as by ulimit -v unlimited"
    )


def _limits() -> Iterator[int]:
    """Bytes of address space and of data, where they are limited."""
    try:
        import resource
    except ImportError:  # Windows has neither
        return
    for kind in (resource.RLIMIT_AS, resource.RLIMIT_DATA):
        soft = resource.getrlimit(kind)[0]
        if soft != resource.RLIM_INFINITY:
            yield soft


def _container_limits() -> Iterator[int]:
    """Bytes that Linux's control groups allow, of both their versions."""
    for name in ("memory.max", "memory/memory.limit_in_bytes"):
        try:
            text = (_CGROUPS / name).read_text().strip()
        except OSError:
            continue
        if text.isdigit():
            yield int(text)
