"""UTK's .edat: lower corner, upper corner, whether toric, and points; sets are parted by a line #.

After the documents and the source of UTK (Perrier, Coeurjolly et al. 2018), which writes the three lines of
the box before every set; a set of two dimensions or more that has none is of the box before it.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from gbnbench.core.errors import FormatError, InputError
from gbnbench.io.points.formats.format import Format
from gbnbench.io.points.literals import NUMBER
from gbnbench.io.points.point_file import PointFile
from gbnbench.io.points.point_sets import Box, Coordinates, FileContent, PointSets, in_own_unit
from gbnbench.io.points.text_lines import lines_of, numbers_of

_HEAD = "an .edat begins each set with its lower corner, its upper corner, and 1 where it is toric, else 0"


def _recognises(file: PointFile) -> bool:
    return file.suffix == ".edat"


def _read(file: PointFile) -> FileContent:
    path = file.path
    box: Box | None = None
    sets: list[Coordinates] = []
    for section in _sections(path, file.read()):
        rows = [(line, numbers_of(path, tokens, line)) for line, tokens in section]
        told = len(rows) > 2 and (len(rows[2][1]) == 1 or box is None)
        if told or box is None:
            own = _box(path, rows[:3])
            if box is not None and own != box:
                raise FormatError(
                    path, "this set has another box than the one before: split them", rows[0][0]
                )
            box, rows = own, rows[3:]
        if not rows:
            raise FormatError(path, "a box without points", section[0][0])
        d = len(box.sides)
        for line, row in rows:
            if len(row) != d:
                said = f"{len(row)} number{'s' * (len(row) != 1)} where a point has {d}, as its box has"
                raise FormatError(path, said, line)
        sets.append(Coordinates(np.array([row for _, row in rows]), np.array([line for line, _ in rows])))
    if not sets:
        raise FormatError(path, "the file holds no points")
    return FileContent(sets, box)


def _sections(path: Path, data: bytes) -> list[list[tuple[int, list[bytes]]]]:
    """Lines of each set, by their numbers."""
    sections: list[list[tuple[int, list[bytes]]]] = [[]]
    width = blank = 0
    for number, text in enumerate(lines_of(data), start=1):
        tokens = text.split()
        if text.startswith(b"#"):
            struck = text.lstrip(b"#").split()
            if struck and len(struck) == width and all(NUMBER.fullmatch(token) for token in struck):
                raise FormatError(path, "a point behind a '#': remove one or the other", number)
            sections.append([])
        elif not text:
            blank = number
        else:
            if blank and sections[-1]:
                raise FormatError(path, "a blank line between points: remove it", blank)
            sections[-1].append((number, tokens))
            width = len(tokens)
        blank = 0 if text else blank
    return [section for section in sections if section]


def _box(path: Path, rows: list[tuple[int, list[float]]]) -> Box:
    if len(rows) < 3:
        raise FormatError(path, _HEAD, rows[0][0])
    (_, low), (second, high), (third, toric) = rows
    if len(low) != len(high):
        raise FormatError(
            path, f"the corners of the box have {len(low)} and {len(high)} numbers; {_HEAD}", second
        )
    if len(toric) != 1 or toric[0] not in (0, 1):
        raise FormatError(path, _HEAD, third)
    sides = tuple(b - a for a, b in zip(low, high, strict=True))
    if not all(0 < side < np.inf for side in sides):
        raise FormatError(path, "the upper corner of the box must lie above the lower on every axis", second)
    return Box(tuple(low), sides, (toric[0] == 1,) * len(low))


def _write(x: PointSets) -> bytes:
    d = x.sets[0].shape[1]
    if x.sides is not None and x.toroidal is None:
        raise InputError(
            "an .edat says whether its box is toric, which is not known here: give the sides by --period "
            "for a torus"
        )
    low, sides = x.low or (0.0,) * d, x.sides or (1.0,) * d
    corners = [repr(v) for v in low], [repr(a + b) for a, b in zip(low, sides, strict=True)]
    head = "".join("\t".join(corner) + "\n" for corner in corners) + f"{int(x.toroidal is not False)}\n"
    return "#\n".join(
        head + "".join("\t".join(map(repr, row)) + "\n" for row in s.tolist()) for s in in_own_unit(x)
    ).encode()


EDAT = Format("UTK's .edat", (".edat",), _recognises, _read, {".edat": _write}, keeps_box=True)
