"""The errors gbnbench raises on purpose; the command turns each into one line and exit code 2."""

from __future__ import annotations

from pathlib import Path

from gbnbench.core.readable_text import in_one_line


class GbnbenchError(Exception):
    """Base of every error that gbnbench raises on purpose; its text is meant for the user.

    Examples
    --------
    >>> import gbnbench
    >>> try:
    ...     gbnbench.generate("jittered", n=1000)
    ... except gbnbench.GbnbenchError as error:
    ...     print(error)
    n must be m**2 for a jittered grid; got n=1000, nearest is 1024
    """


class InputError(GbnbenchError, ValueError):
    """An argument breaks a rule; the text names it, the rule, the value seen and the way out."""


class RefusalError(InputError):
    """A generator or measure cannot serve this n and d, and says why."""


class ShortSpectrumError(RefusalError):
    """A measure needs frequencies beyond the end of the spectrum."""


class FormatError(InputError):
    """A file cannot be read as a point set.

    Attributes
    ----------
    path : Path
        The file.
    line : int or None
        1-based line of the fault, where the format has lines.
    """

    def __init__(self, path: str | Path, message: str, line: int | None = None) -> None:
        self.path = Path(path)
        self.line = line
        name = in_one_line(self.path)
        where = f"{name}, line {line}" if line is not None else name
        super().__init__(f"{where}: {in_one_line(message)}")


class DeviceError(GbnbenchError, RuntimeError):
    """No OpenCL device can do the work; the text says what to install or choose."""


class NoRoomError(DeviceError):
    """A device may be there, but memory is short, or no folder takes the files of its compiled kernels."""


class UnfinishedError(GbnbenchError):
    """Some pieces of the work failed; the rest is kept."""
