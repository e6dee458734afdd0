"""Binary numbers without a header, whose layout the user says: ``float32,3``."""

from __future__ import annotations

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.io.points.columns import choose
from gbnbench.io.points.point_file import PointFile
from gbnbench.io.points.point_sets import Coordinates, FileContent


def read_raw(file: PointFile) -> FileContent:
    """Read one set of the layout that ``file.options.raw`` says.

    Parameters
    ----------
    file : PointFile
        With ``options.raw``.

    Returns
    -------
    FileContent

    Raises
    ------
    FormatError
        If the bytes are no whole number of points, or all of them are zero.
    """
    dtype, d = file.options.layout()
    data = file.read()
    if len(data) % (d * dtype.itemsize):
        raise FormatError(
            file.path,
            f"{len(data)} bytes are no whole number of points of {d} {dtype.name}, "
            f"which take {d * dtype.itemsize} bytes each",
        )
    if len(data) > d * dtype.itemsize and not any(data):
        raise FormatError(file.path, "all bytes are zero: the file was never written")
    points = np.frombuffer(data, dtype).reshape(-1, d)
    if file.options.columns is not None:
        points = points[:, choose(file.path, file.options.columns, (), d)]
    with np.errstate(invalid="ignore"):  # signalling nan
        return FileContent([Coordinates(points.astype(np.float64, order="C"))])
