"""Points on an image by any program: files in the unit square with y up, or in pixels with y down."""

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
        The points, x to the right.
    shape : (rows, columns)
        Pixels of the image.
    reading : ReadingOptions
        How they are read. Where they tell no box, this is the unit square if no coordinate is beyond 1; y
        goes up in it, as in a box that is told. Otherwise coordinates are pixels, and y goes down from the
        upper border. Where they name no columns, these are all, or x and y, or the first two.

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
    for options, down in _attempts(shape, reading):
        try:
            groups = read_groups(path, options)
        except InputError as error:
            faults.append(error)
            continue
        if all(group.sets.shape[2] == 2 for group in groups):
            return [(_pixels(group, shape, down), group.digest) for group in groups]
    if not faults:
        raise FormatError(path, "holds no points of a plane: name two columns by --columns")
    raise faults[min(1, len(faults) - 1)]  # of pixels, where the file might be of both


def _attempts(shape: tuple[int, int], reading: ReadingOptions) -> Iterator[tuple[ReadingOptions, bool]]:
    """Ways of reading, and whether y goes down: the unit square, pixels, the file's box; fewer columns."""
    boxes: list[tuple[tuple[float, ...] | None, bool]] = [(reading.bounds, False)]
    if reading.period is None and reading.bounds is None:
        rows, columns = map(float, shape)
        boxes = [((0.0, 1.0, 0.0, 1.0), False), ((0.0, columns, 0.0, rows), True), *boxes]
    for names in COLUMNS if reading.columns is None else (reading.columns,):
        for bounds, down in boxes:
            yield dataclasses.replace(reading, columns=names, bounds=bounds), down


def _pixels(group: FileSets, shape: tuple[int, int], down: bool) -> FloatArray:
    """Turn fractions of the box, x first, into pixels, rows first."""
    fractions = group.sets[..., ::-1]
    return rows_first(fractions if down else fractions * [-1, 1] + [1, 0], shape)


def rows_first(fractions: FloatArray, shape: tuple[int, int]) -> FloatArray:
    """Turn fractions of an image into pixels.

    Parameters
    ----------
    fractions : (..., 2) float64
        Down and to the right, each 0 to 1.
    shape : (rows, columns)
        Pixels of the image.

    Returns
    -------
    (..., 2) float64
        Below ``shape``.
    """
    sides = np.array(shape, np.float64)
    return np.ascontiguousarray(np.minimum(fractions * sides, np.nextafter(sides, 0)))
