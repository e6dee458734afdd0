"""Lists that a spectrum can be computed with, read from files: frequencies, and weights of the points.

Text is read line by line: numbers parted by blanks or by one comma each, ``#`` starts a comment, blank lines
count for nothing, and a first line of column names is passed over. ``.npy`` arrays are told by their content.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import FormatError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points.file_format import look, reason, size_limit
from gbnbench.io.points.literals import NUMBER, shown

_INTEGER = re.compile(rb"[+-]?[0-9]+")
_NPY = b"\x93NUMPY"
_ZIP = (b"PK\x03\x04", b"PK\x05\x06")  # of an .npz, of an empty one


def read_frequencies(path: Path, d: int | None = None) -> NDArray[np.int64]:
    """Read frequencies, integers in cycles per unit length, one frequency a row.

    Parameters
    ----------
    path : Path
        Text or .npy.
    d : int, optional
        Of the points; by default as many as the first row has.

    Returns
    -------
    (m, d) int64

    Raises
    ------
    FormatError
        If a row does not hold d integers of 64 bits; the text names the file and the line.
    """
    data = _bytes(path)
    if data.startswith(_NPY):
        array = _load(path)
        if array.ndim != 2 or array.dtype.kind not in "iu" or 0 in array.shape:
            found = f"{array.dtype} of shape {array.shape}"
            raise FormatError(path, f"frequencies must be integers, a row a frequency; got {found}")
        if d is not None and array.shape[1] != d:
            raise FormatError(path, f"{array.shape[1]} integers a frequency where the points have d={d}")
        if array.dtype.kind == "u" and array.max() >= 2**63:
            raise FormatError(path, f"{array.max()} does not fit in 64 bits with a sign")
        return array.astype(np.int64)
    rows: list[list[int]] = []
    because = f"the points have d={d}"
    for line, cells in _rows(path, data):
        for cell in cells:
            if not _INTEGER.fullmatch(cell):
                raise FormatError(path, f"{shown(cell)} is not an integer", line)
            if len(cell) > 20 or not -(2**63) <= int(cell) < 2**63:
                raise FormatError(path, f"{shown(cell)} does not fit in 64 bits with a sign", line)
        if d is None:
            d, because = len(cells), f"line {line} has {len(cells)}"
        if len(cells) != d:
            raise FormatError(path, f"{_count(cells, 'integer')} where {because}; one frequency a row", line)
        rows.append([int(cell) for cell in cells])
    if not rows:
        raise FormatError(path, "the file holds no frequencies")
    return np.array(rows, np.int64)


def read_weights(path: Path, n: int, sets: int = 1) -> FloatArray:
    """Read weights, one number a point: of one set, for all, or of every set, one set after another.

    Parameters
    ----------
    path : Path
        Text or .npy.
    n, sets : int
        Points a set, and sets.

    Returns
    -------
    (n,) or (sets, n) float64

    Raises
    ------
    FormatError
        If they are not n, or sets times n, finite numbers; the text names the file and the line.
    """
    data = _bytes(path)
    if data.startswith(_NPY):
        array = _load(path)
        if array.dtype.kind not in "fiu" or array.ndim not in (1, 2):
            found = f"{array.dtype} of shape {array.shape}"
            raise FormatError(path, f"weights must be real numbers, (n,) or (sets, n); got {found}")
        weights = array.astype(np.float64)
        if 1 in weights.shape:
            weights = weights.ravel()
        if not np.isfinite(weights).all():
            where = tuple(int(i) for i in np.argwhere(~np.isfinite(weights))[0])
            raise FormatError(path, f"weights must be finite; got {float(weights[where])!r} (index {where})")
    else:
        weights = np.array([_number(path, line, cells) for line, cells in _rows(path, data)])
    if weights.shape == (n,) or weights.shape == (sets, n):
        return weights
    if weights.shape == (sets * n,):
        return weights.reshape(sets, n)
    every = f", or {sets * n:,} for the {sets} sets" if sets > 1 else ""
    found = f"{len(weights):,} numbers" if weights.ndim == 1 else f"shape {weights.shape}"
    raise FormatError(path, f"{found} where {n:,} points need {n:,}, one a line{every}")


def _number(path: Path, line: int, cells: list[bytes]) -> float:
    if len(cells) > 1:
        raise FormatError(path, f"{_count(cells, 'number')} in a line; weights are one a line", line)
    if not NUMBER.fullmatch(cells[0]):
        raise FormatError(path, f"{shown(cells[0])} is not a number", line)
    value = float(cells[0])
    if not math.isfinite(value):
        raise FormatError(path, f"{shown(cells[0])} is beyond the range of float64", line)
    return value


def _rows(path: Path, data: bytes) -> Iterator[tuple[int, list[bytes]]]:
    """Cells of each line that holds any, with its 1-based number; column names are passed over."""
    first = True
    for line, text in enumerate(data.removeprefix(b"\xef\xbb\xbf").splitlines(), start=1):
        content = text.split(b"#", 1)[0].strip()
        if not content:
            continue
        cells = [cell.strip() for cell in content.split(b",")] if b"," in content else content.split()
        if b"" in cells:
            raise FormatError(path, "an empty cell between commas", line)
        named = first and all(_is_name(cell) for cell in cells)
        first = False
        if not named:
            yield line, cells


def _is_name(cell: bytes) -> bool:
    word = cell.strip(b"\"'")
    return word[:1].isalpha() and word.lower() not in (b"nan", b"inf", b"infinity")


def _count(cells: list[bytes], what: str) -> str:
    return f"{len(cells)} {what}{'s' * (len(cells) != 1)}"


def _bytes(path: Path) -> bytes:
    look(path, size_limit())
    try:
        data = path.read_bytes()
    except OSError as error:
        raise FormatError(path, f"cannot be read: {reason(error)}") from None
    if data.startswith(_ZIP):
        raise FormatError(path, ".npz lists are not read; write .txt, .csv or .npy")
    return data


def _load(path: Path) -> NDArray[Any]:
    try:
        array: NDArray[Any] = np.load(path, allow_pickle=False)
    except Exception as error:  # a damaged header lets numpy raise nearly anything
        text = (str(error).splitlines() or [type(error).__name__])[0][:100]
        raise FormatError(path, f"a damaged .npy file: {text}") from None
    return array
