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
NAMED = ("x", "y")
COLUMNS = (None, NAMED, ("1", "2"))  # of a plane, tried in turn
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


def read_pixel_stipplings(
    path: str | os.PathLike[str], options: ReadingOptions, size: tuple[int, ...]
) -> list[StippledPoints]:
    """Read stipplings whose coordinates are pixels, y down from the upper border.

    Parameters
    ----------
    path, options
        As ``read_stipplings`` takes them; the options tell no box.
    size : tuple of int
        Pixels along x, y (and z).

    Returns
    -------
    list of StippledPoints
        In the unit square, y up.

    Raises
    ------
    FormatError
        As by ``read_stipplings``, or if a point lies beyond the picture.
    """
    ends = tuple(float(end) for side in size for end in (0, side))
    found = read_stipplings(path, replace(options, bounds=ends))
    return [replace(one, points=_turned(one.points)) for one in found]


def read_plane_stipplings(
    path: str | os.PathLike[str], options: ReadingOptions, size: tuple[int, int]
) -> list[StippledPoints]:
    """Read stipplings of an image by any program, finding out their unit.

    Parameters
    ----------
    path : path-like
        The file.
    options : ReadingOptions
        How it is read. Where they tell no box, this is the unit square, y up, if no coordinate is beyond 1,
        or else the picture in pixels, y down, or else the box that the file tells, y up. Where they name no
        columns, these are all, or x and y, or the first two where none has a name: a third is often the
        size of dots.
    size : (width, height)
        Pixels of the image.

    Returns
    -------
    list of StippledPoints
        Of a plane, in the unit square, y up.

    Raises
    ------
    FormatError
        If it cannot be read, or is of a volume.
    """
    units: list[tuple[bool, ReadingOptions]] = [(False, options)]
    if options.period is None and options.bounds is None:
        square = replace(options, bounds=(0.0, 1.0, 0.0, 1.0))
        units = [(False, square), (True, options), (False, options)]
    faults: list[FormatError] = []
    volume = False
    for columns in (options.columns,) if options.columns is not None else COLUMNS:
        if volume and columns == NAMED:
            continue
        for down, chosen in units:
            taken = replace(chosen, columns=columns)
            try:
                found = read_pixel_stipplings(path, taken, size) if down else read_stipplings(path, taken)
            except FormatError as error:
                faults.append(error)
                continue
            if all(one.points.shape[1] == 2 for one in found):
                return found
            volume = True
    if volume:
        raise FormatError(Path(path), "holds no points of a plane: name two columns by --columns")
    raise faults[min(1, len(faults) - 1)]  # of pixels, where the file might be of both


def _turned(points: FloatArray) -> FloatArray:
    """Count y from the lower border."""
    turned = points.copy()
    turned[:, 1] = 1 - turned[:, 1]
    return turned


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
