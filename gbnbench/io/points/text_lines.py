"""Lines and numbers of the formats that are read line by line, every one checked."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from pathlib import Path

from gbnbench.core.errors import FormatError
from gbnbench.io.points.file_format import without_marks
from gbnbench.io.points.literals import NUMBER, shown, too_large

_WHOLE = re.compile(rb"[0-9]{1,15}")


def lines_of(data: bytes) -> list[bytes]:
    """Split a text into lines without blanks at their ends; blank lines at the end are dropped."""
    data = without_marks(data).replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    return [line.strip() for line in data.rstrip().split(b"\n")]


def numbers_of(path: Path, tokens: Sequence[bytes], line: int) -> list[float]:
    """Read tokens as numbers.

    Parameters
    ----------
    path : Path
        Named in errors.
    tokens : sequence of bytes
        Literals.
    line : int
        1-based line that they stand in.

    Returns
    -------
    list of float

    Raises
    ------
    FormatError
        At the first that is no number, or too large for one.
    """
    for token in tokens:
        if not NUMBER.fullmatch(token):
            raise FormatError(path, f"{shown(token)} is not a number", line)
        if math.isinf(float(token)):
            raise FormatError(path, too_large(token), line)
    return [float(token) for token in tokens]


def whole_number(path: Path, text: bytes, line: int, what: str) -> int:
    """Read a count of points, at least 1.

    Parameters
    ----------
    path : Path
        Named in errors.
    text : bytes
        The literal.
    line : int
        1-based line that it stands in.
    what : str
        What it counts, for the error.

    Returns
    -------
    int

    Raises
    ------
    FormatError
        If it is none.
    """
    if not _WHOLE.fullmatch(text) or int(text) < 1:
        raise FormatError(path, f"{what} must be a whole number above 0; got {shown(text)}", line)
    return int(text)
