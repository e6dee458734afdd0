"""Files of point sets: the content of a file decides its format, and it gives the right sets or one error.

Text, whatever the file is called, is lines of numbers parted by blanks or by one comma each; UTF-8 or ASCII,
any line ends, with or without a byte-order mark or a last newline. Its sets are framed in one of four ways:

1. By counts. The first line is a header: a count (PSA; the dimension is that of the rows) or a count and a
   dimension (the GBN authors' programs). Just that many rows follow, then the next header or the end.
2. By a column of a header line (``set,x0,x1``) that is named set or realization: numbers that count up.
3. By lines that start with ``#`` (UTK). Under 1 and 2 and under a line of names such lines are comments.
4. Not at all: every row is a point of one set.

A first line of words names the columns: x, y, z, w in turn, or one letter with numbers from 0 or 1 on; so
does a comment right above the first row that has a word for each number. Double quotes around a cell are
dropped, and so are a column in front without a name that counts the rows or quotes their names, and an empty
cell at the end of every row that no name belongs to. Where the first line has a semicolon, or is ``sep=;``,
semicolons part cells and commas are decimal; so are commas in rows that tabs part. Where tabs part the names
and the first row, they alone part all rows, and cells may hold blanks and commas. A first line of bare whole
numbers is a header where one of them exceeds 1, since no coordinate does. Where it might be a header, a line
of column numbers or a point (``0`` or ``1`` before single numbers, ``0 1``, ``1 1``), the file is refused and
the error says how to write it: a point as ``0.0 1.0``, a header as ``1024 2``. Blank lines count for nothing,
except that between rows that nothing else frames they are refused, because some programs part sets by them;
so is a comment that holds just the numbers of a point.

Coordinates lie in [0, 1], or in the box that the file or the reading options tell, by whose sides they are
divided; its upper end is its lower; nothing else is altered or left out.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.core.errors import FormatError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points.file_format import size_limit
from gbnbench.io.points.formats.raw import read_raw
from gbnbench.io.points.formats.registry import format_of
from gbnbench.io.points.fractions_of_box import fractions_of_box
from gbnbench.io.points.options import ReadingOptions, reading_options
from gbnbench.io.points.point_file import PointFile, open_point_file
from gbnbench.io.points.point_sets import FileContent, PointSets
from gbnbench.io.points.writer import encode, write_atomically

__all__ = ["PointSets", "ReadingOptions", "load", "read", "read_sets", "reading_options", "save"]

_DEFAULT = ReadingOptions()


def load(
    path: str | os.PathLike[str],
    *,
    columns: str | Sequence[str] | Sequence[int] | None = None,
    raw: str | None = None,
    array: str | None = None,
    period: float | str | Sequence[float] | None = None,
    bounds: str | Sequence[float] | Sequence[Sequence[float]] | None = None,
    wrap: bool = False,
    max_bytes: int | None = None,
) -> FloatArray | list[FloatArray]:
    r"""Load the point set or sets of a file.

    Parameters
    ----------
    path : path-like
        A file in any of the formats that ``gbnbench.io.points`` tells of.
    columns : str, or sequence of str or int, optional
        Columns that are coordinates, in their order: ``"x,y"``, or numbers counted from 1 where the file has
        no names, such as ``"1,2"`` or ``"1-16"``.
    raw : str, optional
        Layout of a binary file without a header: ``"float32,3"``, or ``">float32,3"`` with the highest byte
        first.
    array : str, optional
        Which array of an .npz holds the points, or which key of a JSON file.
    period : float or sequence of float, optional
        Sides of the torus in the file's unit, such as ``(512, 512)`` for pixels; one number for all axes.
    bounds : sequence of float, optional
        Ends of each axis, ``(0, 512, 0, 256)`` or ``((0, 512), (0, 256))``.
    wrap : bool
        Bring points outside into the box by whole sides.
    max_bytes : int, optional
        Files this large or larger are refused unread; by default the environment variable
        GBNBENCH_MAX_FILE_BYTES, else 2 GB.

    Returns
    -------
    (n, d) float64, (realizations, n, d) float64, or list of (n_i, d) float64
        One set; several of one size; several of different sizes. All in [0, 1): fractions of the box.

    Raises
    ------
    FormatError
        If the file cannot be read as points; the text names the file and, in text formats, the line.
    InputError
        If an option cannot be meant so.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     _ = (Path(folder) / "pixels.csv").write_text("x,y\n128,256\n51.2,384\n")
    ...     load(Path(folder) / "pixels.csv", period=(512, 512))
    array([[0.25, 0.5 ],
           [0.1 , 0.75]])
    """
    options = reading_options(columns, raw, array, period, bounds, wrap)
    sets = read_sets(path, options, max_bytes=max_bytes).sets
    if len(sets) == 1:
        return sets[0]
    return np.stack(sets) if len({len(x) for x in sets}) == 1 else sets


def read(path: str | os.PathLike[str], *, max_bytes: int | None = None) -> list[FloatArray]:
    """Read every set of a file of points of the unit torus, or of a box that the file itself tells.

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
    return read_sets(path, max_bytes=max_bytes).sets


def read_sets(
    path: str | os.PathLike[str], options: ReadingOptions = _DEFAULT, *, max_bytes: int | None = None
) -> PointSets:
    """Read every set of a file, with the box that holds them.

    Parameters
    ----------
    path : path-like
        As for ``load``.
    options : ReadingOptions
        What the file does not say itself.
    max_bytes : int, optional
        As for ``load``.

    Returns
    -------
    PointSets
        Fractions of the box, its sides and lower corner in the file's unit, and whether it is a torus.

    Raises
    ------
    FormatError
        If the file cannot be read as points.
    """
    path = Path(path)
    try:
        file = open_point_file(path, size_limit(max_bytes), options)
        return fractions_of_box(path, content_of(file), options)
    except MemoryError:
        raise FormatError(path, "needs more memory than there is; split it, or free some") from None


def content_of(file: PointFile) -> FileContent:
    """Read a file by its format, in its own unit.

    Parameters
    ----------
    file : PointFile
        The file, with the options of reading.

    Returns
    -------
    FileContent

    Raises
    ------
    FormatError
        If it cannot be read as points.
    """
    options = file.options
    if options.raw is not None:
        return read_raw(file)
    format_ = format_of(file)
    for name in ("columns", "array"):
        if getattr(options, name) is not None and name not in format_.takes:
            raise FormatError(file.path, f"--{name} means nothing to a file of this format ({format_.name})")
    return format_.read(file)


def save(path: str | os.PathLike[str], x: ArrayLike | Sequence[ArrayLike] | PointSets) -> None:
    """Save one point set or several; the extension names the format, and every bit is kept.

    Parameters
    ----------
    path : path-like
        Ends in .txt (PSA's count and rows; the count and d where d is not 2), .dat or .edat (UTK), .csv,
        .tsv, .npy, .npz, .json, .ply, .xyz or .lammpstrj, and .gz, .bz2 or .xz after these. A file already
        there is replaced, once the new one is whole.
    x : (n, d) or (realizations, n, d) array_like, a list of (n_i, d), or PointSets
        Points in [0, 1). PointSets that have a box are written in its unit where the format holds the box,
        and then to the last bits of a coordinate.

    Raises
    ------
    InputError
        If the extension is none of these, x is not points, the format cannot hold them, or the place cannot
        be written.

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
