"""Point sets in binary: numpy's .npy and .npz, and PSA's .rps (pairs of little-endian float32, no header)."""

from __future__ import annotations

import lzma
import struct
import tokenize
import warnings
import zipfile
import zlib
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import FormatError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points.file_format import refuse_large
from gbnbench.io.points.text import outside_text

_BROKEN_HEADER: tuple[type[Exception], ...] = (
    ValueError,
    TypeError,
    SyntaxError,
    OverflowError,
    MemoryError,
    RecursionError,
    LookupError,
    EOFError,
    AttributeError,
    struct.error,
    tokenize.TokenError,
    Warning,
)
_BROKEN_ZIP: tuple[type[Exception], ...] = (
    zipfile.BadZipFile,
    zlib.error,
    lzma.LZMAError,
    struct.error,
    EOFError,
    OSError,
    RuntimeError,
    ValueError,
    LookupError,
    OverflowError,
)
_HEADERS = {
    (1, 0): np.lib.format.read_array_header_1_0,
    (2, 0): np.lib.format.read_array_header_2_0,
}


def read_rps(path: Path, data: bytes, *, named: bool = True) -> list[FloatArray]:
    """Read the one 2D set of an .rps file.

    Parameters
    ----------
    path : Path
        Named in errors.
    data : bytes
        The whole file.
    named : bool
        False where only the content speaks for the format, so that what does not fit is no .rps at all.

    Returns
    -------
    list of one (n, 2) float64
    """
    if len(data) % 8:
        raise FormatError(path, f"{len(data)} bytes are not pairs of float32: truncated, or no .rps")
    if len(data) > 8 and not any(data):
        raise FormatError(path, "all bytes are zero: the file was never written")
    pairs = np.frombuffer(data, "<f4").reshape(-1, 2)
    try:
        return [_inside(path, pairs)]
    except FormatError:
        if named:
            raise
        raise FormatError(path, "is binary, in no format known here (.npy, .npz, .rps)") from None


def read_npy(path: Path, size: int) -> list[FloatArray]:
    """Read an .npy file that holds (n, d) or (realizations, n, d) floats.

    Parameters
    ----------
    path : Path
        The file.
    size : int
        Its bytes.

    Returns
    -------
    list of (n, d) float64
    """
    with path.open("rb") as file:
        array = _array(path, file, size, "")
    return _sets(path, array, "")


def read_npz(path: Path, limit: int) -> list[FloatArray]:
    """Read an .npz file: its array ``points``, else ``x``, else the only one, else each as a set.

    Parameters
    ----------
    path : Path
        The file.
    limit : int
        Bytes that the arrays may have together.

    Returns
    -------
    list of (n_i, d) float64

    Notes
    -----
    Sizes are checked as the archive declares them, before anything is unpacked.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            return _read_archive(path, archive, limit)
    except FormatError:
        raise
    except _BROKEN_ZIP as error:
        raise FormatError(path, f"a damaged .npz file: {_brief(error)}") from None


def _read_archive(path: Path, archive: zipfile.ZipFile, limit: int) -> list[FloatArray]:
    members = archive.infolist()
    names = [member.filename for member in members]
    if min(len(members), 0xFFFF) != _entries(path, len(archive.comment)):
        raise FormatError(path, "a damaged .npz file: its directory lists fewer arrays than it counts")
    if not members:
        raise FormatError(path, "the archive holds no arrays")
    if len(set(names)) < len(names) or not all(name.endswith(".npy") for name in names):
        raise FormatError(path, f"not an .npz of arrays: it holds {', '.join(map(repr, names[:4]))[:80]}")
    if {"x.npy", "y.npy"} <= set(names):
        raise FormatError(
            path, "x and y are arrays of their own; put the points in one (n, d) array 'points'"
        )
    if "power.npy" in names and not {"points.npy", "x.npy"} & set(names):
        raise FormatError(path, "is a spectrum, not points")
    chosen = next(([m] for key in ("points", "x") for m in members if m.filename == key + ".npy"), members)
    refuse_large(path, sum(m.file_size for m in chosen), limit, "unpacked, the arrays hold")
    sets: list[FloatArray] = []
    for member in chosen:
        key = f"array {member.filename.removesuffix('.npy')!r}: "
        with archive.open(member) as file:
            array = _array(path, file, member.file_size, key)
            if file.read(1):  # also checks the sum of all bytes
                raise FormatError(path, f"{key}more bytes than its header says")
        if len(chosen) > 1 and array.ndim != 2:
            said = f"{key}of several arrays each must be a set (n, d); got shape {array.shape}"
            raise FormatError(path, f"{said}; name the points 'points'")
        sets += _sets(path, array, key)
    dimensions = sorted({x.shape[1] for x in sets})
    if len(dimensions) > 1:
        raise FormatError(path, f"its sets have different dimensions: {dimensions}; name the points 'points'")
    return sets


def _entries(path: Path, comment: int) -> int:
    """Count the members by the archive's last record: zipfile does not, so damage there could lose a set."""
    with path.open("rb") as file:
        file.seek(-22 - comment, 2)
        return int.from_bytes(file.read(12)[10:], "little")


def _array(path: Path, file: Any, size: int, key: str) -> NDArray[np.floating]:
    """Read one array whose header, type and length are right; never a pickle."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # headers that Python 2 wrote, or broken ones, warn
            version = np.lib.format.read_magic(file)
            if version not in _HEADERS:
                raise FormatError(path, f"{key}.npy version {version} is not known; save it anew with numpy")
            shape, fortran, dtype = _HEADERS[version](file)
    except FormatError:
        raise
    except _BROKEN_HEADER as error:
        raise FormatError(path, f"{key}a damaged .npy header: {_brief(error)}") from None
    if dtype.kind != "f":
        raise FormatError(path, f"{key}coordinates must be floats; got type {dtype}")
    if len(shape) not in (2, 3) or min(shape) < 1:
        raise FormatError(path, f"{key}the shape must be (n, d) or (realizations, n, d); got {shape}")
    count = 1
    for length in shape:
        count *= int(length)
    there = size - file.tell()
    if there != count * dtype.itemsize:
        said = f"shape {shape} of {dtype} needs {count * dtype.itemsize} bytes, and {there} are there"
        raise FormatError(path, f"{key}{said}: truncated or damaged")
    array = np.empty(count, dtype)
    if file.readinto(array.view(np.uint8).data) != array.nbytes:
        raise FormatError(path, f"{key}the array is truncated")
    return array.reshape(shape, order="F" if fortran else "C")


def _sets(path: Path, array: NDArray[np.floating], key: str) -> list[FloatArray]:
    points = _inside(path, array, key)
    return list(points) if points.ndim == 3 else [points]


def _inside(path: Path, array: NDArray[np.floating], key: str = "") -> FloatArray:
    """As float64 in C order with 1.0 wrapped to 0; whatever else lies outside [0, 1) is refused."""
    with np.errstate(invalid="ignore"):  # signalling nan
        if not (array.min() >= 0 and array.max() <= 1):  # nan is neither
            where = tuple(int(i) for i in np.argwhere(~((array >= 0) & (array <= 1)))[0])
            raise FormatError(path, f"{key}{outside_text(float(array[where]))} (index {where})")
    points = np.require(array, np.float64, ["C", "W"])
    points[points == 1] = 0
    return points


def _brief(error: BaseException) -> str:
    """First line of an error's text, cut short."""
    return (str(error).splitlines() or [type(error).__name__])[0][:100]
