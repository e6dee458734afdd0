"""Stipplings of an image by anybody: whether they are told in pixels or in the unit square is found out."""

from __future__ import annotations

import os
from dataclasses import replace
from pathlib import Path

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points.options import ReadingOptions
from gbnbench.io.points.stippled_points import StippledPoints, read_stipplings

NAMED = ("x", "y")
COLUMNS = (None, NAMED, ("1", "2"))  # of a plane, tried in turn
CORNER, STRAYS_FROM = 2.0, 4  # pixels that so many points of an image do not all lie in


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
        If it cannot be read, is of a volume, or would be taken as pixels and lie in one corner of the
        picture, as points of the unit square do of which one is beyond it.
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
                if down:
                    _refuse_strays(Path(path), found, size)
                return found
            volume = True
    if volume:
        raise FormatError(Path(path), "holds no points of a plane: name two columns by --columns")
    raise faults[min(1, len(faults) - 1)]  # of pixels, where the file might be of both


def _refuse_strays(path: Path, found: list[StippledPoints], size: tuple[int, int]) -> None:
    """Refuse points that fill a corner of a few pixels, and so are hardly told in pixels."""
    for one in found:
        reach = float((_turned(one.points) * np.array(size)).max())
        if len(one.points) >= STRAYS_FROM and reach < CORNER <= min(size) / 2:
            raise FormatError(
                path,
                f"coordinates go up to {reach:g}: they are not all in the unit square, and in pixels would "
                f"fill a corner of {size[0]} x {size[1]}; mend what is beyond 1, or tell the box by --bounds",
            )


def _turned(points: FloatArray) -> FloatArray:
    """Count y from the lower border."""
    turned = points.copy()
    turned[:, 1] = 1 - turned[:, 1]
    return turned
