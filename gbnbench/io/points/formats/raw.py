"""Binary numbers without a header, whose layout the user says: ``float32,3``."""

from __future__ import annotations

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.io.points.columns import choose
from gbnbench.io.points.file_format import NUMERIC
from gbnbench.io.points.formats.float_layouts import LAYOUTS, better_layout
from gbnbench.io.points.formats.foreign import JPEG, SIGNATURES
from gbnbench.io.points.point_file import PointFile
from gbnbench.io.points.point_sets import Coordinates, FileContent

_SURE = 4  # bytes that numbers hardly ever happen to begin with
_HEADERS = (
    (b"\x93NUMPY", "is a numpy array"),
    (b"PK\x03\x04", "is an archive, such as .npz"),
    (b"%!PS", "is PostScript"),
    (b"ply\n", "is a PLY file"),
    (b"ply\r", "is a PLY file"),
    (b"ITEM: ", "is a LAMMPS dump"),
)


def known_by_name(file: PointFile) -> str | None:
    """Say what a file is, where its first bytes are the header of a known format or numbers in text.

    Parameters
    ----------
    file : PointFile
        Any file.

    Returns
    -------
    str or None
        For an error; None for numbers without a header.
    """
    head = file.head
    for header, what in _HEADERS:
        if head.startswith(header):
            return what
    for signature, what, _ in SIGNATURES:
        if head.startswith(signature) and len(signature) >= _SURE - (signature == JPEG):
            return f"is {what}"
    if len(head) >= 4 * _SURE and not head.translate(None, NUMERIC + b" \t\r\n,;"):
        return "is text"
    return None


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
        If the bytes are no whole number of points, all of them are zero, or they begin as a known format.
    """
    dtype, d = file.options.layout()
    if (known := known_by_name(file)) is not None:
        raise FormatError(file.path, f"{known}, and --raw is for numbers without a header: leave it out")
    data = file.numbers()
    if len(data) % (d * dtype.itemsize):
        raise FormatError(
            file.path,
            f"{len(data)} bytes are no whole number of points of {d} {dtype.name}, "
            f"which take {d * dtype.itemsize} bytes each",
        )
    if len(data) > d * dtype.itemsize and not any(data):
        raise FormatError(file.path, "all bytes are zero: the file was never written")
    told = file.options.period is not None or file.options.bounds is not None or file.options.wrap
    other = None if told or dtype.kind != "f" else better_layout(data, dtype)
    if other is not None and len(data) % (d * np.dtype(LAYOUTS[other]).itemsize) == 0:
        raise FormatError(
            file.path,
            f"its numbers are points of the unit torus as {other}, not as {dtype.name}: "
            f"--raw '{other},{d}' reads it",
        )
    points = np.frombuffer(data, dtype).reshape(-1, d)
    if file.options.columns is not None:
        points = points[:, choose(file.path, file.options.columns, (), d)]
    with np.errstate(invalid="ignore"):  # signalling nan
        return FileContent([Coordinates(points.astype(np.float64, order="C", copy=False))])
