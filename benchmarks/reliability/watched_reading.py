"""The reading of a file under watch: what it gave or raised, how long it took, how much memory it held."""

from __future__ import annotations

import signal
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from types import FrameType

from gbnbench.core.errors import GbnbenchError
from gbnbench.io.points import PointSets, ReadingOptions, read_sets

SECONDS = 10.0  # longest that a file may take
LIMIT = 1 << 26  # bytes that a file of a trial may have, unpacked


class TooSlowError(BaseException):
    """A reading took longer than it may; no handler of the reader takes it for one of its own errors."""


@dataclass(frozen=True)
class Reading:
    """What came of one file.

    Attributes
    ----------
    sets : PointSets or None
        The points.
    refusal : str
        The words in which the file was refused.
    crash : str
        What was raised that is no refusal; empty where nothing was.
    seconds, megabytes : float
        Time taken, and memory held beyond what the process held before.
    """

    sets: PointSets | None
    refusal: str
    crash: str
    seconds: float
    megabytes: float


def watched_reading(path: Path, options: ReadingOptions) -> Reading:
    """Read a file and tell everything that happened.

    Parameters
    ----------
    path : Path
        The file.
    options : ReadingOptions
        How.

    Returns
    -------
    Reading
    """
    sets, refusal, crash = None, "", ""
    before = _forget_peak()
    began = time.perf_counter()
    try:
        with _alarm(SECONDS):
            sets = read_sets(path, options, max_bytes=LIMIT)
    except GbnbenchError as error:
        refusal = str(error) or "no words"
    except TooSlowError:
        crash = f"more than {SECONDS:g} s"
    except Exception as error:
        crash = f"{type(error).__name__}: {error}"
    return Reading(sets, refusal, crash, time.perf_counter() - began, max(0.0, _peak() - before))


@contextmanager
def _alarm(seconds: float) -> Iterator[None]:
    """Raise TooSlowError in this block after so many seconds; only where the system has such an alarm."""
    if not hasattr(signal, "setitimer"):
        yield
        return

    def ring(_: int, __: FrameType | None) -> None:
        raise TooSlowError

    before = signal.signal(signal.SIGALRM, ring)
    signal.setitimer(signal.ITIMER_REAL, seconds)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def _forget_peak() -> float:
    """Let Linux count the peak of memory anew; return what the process holds now, MB."""
    try:
        Path("/proc/self/clear_refs").write_text("5")
    except OSError:  # another system: memory is not watched
        return 0.0
    return _peak()


def _peak() -> float:
    try:
        lines = Path("/proc/self/status").read_text().splitlines()
    except OSError:
        return 0.0
    return next(int(line.split()[1]) / 1024 for line in lines if line.startswith("VmHWM"))
