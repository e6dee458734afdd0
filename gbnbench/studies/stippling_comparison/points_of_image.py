"""Points on an image by any program: files and folders of sets, placed on its pixels."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points import ReadingOptions
from gbnbench.io.points.image_stipplings import read_plane_stipplings
from gbnbench.runs.file_sets import checksum, files_of, joint_checksum


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
        How they are read, as ``read_plane_stipplings`` does.

    Returns
    -------
    list of ((sets, n, 2) float64, str)
        Positions in pixels, rows first, and the checksum of the files, for each n.

    Raises
    ------
    InputError
        If a file cannot be read, holds no points of a plane, or dots of several inks.
    """
    groups: dict[int, list[FloatArray]] = {}
    digests: dict[int, list[str]] = {}
    for file in files_of(path):
        found = read_plane_stipplings(file, reading, (shape[1], shape[0]))
        digest = checksum(file)
        inks = dict.fromkeys(one.ink for one in found)
        if len(inks) > 1:
            raise FormatError(
                file,
                f"its dots are of several inks ({', '.join(inks)}), and a density is of one: put those of "
                "each ink in a file of their own",
            )
        for one in found:
            groups.setdefault(len(one.points), []).append(on_pixels(one.points, shape))
            digests.setdefault(len(one.points), []).append(digest)
    return [(np.stack(sets), joint_checksum(digests[n], reading)) for n, sets in groups.items()]


def on_pixels(points: FloatArray, shape: tuple[int, int]) -> FloatArray:
    """Turn points of the unit square into pixels.

    Parameters
    ----------
    points : (..., 2) float64
        x to the right and y up, each 0 to 1.
    shape : (rows, columns)
        Pixels of the image.

    Returns
    -------
    (..., 2) float64
        Rows first, from the top, below ``shape``.
    """
    sides = np.array(shape, np.float64)
    down = points[..., ::-1] * [-1, 1] + [1, 0]
    return np.ascontiguousarray(np.minimum(down * sides, np.nextafter(sides, 0)))
