"""XYZ of chemistry: a count, a comment, and a line ``symbol x y z`` an atom; extended XYZ tells its cell.

The comment of extended XYZ holds ``Lattice="ax ay az bx by bz cx cy cz"``, ``Properties=species:S:1:pos:R:3``
and ``pbc="T T T"``, as ASE and OVITO write them; a cell that is no box of right angles is refused.
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from gbnbench.core.errors import FormatError, InputError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points.formats.axes import DIMENSION, axes_of, is_plane, refuse_plane
from gbnbench.io.points.formats.axes import XYZ as AXES
from gbnbench.io.points.formats.format import Format
from gbnbench.io.points.literals import NUMBER
from gbnbench.io.points.point_file import PointFile
from gbnbench.io.points.point_sets import Box, Coordinates, FileContent, PointSets, in_own_unit
from gbnbench.io.points.text_lines import lines_of, numbers_of, whole_number

_PAIR = re.compile(r"""([A-Za-z_][\w-]*)=(?:"([^"]*)"|'([^']*)'|(\S+))""")
_SUFFIXES = (".xyz", ".extxyz")


def _recognises(file: PointFile) -> bool:
    """Tell it by a count, any line, and a line of a symbol and three numbers; or a Lattice under its name."""
    lines = file.head.removeprefix(b"\xef\xbb\xbf").splitlines()
    if len(lines) < 3 or not lines[0].strip().isdigit():
        return False
    cells = lines[2].split()
    least = 1 if file.suffix in _SUFFIXES else 3  # under its name even an atom of too few numbers is one
    symbol = cells[:1] != [] and cells[0][:1].isalpha()
    symbol = symbol and sum(bool(NUMBER.fullmatch(c)) for c in cells[1:]) >= least
    numbered = (
        file.suffix in _SUFFIXES and len(cells) > 3 and cells[0].isdigit() and not _all_numbers(lines[1])
    )
    return symbol or numbered or b"Lattice=" in lines[1] or b"Properties=" in lines[1]


def _all_numbers(line: bytes) -> bool:
    cells = line.split()
    return bool(cells) and all(NUMBER.fullmatch(cell) for cell in cells)


def _read(file: PointFile) -> FileContent:
    path, columns = file.path, file.options.columns
    axes = axes_of(path, columns, AXES)
    lines = lines_of(file.read())
    sets: list[Coordinates] = []
    first: Box | None = None
    at = 0
    while at < len(lines):
        n = whole_number(path, lines[at], at + 1, "the number of atoms")
        comment = lines[at + 1] if at + 1 < len(lines) else b""
        box, column, spatial = _comment(path, comment, at + 2)
        if sets and box != first:
            raise FormatError(path, "this set has another cell than the first: split them", at + 2)
        first = box
        rows = lines[at + 2 : at + 2 + n]
        if len(rows) < n:
            raise FormatError(path, f"this line says {n} atoms, and the file ends after {len(rows)}", at + 1)
        points = np.array([_atom(path, row, column, at + 3 + k) for k, row in enumerate(rows)])
        if not spatial:
            refuse_plane(path, points, columns, at + 3)
        sets.append(Coordinates(points[:, axes], np.arange(at + 3, at + 3 + n)))
        at += 2 + n
    if first is not None:
        low, sides, periodic = first.low, first.sides, first.periodic or ()
        first = Box(
            tuple(low[a] for a in axes), tuple(sides[a] for a in axes), tuple(periodic[a] for a in axes)
        )
    return FileContent(sets, first)


def _atom(path: Path, row: bytes, column: int, line: int) -> list[float]:
    cells = row.split()
    if len(cells) < column + 3:
        raise FormatError(path, f"an atom is 'symbol x y z'; here are {len(cells)} columns", line)
    return numbers_of(path, cells[column : column + 3], line)


def _comment(path: Path, comment: bytes, line: int) -> tuple[Box | None, int, bool]:
    """Read the cell, the column where coordinates start, and whether points are said to be of space."""
    text = comment.decode("utf-8", "backslashreplace")
    pairs = {name.lower(): a or b or c for name, a, b, c in _PAIR.findall(text)}
    column = 1
    if "properties" in pairs:
        fields = pairs["properties"].split(":")
        widths = fields[2::3]
        if len(fields) % 3 or not all(w.isascii() and w.isdigit() and len(w) < 6 for w in widths):
            raise FormatError(path, "Properties must be name:type:columns of each, such as pos:R:3", line)
        names = [name.lower() for name in fields[::3]]
        if "pos" not in names or fields[3 * names.index("pos") + 1 : 3 * names.index("pos") + 3] != [
            "R",
            "3",
        ]:
            raise FormatError(path, "Properties name no pos:R:3, the coordinates", line)
        column = sum(int(w) for w in widths[: names.index("pos")])
    spatial = pairs.get(DIMENSION) == "3"
    if "lattice" not in pairs:
        return None, column, spatial
    lattice = _floats(path, pairs["lattice"], 9, "Lattice", line)
    origin = _floats(path, pairs.get("origin", "0 0 0"), 3, "Origin", line)
    sides = lattice[::4]
    if any(v != 0 for k, v in enumerate(lattice) if k % 4) or not all(0 < side < np.inf for side in sides):
        raise FormatError(
            path, "its cell is no box of right angles along the axes: only such boxes are read", line
        )
    flags = pairs.get("pbc", "T T T").replace(",", " ").split()
    if len(flags) != 3 or not all(flag.upper() in ("T", "F", "1", "0", "TRUE", "FALSE") for flag in flags):
        raise FormatError(path, 'pbc must be three of T and F, such as pbc="T T F"', line)
    periodic = tuple(flag.upper() in ("T", "1", "TRUE") for flag in flags)
    return Box(tuple(origin), tuple(sides), periodic), column, spatial


def _floats(path: Path, text: str, count: int, name: str, line: int) -> list[float]:
    values = numbers_of(path, text.replace(",", " ").encode().split(), line)
    if len(values) != count:
        raise FormatError(path, f"{name} must be {count} numbers; here are {len(values)}", line)
    return values


def _write(x: PointSets) -> bytes:
    d = x.sets[0].shape[1]
    if d != 3:
        raise InputError(f"XYZ holds points of three dimensions; got d={d}")
    comment = ""
    if x.sides is not None and x.low is not None:
        if x.toroidal is None:
            raise InputError(
                "extended XYZ says whether its cell is periodic, which is not known here: give the sides by "
                "--period for a torus"
            )
        lattice = " ".join(repr(side) if row == column else "0.0" for row, side in enumerate(x.sides)
                           for column in range(3))  # fmt: skip
        flag = "T" if x.toroidal else "F"
        origin = " ".join(map(repr, x.low))
        comment = (
            f'Lattice="{lattice}" Origin="{origin}" Properties=species:S:1:pos:R:3 pbc="{flag} {flag} {flag}"'
        )
    return "".join(
        f"{len(s)}\n{_noted(comment, s)}\n" + "".join(f"X {a!r} {b!r} {c!r}\n" for a, b, c in s.tolist())
        for s in in_own_unit(x)
    ).encode()


def _noted(comment: str, s: FloatArray) -> str:
    """Add to a comment that a set is of space, where it would else be taken for one of the plane."""
    return f"{comment} {DIMENSION}=3".lstrip() if is_plane(s) else comment


XYZ = Format(
    "XYZ", _SUFFIXES, _recognises, _read, {".xyz": _write, ".extxyz": _write}, frozenset({"columns"}),
    keeps_box=True,
)  # fmt: skip
