"""Files of point sets: the content of a file decides its format, and it gives the right sets or one error.

Text, whatever the file is called, is lines of numbers parted by blanks or by one comma each; UTF-8 or ASCII,
any line ends, with or without a byte-order mark or a last newline. Its sets are framed in one of four ways:

1. By counts. The first line is a header: a count (PSA; the dimension is that of the rows) or a count and a
   dimension (the GBN authors' programs). Just that many rows follow, then the next header or the end.
2. By a column of a header line (``set,x0,x1``) that is named set or realization: numbers that count up.
3. By lines that start with ``#`` (UTK). Under 1 and 2 such lines are comments.
4. Not at all: every row is a point of one set.

A line of column names is taken as such in .csv files and where commas part the names. A first line of bare
whole numbers is a header where one of them exceeds 1, since no coordinate does. Where it might be a header,
a line of column numbers or a point (``0`` or ``1`` before single numbers, ``0 1``, ``1 1``), the file is
refused and the error says how to write it: a point as ``0.0 1.0``, a header as ``1024 2``. Blank lines count
for nothing, except that between rows that nothing else frames they are refused, because some programs part
sets by them; so is a comment that holds just the numbers of a point.

Binary: .npy of (n, d) or (realizations, n, d) floats; .npz (``points``, else ``x``, else its only array, else
each array as a set); PSA's .rps, 2D pairs of little-endian float32, by its name, or from 16 points on by its
content; and PSA's .eps. Coordinates lie in [0, 1]; exactly 1 becomes 0; nothing else is altered or left out.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.core.errors import FormatError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points.binary import read_npy, read_npz, read_rps
from gbnbench.io.points.eps import read_eps
from gbnbench.io.points.file_format import kind, look, reason, size_limit
from gbnbench.io.points.text import read_text
from gbnbench.io.points.writer import encode, write_atomically

__all__ = ["load", "read", "save"]


def load(path: str | os.PathLike[str], *, max_bytes: int | None = None) -> FloatArray | list[FloatArray]:
    """Load the point set or sets of a file.

    Parameters
    ----------
    path : path-like
        A file in any of the formats that ``gbnbench.io.points`` tells of.
    max_bytes : int, optional
        Files this large or larger are refused unread; by default the environment variable
        GBNBENCH_MAX_FILE_BYTES, else 2 GB.

    Returns
    -------
    (n, d) float64, (realizations, n, d) float64, or list of (n_i, d) float64
        One set; several of one size; several of different sizes. All in [0, 1).

    Raises
    ------
    FormatError
        If the file cannot be read as points; the text names the file and, in text formats, the line.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save(Path(folder) / "two.csv", [[0.25, 0.5], [0.1, 0.75]])
    ...     load(Path(folder) / "two.csv")
    array([[0.25, 0.5 ],
           [0.1 , 0.75]])
    """
    sets = read(path, max_bytes=max_bytes)
    if len(sets) == 1:
        return sets[0]
    return np.stack(sets) if len({len(x) for x in sets}) == 1 else sets


def read(path: str | os.PathLike[str], *, max_bytes: int | None = None) -> list[FloatArray]:
    """Read every set of a file.

    Parameters
    ----------
    path : path-like
        As for ``load``.
    max_bytes : int, optional
        As for ``load``.

    Returns
    -------
    list of (n_i, d) float64
        The sets in the order of the file.

    Raises
    ------
    FormatError
        If the file cannot be read as points.
    """
    path = Path(path)
    limit = size_limit(max_bytes)
    size, head = look(path, limit)
    form = kind(path, size, head)
    if form == "npz":
        return read_npz(path, limit)
    try:
        if form == "npy":
            return read_npy(path, size)
        data = path.read_bytes()
    except OSError as error:
        raise FormatError(path, f"cannot be read: {reason(error)}") from None
    if form == "rps":
        return read_rps(path, data, named=path.suffix.lower() == ".rps")
    return read_eps(path, data) if form == "eps" else read_text(path, data)


def save(path: str | os.PathLike[str], x: ArrayLike | Sequence[ArrayLike]) -> None:
    """Save one point set or several; the extension names the format, and every bit is kept.

    Parameters
    ----------
    path : path-like
        Ends in .txt (PSA's count and rows; the count and d where d is not 2), .dat (UTK), .csv, .npy or .npz.
        A file already there is replaced, once the new one is whole.
    x : (n, d) or (realizations, n, d) array_like, or a list of (n_i, d)
        Points in [0, 1).

    Raises
    ------
    InputError
        If the extension is none of these, x is not points, or the place cannot be written.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     save(Path(folder) / "two.csv", [[0.25, 0.5], [0.1, 0.75]])
    ...     load(Path(folder) / "two.csv")
    array([[0.25, 0.5 ],
           [0.1 , 0.75]])
    """
    path = Path(path)
    write_atomically(path, encode(path, x))
