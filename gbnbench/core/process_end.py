"""The end of a process in words: its exit code or signal, and the last line that it complained."""

from __future__ import annotations

import signal

from gbnbench.core.readable_text import in_one_line


def cause_of_end(code: int, complaints: bytes) -> str:
    r"""Say what a process ended of.

    Parameters
    ----------
    code : int
        As ``subprocess`` gives it: an exit code, or the negative number of a signal.
    complaints : bytes
        What it wrote to standard error.

    Returns
    -------
    str
        Part of a sentence that begins with "its process".

    Examples
    --------
    >>> cause_of_end(-11, b"pocl: bad binary\n")
    'its process was killed by SIGSEGV: pocl: bad binary'
    >>> cause_of_end(3, b"")
    'its process ended with exit code 3'
    """
    lines = [line.strip() for line in complaints.decode(errors="replace").splitlines() if line.strip()]
    if code < 0:
        try:
            name = signal.Signals(-code).name
        except ValueError:
            name = f"signal {-code}"
        cause = f"its process was killed by {name}"
        if name == "SIGKILL":
            cause += " (often by the system for want of memory)"
    else:
        cause = f"its process ended with exit code {code}"
    return f"{cause}: {in_one_line(lines[-1])}" if lines else cause
