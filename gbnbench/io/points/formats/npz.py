"""numpy's .npz: an archive of arrays, of which one, or each of those named so, holds sets."""

from __future__ import annotations

import io
import lzma
import re
import struct
import zipfile
import zlib
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import FormatError
from gbnbench.io.points.file_format import refuse_large
from gbnbench.io.points.formats.format import Format
from gbnbench.io.points.formats.npy import same_size, stack
from gbnbench.io.points.formats.numpy_array import UNSAFE, as_sets, brief, read_array
from gbnbench.io.points.point_file import PointFile
from gbnbench.io.points.point_sets import Box, FileContent, PointSets, in_own_unit

POINTS = "points"
LOW, SIDES, TOROIDAL = "box_low", "box_sides", "box_toroidal"  # arrays that tell the box

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
_SET = re.compile(r"set_([0-9]{1,9})")


def _recognises(file: PointFile) -> bool:
    return file.head.startswith((b"PK\x03\x04", b"PK\x05\x06"))


def _read(file: PointFile) -> FileContent:
    """Read the points; sizes are checked as the archive declares them, before anything is unpacked."""
    try:
        with file.open() as opened, zipfile.ZipFile(opened) as archive:
            return _read_archive(file, archive, _entries(opened, len(archive.comment)))
    except FormatError:
        raise
    except _BROKEN_ZIP as error:
        raise FormatError(file.path, f"a damaged .npz file: {brief(error)}") from None


def _read_archive(file: PointFile, archive: zipfile.ZipFile, entries: int) -> FileContent:
    path, options = file.path, file.options
    members = {member.filename.removesuffix(".npy"): member for member in archive.infolist()}
    names = [member.filename for member in archive.infolist()]
    if min(len(names), 0xFFFF) != entries:
        raise FormatError(path, "a damaged .npz file: its directory lists fewer arrays than it counts")
    if not members:
        raise FormatError(path, "the archive holds no arrays")
    if any(name.endswith(".pkl") for name in names):
        raise FormatError(path, f"holds {UNSAFE}; save the points with numpy.save or as text")
    if "[Content_Types].xml" in names:
        raise FormatError(path, "is an Office document, not points: save its sheet as .csv")
    if len(set(names)) < len(names) or not all(name.endswith(".npy") for name in names):
        held = ", ".join(map(repr, names[:4]))[:80]
        raise FormatError(
            path, f"not an .npz of arrays: it holds {held}: unpack it, and name the points' file"
        )
    chosen = _choose(file, [*members])
    told = [] if options.array is not None else [n for n in (LOW, SIDES, TOROIDAL) if n in members]
    size = sum(members[name].file_size for name in (*chosen, *told))
    refuse_large(path, size, file.limit, "unpacked, the arrays hold")

    def array(name: str) -> NDArray[Any]:
        member = members[name]
        with archive.open(member) as opened:
            found = read_array(path, opened, member.file_size, f"array {name!r}: ")
            if opened.read(1):  # also checks the sum of all bytes
                raise FormatError(path, f"array {name!r}: more bytes than its header says")
        return found

    box_told = options.period is not None or options.bounds is not None or bool(told)
    sets = []
    for name in chosen:
        found = array(name)
        if len(chosen) > 1 and found.ndim != 2:
            said = f"array {name!r}: of several arrays each must be a set (n, d); got shape {found.shape}"
            raise FormatError(path, f"{said}; name the points 'points'")
        named = name == POINTS or _SET.fullmatch(name) is not None
        where = f"array {name!r}: "
        sets += as_sets(path, found, where, options.columns, box_told=box_told, named=named)
    dimensions = sorted({one.points.shape[1] for one in sets})
    if len(dimensions) > 1:
        raise FormatError(path, f"its sets have different dimensions: {dimensions}; take one by --array")
    return FileContent(sets, _box(file, {name: array(name) for name in told}, dimensions[0]))


def _choose(file: PointFile, names: list[str]) -> list[str]:
    """Names of the arrays that hold points, where there is no doubt which do."""
    path, wanted = file.path, file.options.array
    if wanted is not None:
        if wanted not in names:
            raise FormatError(path, f"has no array {wanted!r}; its arrays are {', '.join(names)}")
        return [wanted]
    if POINTS in names:
        return [POINTS]
    points = [name for name in names if name not in (LOW, SIDES, TOROIDAL)]
    if len(points) == 1:
        return points
    if {"x", "y"} <= set(names):
        raise FormatError(
            path, "x and y are arrays of their own; put the points in one (n, d) array 'points'"
        )
    if "power" in names:
        raise FormatError(path, "is a spectrum, not points")
    numbers = [int(match[1]) for match in map(_SET.fullmatch, points) if match]
    if sorted(numbers) == list(range(len(points))):
        return [f"set_{k}" for k in range(len(points))]
    shown = ", ".join(names[:8]) + (", ..." if len(names) > 8 else "")
    raise FormatError(
        path,
        f"holds the arrays {shown}: say which are the points, such as --array {(points or names)[0]}",
    )


def _box(file: PointFile, told: dict[str, NDArray[Any]], d: int) -> Box | None:
    if not told:
        return None
    low, sides, toroidal = told.get(LOW, np.zeros(d)), told.get(SIDES), told.get(TOROIDAL)
    if (
        sides is None or sides.shape != (d,) or low.shape != (d,) or sides.dtype.kind not in "fiu"
        or low.dtype.kind not in "fiu" or not (np.isfinite(low).all() and np.isfinite(sides).all())
        or not (sides > 0).all()
        or (toroidal is not None and (toroidal.shape != () or toroidal.dtype != bool))
    ):  # fmt: skip
        raise FormatError(
            file.path,
            f"{SIDES} and {LOW} must be {d} numbers each, sides > 0, and {TOROIDAL} a bool",
        )
    periodic = None if toroidal is None else (bool(toroidal),) * d
    return Box(tuple(map(float, low)), tuple(map(float, sides)), periodic)


def _entries(opened: Any, comment: int) -> int:
    """Count the members by the archive's last record: zipfile does not, so damage there could lose a set."""
    opened.seek(-22 - comment, 2)
    return int.from_bytes(opened.read(12)[10:], "little")


def _write(x: PointSets) -> bytes:
    file = io.BytesIO()
    sets = in_own_unit(x)
    arrays: dict[str, Any] = (
        {POINTS: stack(sets)} if same_size(sets) else {f"set_{k}": s for k, s in enumerate(sets)}
    )
    if x.sides is not None:
        arrays |= {SIDES: np.array(x.sides), LOW: np.array(x.low)}
        if x.toroidal is not None:
            arrays[TOROIDAL] = np.array(x.toroidal)
    np.savez(file, **arrays)
    return file.getvalue()


NPZ = Format(
    "numpy archive",
    (".npz",),
    _recognises,
    _read,
    {".npz": _write},
    frozenset({"columns", "array"}),
    keeps_box=True,
)
