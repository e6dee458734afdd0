"""numpy's .npy: one array of (n, d) or (realizations, n, d) floats."""

from __future__ import annotations

import io

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points.formats.format import Format
from gbnbench.io.points.formats.numpy_array import as_sets, read_array
from gbnbench.io.points.point_file import PointFile
from gbnbench.io.points.point_sets import FileContent, PointSets


def _recognises(file: PointFile) -> bool:
    return file.head.startswith(b"\x93NUMPY")


def _read(file: PointFile) -> FileContent:
    options = file.options
    with file.open() as opened:
        array = read_array(file.path, opened, file.size, "", mappable=file.unpacked is None)
    told = options.period is not None or options.bounds is not None
    return FileContent(as_sets(file.path, array, "", options.columns, box_told=told))


def _write(x: PointSets) -> bytes:
    if not same_size(x.sets):
        sizes = [len(s) for s in x.sets][:6]
        raise InputError(f".npy holds sets of one size; got {sizes} points: use .npz, .txt, .dat or .csv")
    file = io.BytesIO()
    np.lib.format.write_array(file, stack(x.sets), allow_pickle=False)
    return file.getvalue()


def same_size(sets: list[FloatArray]) -> bool:
    """Whether all sets have as many points."""
    return len({len(s) for s in sets}) == 1


def stack(sets: list[FloatArray]) -> FloatArray:
    """Return sets of one size as (realizations, n, d), a single one as (n, d)."""
    return np.stack(sets) if len(sets) > 1 else sets[0]


NPY = Format("numpy array", (".npy",), _recognises, _read, {".npy": _write}, frozenset({"columns"}))
