"""Text dumps of LAMMPS: the atoms of each timestep are a set, in the box that the dump tells.

Columns x, y, z are lengths; xs, ys, zs fractions of the box; xu and xsu the same before atoms were brought
back into the box, which is done here as their definition says (LAMMPS, dump command). Slanted boxes are
refused.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from gbnbench.core.errors import FormatError, InputError
from gbnbench.io.points.formats.axes import DIMENSION, XYZ, axes_of, is_plane, refuse_plane
from gbnbench.io.points.formats.format import Format
from gbnbench.io.points.literals import shown
from gbnbench.io.points.point_file import PointFile
from gbnbench.io.points.point_sets import Box, Coordinates, FileContent, PointSets, in_own_unit
from gbnbench.io.points.text_lines import lines_of, numbers_of, whole_number

_FAMILIES = ("", "s", "u", "su")  # what follows x, y, z in the names of the columns


def _recognises(file: PointFile) -> bool:
    return file.head.removeprefix(b"\xef\xbb\xbf").lstrip().startswith(b"ITEM:")


def _read(file: PointFile) -> FileContent:
    path, lines = file.path, lines_of(file.read())
    sets: list[Coordinates] = []
    first: Box | None = None
    n, box = 0, None
    at = 0
    while at < len(lines):
        line = lines[at]
        if not line.startswith(b"ITEM:"):
            raise FormatError(path, f"{shown(line)} where a line 'ITEM: ...' would stand", at + 1)
        item, following = line[5:].strip(), lines[at + 1] if at + 1 < len(lines) else b""
        if item == b"NUMBER OF ATOMS":
            n = whole_number(path, following, at + 2, "the number of atoms")
        elif item.startswith(b"BOX BOUNDS"):
            box = _box(path, item, lines, at)
        elif item.startswith(b"ATOMS"):
            if box is None or n == 0:
                raise FormatError(path, "ATOMS before NUMBER OF ATOMS and BOX BOUNDS", at + 1)
            found, own = _atoms(file, item.split()[1:], lines, at, n, box)
            if sets and own != first:
                raise FormatError(path, "this timestep has another box than the first: split them", at + 1)
            sets.append(found)
            first, n, box = own, 0, None
            at += len(found.points) + 1
            continue
        elif item not in (b"TIMESTEP", b"UNITS", b"TIME"):
            raise FormatError(path, f"{shown(line)} is no item of a dump of atoms", at + 1)
        at += 4 if item.startswith(b"BOX") else 2
    if n or box is not None or not sets:
        raise FormatError(path, "the file is truncated: no ATOMS after its last timestep", len(lines))
    return FileContent(sets, first)


def _box(path: Path, item: bytes, lines: list[bytes], at: int) -> Box:
    words = item.split()[2:]
    if any(word in (b"xy", b"xz", b"yz", b"abc") for word in words):
        raise FormatError(path, "its box is slanted (triclinic): only boxes of right angles are read", at + 1)
    if len(words) not in (0, 3) or len(lines) < at + 4:
        raise FormatError(
            path, "BOX BOUNDS must name three boundaries, such as pp pp pp, and three lines", at + 1
        )
    low, sides = [], []
    for k in range(3):
        ends = numbers_of(path, lines[at + 1 + k].split(), at + 2 + k)
        if len(ends) != 2 or not 0 < ends[1] - ends[0] < np.inf:
            raise FormatError(path, "a side of the box must be its lower and its upper end", at + 2 + k)
        low.append(ends[0])
        sides.append(ends[1] - ends[0])
    return Box(tuple(low), tuple(sides), tuple(word == b"pp" for word in words) or None)


def _atoms(
    file: PointFile, names: list[bytes], lines: list[bytes], at: int, n: int, box: Box
) -> tuple[Coordinates, Box]:
    """Read the atoms of one timestep, and the part of the box that belongs to the axes taken."""
    path, columns = file.path, file.options.columns
    words = [name.decode("utf-8", "backslashreplace") for name in names]
    wanted = None if columns is None else tuple(name.lower() for name in columns)
    family = next((f for f in _FAMILIES if "x" + f in (words if wanted is None else wanted)), None)
    if wanted is not None and family is None:
        family = next((f for f in _FAMILIES if any(name == a + f for name in wanted for a in XYZ)), "")
    if family is None:
        raise FormatError(path, f"no column of coordinates (x, xs, xu, ...): {', '.join(words)}", at + 1)
    there = tuple(axis for axis in XYZ if axis + family in words)
    if wanted is None:
        _refuse_mixed(path, words, family, at + 1)
    if wanted is not None:
        wanted = tuple(name.removesuffix(family) if len(name) > 1 else name for name in wanted)
    axes = axes_of(path, wanted, there)
    if wanted is None and there != XYZ[: len(there)]:
        raise FormatError(
            path, f"axes {', '.join(there)} are not those of a space; name them by --columns", at + 1
        )
    kept = [words.index(XYZ[a] + family) for a in axes]
    rows = lines[at + 1 : at + 1 + n]
    if len(rows) < n:
        raise FormatError(path, f"{n} atoms were told, and the file ends after {len(rows)}", at + 1)
    points = []
    for line, row in enumerate(rows, start=at + 2):
        cells = row.split()
        if len(cells) != len(words):
            raise FormatError(path, f"{len(cells)} columns where ATOMS names {len(words)}", line)
        points.append(numbers_of(path, [cells[k] for k in kept], line))
    array = np.array(points)
    if not (DIMENSION in words and rows[0].split()[words.index(DIMENSION)] == b"3"):
        refuse_plane(path, array, columns, at + 2)
    own = Box(
        tuple(box.low[a] for a in axes), tuple(box.sides[a] for a in axes),
        None if box.periodic is None else tuple(box.periodic[a] for a in axes),
    )  # fmt: skip
    unwrapped = "u" in family and own.periodic is not None and all(own.periodic)
    lines_there = np.arange(at + 2, at + 2 + n)
    return Coordinates(array, lines_there, scaled="s" in family, unwrapped=unwrapped), own


def _refuse_mixed(path: Path, words: list[str], family: str, line: int) -> None:
    """Refuse columns of several kinds where the one that is read lacks an axis of another."""
    axes = {f: {axis for axis in XYZ if axis + f in words} for f in _FAMILIES}
    if any(not found <= axes[family] for found in axes.values()):
        kinds = ", ".join(word for word in words if word[:1] in XYZ and word[1:] in _FAMILIES)
        raise FormatError(
            path,
            f"its columns {kinds} are coordinates of different kinds: dump x y z, or take those of one by "
            "--columns",
            line,
        )


def _write(x: PointSets) -> bytes:
    d = x.sets[0].shape[1]
    if d > 3:
        raise InputError(f"a LAMMPS dump holds points of at most three dimensions; got d={d}")
    if x.sides is not None and x.toroidal is None:
        raise InputError(
            "a LAMMPS dump says whether its box is periodic, which is not known here: give the sides by "
            "--period for a torus"
        )
    low, sides = x.low or (0.0,) * d, x.sides or (1.0,) * d
    flag = "ff" if x.toroidal is False else "pp"
    ends = [f"{a!r} {a + b!r}" for a, b in zip(low, sides, strict=True)] + ["-0.5 0.5"] * (3 - d)
    parts = []
    for step, s in enumerate(in_own_unit(x)):
        # a set in one plane would else be taken for one of the plane when it is read
        note, three = (f" {DIMENSION}", " 3") if is_plane(s) else ("", "")
        parts += [
            "ITEM: TIMESTEP", str(step), "ITEM: NUMBER OF ATOMS", str(len(s)),
            f"ITEM: BOX BOUNDS {flag} {flag} {flag}", *ends, f"ITEM: ATOMS id type {' '.join(XYZ[:d])}{note}",
            *(f"{k} 1 {' '.join(map(repr, row))}{three}" for k, row in enumerate(s.tolist(), start=1)),
        ]  # fmt: skip
    return ("\n".join(parts) + "\n").encode()


LAMMPS = Format(
    "LAMMPS dump", (".lammpstrj", ".dump"), _recognises, _read, {".lammpstrj": _write, ".dump": _write},
    frozenset({"columns"}), keeps_box=True,
)  # fmt: skip
