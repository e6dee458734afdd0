"""One run of an external program: its command filled in, its points read and checked, faults in words."""

from __future__ import annotations

import contextlib
import os
import re
import shlex
import signal
import subprocess
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from gbnbench.core.errors import GbnbenchError
from gbnbench.core.process_end import cause_of_end
from gbnbench.core.readable_text import in_one_line
from gbnbench.core.torus import FloatArray
from gbnbench.io.points import ReadingOptions, read_sets

OUTPUT = "output"  # the placeholder of the file that is to be written
ROOM = 2**26  # bytes that a program may write at least, in points or in messages
COORDINATE = 200  # bytes of a coordinate, where its points need more than that
LOOKS = 0.05  # seconds from one look at what it has written to the next


def filled(command: Sequence[str], values: Mapping[str, str]) -> list[str]:
    """Put values in the place of ``{name}`` in the words of a command; other braces stay.

    Parameters
    ----------
    command : sequence of str
        Words with placeholders.
    values : mapping of str
        Texts by name.

    Returns
    -------
    list of str

    Examples
    --------
    >>> filled(["awk", "{print}", "n={n}"], {"n": "16"})
    ['awk', '{print}', 'n=16']
    """
    names = "|".join(map(re.escape, values))
    return [re.sub(rf"\{{({names})\}}", lambda match: values[match[1]], word) for word in command]


def run_program(
    name: str,
    command: Sequence[str],
    values: Mapping[str, str],
    n: int,
    d: int,
    *,
    suffix: str,
    timeout: float,
) -> FloatArray:
    """Run a program in a temporary folder and read its points.

    Parameters
    ----------
    name : str
        Of the generator, for messages.
    command : sequence of str
        Words with placeholders. No shell reads them.
    values : mapping of str
        What stands for the placeholders; ``{output}`` is a file in the folder. Without it in the command the
        points are read from standard output.
    n, d : int
        Points that must come, and their dimension.
    suffix : str
        Of the file, without a dot.
    timeout : float
        Seconds after which the program is ended, and all that it started.

    Returns
    -------
    (n, d) float64
        In [0, 1).

    Raises
    ------
    GbnbenchError
        If the program cannot be started, fails, takes longer, writes without end, or writes anything but n
        points of the torus.
    """
    with tempfile.TemporaryDirectory(prefix="gbnbench-", ignore_cleanup_errors=True) as place:
        folder = Path(place) / "empty"
        folder.mkdir()
        file, said = folder / f"points.{suffix}", Path(place) / "standard-error"
        words = filled(command, {**values, OUTPUT: str(file)})
        into_file = words != filled(command, values)
        points, printed = (file, Path(os.devnull)) if into_file else (Path(place) / file.name,) * 2
        shown = shlex.join(words)
        with (
            said.open("wb") as errors,
            printed.open("wb") as out,
            _started(name, words, folder, out.fileno(), errors.fileno()) as process,
        ):
            code, fault = _ended(process, (points, said), max(ROOM, COORDINATE * n * d), timeout)
        if fault:
            raise GbnbenchError(f"{name} drew no set: {shown}: was ended {fault}")
        if code != 0:
            raise GbnbenchError(f"{name} drew no set: {shown}: {cause_of_end(code, said.read_bytes())}")
        if not points.is_file():
            raise GbnbenchError(f"{name} drew no set: {shown}: wrote no file {points.name}")
        try:
            sets = read_sets(points, ReadingOptions(shape_told=True)).sets
        except GbnbenchError as error:
            fault = str(error).replace(
                f"{points.parent}{os.sep}", "" if into_file else "standard output, as "
            )
            if " --" in fault:
                fault += f"; those are options for files: a program must write its n={n} points of [0, 1)"
            raise GbnbenchError(f"{name} drew no set: {shown}: {fault}") from None
        if len(sets) != 1 or sets[0].shape != (n, d):
            got = f"shape {sets[0].shape}" if len(sets) == 1 else f"{len(sets)} sets"
            raise GbnbenchError(f"{name} drew no set of n={n}, d={d}: {shown}: wrote {got}")
        return sets[0]


@contextlib.contextmanager
def _started(
    name: str, words: list[str], folder: Path, out: int, errors: int
) -> Iterator[subprocess.Popen[bytes]]:
    """Start a program, which does not outlive what is done inside."""
    try:
        process = subprocess.Popen(
            words, cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=errors, start_new_session=True
        )
    except (OSError, ValueError) as error:  # ValueError: a zero byte in a word
        why = error.strerror if isinstance(error, OSError) else error
        shown = in_one_line(shlex.join(words))
        raise GbnbenchError(f"{name} drew no set: {shown}: cannot be started: {why}") from None
    try:
        yield process
    finally:
        if process.poll() is None:
            _kill(process)


def _ended(
    process: subprocess.Popen[bytes], written: Sequence[Path], room: int, timeout: float
) -> tuple[int, str]:
    """Wait for a program's end: its exit code, and "" or why it must be ended."""
    last = time.monotonic() + timeout
    while True:
        try:
            return process.wait(max(0.0, min(LOOKS, last - time.monotonic()))), ""
        except subprocess.TimeoutExpired:
            if time.monotonic() >= last:
                return 0, f"after {timeout:g} s; its timeout allows no more"
        for file in written:
            if file.is_file() and file.stat().st_size > room:
                return 0, f"at {room / 1e6:.0f} MB of output; its points need far less"


def _kill(process: subprocess.Popen[bytes]) -> None:
    """End a program, with all that it started where the system knows sessions."""
    if hasattr(os, "killpg"):
        with contextlib.suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
    process.kill()
    process.wait()
