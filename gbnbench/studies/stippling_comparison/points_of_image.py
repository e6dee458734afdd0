"""Points on an image by any program: in the unit square with y up, or in pixels with y down."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from gbnbench.core.errors import FormatError, InputError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points import ReadingOptions
from gbnbench.runs.file_sets import FileSets, read_groups

COLUMNS = (None, ("x", "y"), ("1", "2"))  # tried in turn; stipplings often have a third, the size of dots


def sets_on_image(
    path: Path, shape: tuple[int, int], reading: ReadingOptions
) -> list[tuple[FloatArray, str]]:
    """Read the sets of a file or folder.

    Parameters
    ----------
    path : Path
        Points with x to the right.
    shape : (rows, columns)
        Pixels of the image.
    reading : ReadingOptions
        How they are read. Where they tell no box, coordinates are fractions of the image's sides with y up if
        none is beyond 1, and pixels with y down from the upper border otherwise; in a box that is told y is
        up. Where they name no columns, these are all, or x and y, or the first two.

    Returns
    -------
    list of ((sets, n, 2) float64, str)
        Positions in pixels, rows first, and the checksum of the files, for each n.

    Raises
    ------
    InputError
        If a file cannot be read, or holds no points of a plane.
    """
    faults: list[InputError] = []
    for options in _attempts(shape, reading):
        try:
            groups = read_groups(path, options)
        except InputError as error:
            faults.append(error)
            continue
        if all(group.sets.shape[2] == 2 for group in groups):
            down = options.bounds is not None and reading.bounds is None
            return [(_pixels(group, shape, down), group.digest) for group in groups]
    if not faults:
        raise FormatError(path, "holds no points of a plane: name two columns by --columns")
    raise faults[min(1, len(faults) - 1)]  # of pixels, where the file might be of both


def _attempts(shape: tuple[int, int], reading: ReadingOptions) -> Iterator[ReadingOptions]:
    """Ways of reading: fractions, then pixels, of ever fewer columns."""
    told = reading.period is not None or reading.bounds is not None
    boxes = (reading.bounds,) if told else (None, (0.0, float(shape[1]), 0.0, float(shape[0])))
    columns = COLUMNS if reading.columns is None else (reading.columns,)
    for names in columns:
        for bounds in boxes:
            yield dataclasses.replace(reading, columns=names, bounds=bounds)


def _pixels(group: FileSets, shape: tuple[int, int], down: bool) -> FloatArray:
    """Turn fractions of the box into pixels, rows first."""
    return rows_first(group.sets * np.array(shape[::-1]) if down else group.sets, shape, down)


def rows_first(points: FloatArray, shape: tuple[int, int], down: bool) -> FloatArray:
    """Turn points with x first into pixels, rows first.

    Parameters
    ----------
    points : (..., 2) float64
        In pixels with y down, or in the unit square with y up.
    shape : (rows, columns)
        Pixels of the image.
    down : bool
        Which of the two.

    Returns
    -------
    (..., 2) float64
        Within the image.
    """
    sides = np.array(shape, np.float64)
    x = points if down else np.stack([points[..., 0], 1 - points[..., 1]], axis=-1) * sides[::-1]
    found: FloatArray = np.clip(x[..., ::-1], 0, np.nextafter(sides, 0))
    return np.ascontiguousarray(found)
