"""Arrays in numpy's own format, checked before they are believed: header, type, shape, length; no pickles."""

from __future__ import annotations

import struct
import tokenize
import warnings
from pathlib import Path
from typing import IO, Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import FormatError
from gbnbench.io.points.columns import advice, choose
from gbnbench.io.points.point_file import MAPPED_FROM
from gbnbench.io.points.point_sets import Coordinates

UNSAFE = "a pickle, which can run any code when it is read: refused as unsafe"

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
_HEADERS = {
    (1, 0): np.lib.format.read_array_header_1_0,
    (2, 0): np.lib.format.read_array_header_2_0,
    (3, 0): np.lib.format.read_array_header_2_0,  # differs by UTF-8 in the names of fields
}


def read_array(path: Path, file: IO[bytes], size: int, where: str, *, mappable: bool = False) -> NDArray[Any]:
    """Read one array.

    Parameters
    ----------
    path : Path
        Named in errors.
    file : binary file
        At the array's first byte.
    size : int
        Its bytes, with the header.
    where : str
        What errors begin with.
    mappable : bool
        Whether ``path`` is the file itself, so that a large array may be mapped: its pages are then read as
        they are needed, and may be written to, which does not change the file.

    Returns
    -------
    array
        Of any type but objects.

    Raises
    ------
    FormatError
        If the header is damaged, the array holds Python objects, or its bytes do not fill its shape.
    """
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("error")  # headers that Python 2 wrote, or broken ones, warn
            version = np.lib.format.read_magic(file)
            if version not in _HEADERS:
                raise FormatError(
                    path, f"{where}.npy version {version} is not known; save it anew with numpy"
                )
            shape, fortran, dtype = _HEADERS[version](file)
    except FormatError:
        raise
    except _BROKEN_HEADER as error:
        raise FormatError(path, f"{where}a damaged .npy header: {brief(error)}") from None
    if dtype.hasobject:
        raise FormatError(
            path,
            f"{where}an array of Python objects is {UNSAFE}; save it as an array of floats, astype(float)",
        )
    if dtype.subdtype is not None:
        raise FormatError(path, f"{where}a damaged .npy header: numpy writes no array of type {dtype}")
    count = 1
    for length in shape:
        count *= int(length)
    there = size - file.tell()
    if there != count * dtype.itemsize:
        said = f"shape {shape} of {dtype} needs {count * dtype.itemsize} bytes, and {there} are there"
        raise FormatError(path, f"{where}{said}: truncated or damaged")
    if count * dtype.itemsize == 0:
        raise FormatError(path, f"{where}holds no points: its shape is {shape}, {dtype}")
    if mappable and count * dtype.itemsize >= MAPPED_FROM:
        pages = np.memmap(path, dtype, "c", file.tell(), (count,))
        return np.asarray(pages).reshape(shape, order="F" if fortran else "C")
    array = np.empty(count, dtype)
    if file.readinto(array.view(np.uint8).data) != array.nbytes:  # type: ignore[attr-defined]
        raise FormatError(path, f"{where}the array is truncated")
    return array.reshape(shape, order="F" if fortran else "C")


def as_sets(
    path: Path, array: NDArray[Any], where: str, columns: tuple[str, ...] | None, *, box_told: bool,
    named: bool = False,
) -> list[Coordinates]:  # fmt: skip
    """Take an array for one set or several.

    Parameters
    ----------
    path : Path
        Named in errors.
    array : (n, d) or (realizations, n, d) array
        Of floats; of whole numbers only where the box is told, since they are no points of the unit torus;
        or (n,) of a structure, whose fields are columns.
    where : str
        What errors begin with.
    columns : tuple of str, optional
        Columns that are coordinates.
    box_told : bool
        Whether the user told the box.
    named : bool
        Whether the array has the name that our own archives give to points, whose rows are points.

    Returns
    -------
    list of Coordinates

    Raises
    ------
    FormatError
        If type or shape are others.
    """
    bare = not named and columns is None
    if array.dtype.names is not None:
        array = _of_fields(path, array, where, columns)
        columns = None
    if array.dtype.kind in "iu" and not box_told:
        raise FormatError(
            path,
            f"{where}coordinates must be floats; got type {array.dtype}: of whole numbers, such as pixels, "
            "give the box, such as --period 512,512",
        )
    if array.dtype.kind not in "fiu":
        parts = ": save numpy.column_stack([z.real, z.imag])" if array.dtype.kind == "c" else ""
        raise FormatError(path, f"{where}coordinates must be floats; got type {array.dtype}{parts}")
    if array.ndim not in (2, 3) or min(array.shape) < 1:
        line = ": of points on a line save x[:, None]" if array.ndim == 1 else ""
        said = f"the shape must be (n, d) or (realizations, n, d); got {array.shape}{line}"
        raise FormatError(path, where + said)
    if columns is not None:
        array = array[..., choose(path, columns, (), array.shape[-1])]
    points = array.astype(np.float64, order="C", copy=False)
    stack = points if points.ndim == 3 else points[None]
    return [
        Coordinates(x, where=where if len(stack) == 1 else f"{where}set {k}: ", bare=bare)
        for k, x in enumerate(stack)
    ]


def _of_fields(path: Path, array: NDArray[Any], where: str, columns: tuple[str, ...] | None) -> NDArray[Any]:
    names = array.dtype.names or ()
    lists = [name for name in names if array[name].ndim == 2]
    alone = (
        f"field {lists[0]!r} is an array: save it alone, numpy.save(FILE, x[{lists[0]!r}])" if lists else ""
    )
    if columns is None:
        said = f"{where}a structured array, with fields {', '.join(names[:8])}"
        raise FormatError(path, f"{said}: {alone or f'say which are coordinates; {advice(names)}'}")
    fields = [array[names[at]] for at in choose(path, columns, names, len(names))]
    if any(field.dtype.kind not in "fiu" or field.shape != array.shape for field in fields):
        raise FormatError(
            path, f"{where}fields {', '.join(columns)} must each hold a number a point{alone and '; '}{alone}"
        )
    return np.stack(fields, axis=-1)


def brief(error: BaseException) -> str:
    """First line of an error's text, cut short."""
    return (str(error).splitlines() or [type(error).__name__])[0][:100]
