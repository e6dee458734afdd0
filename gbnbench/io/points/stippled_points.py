"""Stipplings in files, ours and anybody's: positions, amplitudes, inks, and the picture that they are of."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points import content_of
from gbnbench.io.points.columns import fault_of_names, is_axis
from gbnbench.io.points.file_format import size_limit
from gbnbench.io.points.formats.registry import format_of
from gbnbench.io.points.formats.text import TEXT
from gbnbench.io.points.fractions_of_box import fractions_of_box
from gbnbench.io.points.options import ReadingOptions
from gbnbench.io.points.point_file import PointFile, open_point_file
from gbnbench.io.points.point_sets import Coordinates, FileContent
from gbnbench.io.points.text_columns import column_names

AMPLITUDE = "amplitude"  # name of their column
INK = "ink"  # of the column that tells inks apart
_HEADER = re.compile(r"# stippling, ([^:\n]*): ([0-9]+(?: x [0-9]+){1,2}) pixels, coverage ([0-9.e+-]+);")
_BELOW_1 = float(np.nextafter(1, 0))


@dataclass(frozen=True)
class PictureHeader:
    """What a file of text says of the picture.

    Attributes
    ----------
    size : tuple of int
        Pixels along x, y (and z).
    coverage : float
        Its mean darkness, 0 to 1.

    Examples
    --------
    >>> PictureHeader((512, 384), 0.25).text("black")
    '# stippling, black: 512 x 384 pixels, coverage 0.25; unit square, x right, y up'
    """

    size: tuple[int, ...]
    coverage: float

    def text(self, ink: str) -> str:
        """Write the line of an ink."""
        size = " x ".join(map(str, self.size))
        where = "square, x right, y up" if len(self.size) == 2 else "cube, x right, y up, z by slices"
        return f"# stippling, {ink}: {size} pixels, coverage {self.coverage!r}; unit {where}"


@dataclass(frozen=True)
class StippledPoints:
    """One stippling of a file.

    Attributes
    ----------
    points : (n, d) float64
        In the unit square, 0 to 1.
    amplitudes : (n,) float64 or None
        Above 0; None where the file has none.
    header : PictureHeader or None
        What the file says of the picture.
    ink : str
        What the file says of the ink; empty where it says nothing.
    """

    points: FloatArray
    amplitudes: FloatArray | None
    header: PictureHeader | None
    ink: str = ""


def read_stipplings(path: str | os.PathLike[str], options: ReadingOptions) -> list[StippledPoints]:
    """Read the stipplings of a file of points of any format.

    Parameters
    ----------
    path : path-like
        The file; in text and tables a column named amplitude holds those.
    options : ReadingOptions
        How it is read.

    Returns
    -------
    list of StippledPoints
        At least one, in the order of the file.

    Raises
    ------
    FormatError
        If it cannot be read as points, or an amplitude is not above 0.
    """
    path = Path(path)
    file = open_point_file(path, size_limit(None), options)
    names = _names(file)
    if INK in names:
        said = "its dots are of several inks in one table: write them as .txt, which parts them"
        raise FormatError(path, said, 1)
    weighted = any(name.lower() == AMPLITUDE for name in names)
    if weighted:
        axes = options.columns or tuple(name for name in names if is_axis(name))
        if options.columns is None and (fault := fault_of_names(axes)):
            raise FormatError(path, fault)
        file = replace(file, options=replace(options, columns=(*axes, AMPLITUDE)))
    content = content_of(file)
    sets = [_parted(path, one) if weighted else (one, None) for one in content.sets]
    bare = FileContent([_within(one, options, content) for one, _ in sets], content.box)
    fractions = fractions_of_box(path, bare, options).sets
    told = _headers(file)
    told = told if len(told) == len(sets) else [("", None)] * len(sets)
    return [
        StippledPoints(x, a, header, ink)
        for x, (_, a), (ink, header) in zip(fractions, sets, told, strict=True)
    ]


def _names(file: PointFile) -> tuple[str, ...]:
    if file.options.raw is not None or format_of(file) is not TEXT:
        return ()
    return column_names(file.path, file.read())


def _headers(file: PointFile) -> list[tuple[str, PictureHeader | None]]:
    """Find what gbnbench wrote of inks and pictures; a header that is no longer whole counts for nothing."""
    if not file.head.startswith(b"# stippling, "):
        return []
    found = _HEADER.finditer(file.read().decode("utf-8", "replace"))
    return [
        (ink, PictureHeader(tuple(int(side) for side in size.split(" x ")), float(coverage)))
        for ink, size, coverage in (match.groups() for match in found)
    ]


def _parted(path: Path, one: Coordinates) -> tuple[Coordinates, FloatArray]:
    """Take the last column off."""
    a = one.points[:, -1].copy()
    wrong = np.flatnonzero(~((a > 0) & np.isfinite(a)))
    if len(wrong):
        line = None if one.lines is None else int(one.lines[wrong[0]])
        raise FormatError(path, f"amplitude {a[wrong[0]]:g} is not a finite number above 0", line)
    return replace(one, points=np.ascontiguousarray(one.points[:, :-1])), a


def _within(one: Coordinates, options: ReadingOptions, content: FileContent) -> Coordinates:
    """Keep the points on the upper ends of the unit square there: it is no torus."""
    if content.box is not None or options.period is not None or options.bounds is not None:
        return one
    return replace(one, points=np.where(one.points == 1, _BELOW_1, one.points))
