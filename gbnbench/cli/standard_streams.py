"""Standard output and error that cannot stop a command: closed, on a full disk, or in a narrow encoding."""

from __future__ import annotations

import codecs
import contextlib
import errno
import io
import os
import sys
import unicodedata
from collections.abc import Iterator
from typing import Any

from gbnbench.execution.progress import PLAIN_TERMINALS

SPELLINGS = {"–": "-", "±": "+/-", "∞": "inf", "▲": "^", "▼": "v", "σ": "sigma", "ν": "nu", "×": "x"}
ERRORS = "gbnbench.spelt"  # what is done with signs that an encoding lacks


class OutputFile(io.FileIO):
    """A file descriptor whose first write error is kept in ``fault``, after which nothing more is written.

    A pipe that nobody reads any more still raises BrokenPipeError, unless ``deaf``.
    """

    def __init__(self, descriptor: int, *, deaf: bool = False) -> None:
        super().__init__(descriptor, "w", closefd=False)
        self.deaf = deaf
        self.fault: OSError | None = None

    def write(self, data: Any, /) -> int:
        """Write bytes, or take note of why they cannot be written; return their number."""
        if self.fault is None:
            try:
                return super().write(data)
            except BrokenPipeError as error:
                if not self.deaf:
                    raise
                self.fault = error
            except OSError as error:
                self.fault = error
        return memoryview(data).nbytes


@contextlib.contextmanager
def lasting_streams() -> Iterator[OutputFile | None]:
    """Give the process standard streams that outlast their destinations; yield what notes output's faults.

    Descriptors that were closed are opened on the null device, so that no other file takes their numbers.
    Nothing is done on Windows, whose consoles are no files, and where the streams were replaced already.
    """
    if sys.platform == "win32" or sys.stdout is not sys.__stdout__ or sys.stderr is not sys.__stderr__:
        yield None
        return
    for descriptor, mode in ((0, os.O_RDONLY), (1, os.O_RDONLY), (2, os.O_WRONLY)):
        _fill(descriptor, mode)  # a closed output refuses to be written, a closed error output takes anything
    codecs.register_error(ERRORS, _spelt)
    output, complaints = OutputFile(1), OutputFile(2, deaf=True)
    before = sys.stdout, sys.stderr
    sys.stdout = _text(output, sys.stdout, ERRORS)
    sys.stderr = _text(complaints, sys.stderr, "backslashreplace")
    try:
        yield output
    finally:
        with contextlib.suppress(BrokenPipeError):
            sys.stdout.flush()
        sys.stdout, sys.stderr = before


def in_words(fault: OSError) -> str:
    """Say why standard output could not be written, and what that means for the results."""
    why = "it is closed" if fault.errno == errno.EBADF else fault.strerror
    return f"standard output cannot be written ({why}): what was printed is lost, files and folders are kept"


def wants_colour() -> bool:
    """Whether standard output is a terminal that shows colours, and its user wants them."""
    plain = os.environ.get("TERM") in PLAIN_TERMINALS or bool(os.environ.get("NO_COLOR"))
    return sys.stdout.isatty() and not plain


def _fill(descriptor: int, mode: int) -> None:
    """Open the null device in the place of a descriptor that is closed."""
    try:
        os.fstat(descriptor)
    except OSError:
        opened = os.open(os.devnull, mode)
        if opened == descriptor:
            os.set_inheritable(descriptor, True)
        else:
            os.dup2(opened, descriptor)
            os.close(opened)


def _text(file: OutputFile, before: Any, errors: str) -> io.TextIOWrapper:
    encoding = getattr(before, "encoding", None) or "utf-8"
    return io.TextIOWrapper(io.BufferedWriter(file), encoding, errors, line_buffering=True)


def _spelt(error: UnicodeError) -> tuple[str | bytes, int]:
    """Spell signs that the encoding lacks; a file name's odd bytes go out as they are on the disk."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    sign = error.object[error.start]
    if 0xDC80 <= ord(sign) <= 0xDCFF and len("a".encode(error.encoding)) == 1:
        return bytes([ord(sign) - 0xDC00]), error.start + 1
    plain = unicodedata.normalize("NFKD", sign).encode("ascii", "ignore").decode()
    return SPELLINGS.get(sign) or plain or "?", error.start + 1
