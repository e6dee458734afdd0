"""CPU time of this process together with the programs that it ran to their end."""

from __future__ import annotations

import sys
import time

if sys.platform != "win32":
    import resource


def cpu_seconds() -> float:
    """Return CPU seconds since the process began, of its threads and of every finished child.

    Examples
    --------
    >>> before = cpu_seconds()
    >>> cpu_seconds() >= before
    True
    """
    own = time.process_time()
    if sys.platform == "win32":  # which has no such count of children
        return own
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return own + children.ru_utime + children.ru_stime
