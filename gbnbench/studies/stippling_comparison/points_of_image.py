"""Points on an image by any program: files in pixels, or in fractions of the image's sides."""

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
        Points with x to the right and y down from the upper border.
    shape : (rows, columns)
        Pixels of the image.
    reading : ReadingOptions
        How they are read. Where they tell no box, coordinates are fractions of the image's sides if none is
        beyond 1, and pixels otherwise. Where they name no columns, these are all, or x and y, or the first
        two.

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
            return [(_pixels(group, shape), group.digest) for group in groups]
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


def _pixels(group: FileSets, shape: tuple[int, int]) -> FloatArray:
    """Turn fractions of the box, x first, into pixels, rows first."""
    sides = np.array(shape, np.float64)
    found: FloatArray = np.minimum(group.sets[..., ::-1] * sides, np.nextafter(sides, 0))
    return np.ascontiguousarray(found)
