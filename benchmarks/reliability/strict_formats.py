"""Strict readings of formats in words and numbers, in plain Python, sharing no code with our readers.

That of .eps judges any file; those of .json, .ply, .xyz, dumps of LAMMPS and .edat judge what our own writers
and the usual programs write, and leave the rest undecided.
"""

from __future__ import annotations

import json
import math
import re
import struct
from typing import Any

from gbnbench.benchmarks.reliability.strict_words import (
    DECIMAL,
    NoPointsError,
    Sets,
    UndecidedError,
    known,
    need,
    read_point,
)

Points = list[tuple[float, ...]]
BELOW = math.nextafter(1, 0)


def strict_eps(data: bytes) -> Sets:
    """Every line of the body is a point; the frame around it is that of PSA's own files."""
    lines = [line.strip(" \t\v\f") for line in re.split("\r\n|\r|\n", data.decode("latin-1"))]
    body = [line for line in lines if re.search(r"(^|\s)p$", line, re.ASCII)]
    points = []
    for line in body:
        match = re.fullmatch(rf"({DECIMAL})\s+({DECIMAL})\s+p", line, re.ASCII)
        if match is None:
            raise NoPointsError
        points.append(read_point([match[1], match[4]], 2))
    need(points)
    start, stop = lines.index(body[0]), len(lines) - lines[::-1].index(body[-1])
    need(all(line in body or not line or line[0] == "%" for line in lines[start:stop]))
    setup = r"%.*|/.*|(.*\s)?(def|bind|gsave|save|scale|translate|newpath|set(gray|rgbcolor|linewidth))|"
    need(all(re.fullmatch(setup, line, re.DOTALL | re.ASCII) for line in lines[:start]))
    need(
        all(
            re.fullmatch(r"%.*|((grestore|restore|showpage|stroke|fill|end)(\s+|$))*", line, re.ASCII)
            for line in lines[stop:]
        )
    )
    closed = any(line and line[0] != "%" for line in lines[stop:])
    opened = any("gsave" in line.split() for line in lines[:start] if line[:1] != "%")
    need(closed or not opened)
    return [points]


def _boxed(rows: list[list[float]], low: list[float], sides: list[float], edge: float) -> Points:
    """Fractions of a box; its upper end becomes ``edge``."""
    need(all(len(row) == len(sides) for row in rows))
    points = [[(v - a) / s for v, a, s in zip(row, low, sides, strict=True)] for row in rows]
    need(points and all(0 <= v <= 1 for row in points for v in row))
    return [tuple(edge if v == 1 else v for v in row) for row in points]


def _not_flat(rows: list[list[float]]) -> None:
    need(not (len(rows) > 1 and len(rows[0]) == 3 and len({row[2] for row in rows}) == 1))


def _matched(pattern: str | re.Pattern[str], text: str) -> re.Match[str]:
    """Match the whole text, or leave the file undecided."""
    match = re.fullmatch(pattern, text)
    if match is None:
        raise UndecidedError
    return match


def _numbers(tokens: list[str]) -> list[float]:
    need(all(re.fullmatch(DECIMAL, token, re.ASCII) for token in tokens))
    return [float(token) for token in tokens]


def _text_of(data: bytes) -> list[str]:
    known(data.isascii() and not set(data) & set(b"\r\v\f\0\x1c\x1d\x1e"))
    return data.decode().rstrip().split("\n")


def strict_ply(data: bytes) -> Sets:
    """Read vertices of x, y and z alone, in text or binary."""
    head, end, body = data.partition(b"\nend_header\n")
    known(end)
    lines = _text_of(head)
    known(len(lines) > 3)
    known(lines[0] == "ply")
    order = _matched(r"format (\w+) 1\.0", lines[1])[1]
    count = int(_matched(r"element vertex (\d{1,9})", lines[2])[1])
    properties = [_matched(r"property (float|double) ([xyz])", line) for line in lines[3:]]
    names = "".join(p[2] for p in properties)
    known(names in ("x", "xy", "xyz") and order in ("ascii", "binary_little_endian", "binary_big_endian"))
    need(count > 0)
    if order == "ascii":
        known(body.isascii() and not set(body) & set(b"\r\v\f\0\x1c\x1d\x1e"))
        text = body.decode().rstrip().split("\n")
        need(len(text) == count and all(len(row.split()) == len(names) for row in text))
        rows = [_numbers(row.split()) for row in text]
    else:
        form = (">" if "big" in order else "<") + "".join("fd"[p[1] == "double"] for p in properties)
        need(len(body) == count * struct.calcsize(form))
        rows = [list(row) for row in struct.iter_unpack(form, body)]
    _not_flat(rows)
    return [_boxed(rows, [0.0] * len(names), [1.0] * len(names), 0.0)]


_LATTICE = re.compile(
    r'Lattice="([^\s"]+) 0\.0 0\.0 0\.0 ([^\s"]+) 0\.0 0\.0 0\.0 ([^\s"]+)" '
    r'Origin="([^\s"]+) ([^\s"]+) ([^\s"]+)" '
    r'Properties=species:S:1:pos:R:3 pbc="([TF]) ([TF]) ([TF])"'
)


def strict_xyz(data: bytes) -> Sets:
    """Read counts, a comment that is empty or tells the cell as we write it, and rows ``symbol x y z``."""
    lines = _text_of(data)
    sets: Sets = []
    first = None
    while lines:
        known(len(lines) > 2 and re.fullmatch(r"\d+", lines[0]))
        n, comment, rows = int(lines[0]), lines[1], lines[2 : 2 + int(lines[0])]
        need(0 < n == len(rows))
        low, sides, flags = [0.0] * 3, [1.0] * 3, "T"
        if comment:
            told = _matched(_LATTICE, comment).groups()
            sides, low, flags = _numbers([*told[:3]]), _numbers([*told[3:6]]), "".join(told[6:])
            need(all(0 < side < math.inf for side in sides))
        need(first in (None, (comment != "", low, sides, flags)))
        first = comment != "", low, sides, flags
        known(all(re.fullmatch(r"[A-Z]( \S+){3}", row) for row in rows))
        points = [_numbers(row.split()[1:]) for row in rows]
        _not_flat(points)
        sets.append(_boxed(points, low, sides, 0.0 if "F" not in flags else BELOW))
        lines = lines[2 + n :]
    return sets


def strict_lammps(data: bytes) -> Sets:
    """Read timesteps of six items in LAMMPS's own order, with columns id, type, x, y and z."""
    lines = _text_of(data)
    sets: Sets = []
    first = None
    while lines:
        known(len(lines) > 9 and lines[0] == "ITEM: TIMESTEP" and lines[2] == "ITEM: NUMBER OF ATOMS")
        border = _matched(r"ITEM: BOX BOUNDS (pp pp pp|ff ff ff)", lines[4])[1]
        d = len(_matched(r"ITEM: ATOMS id type( x( y( z)?)?)", lines[8])[1].split())
        n = int(_matched(r"\d{1,9}", lines[3])[0])
        ends = [_numbers(line.split()) for line in lines[5:8]]
        need(n > 0 and all(len(pair) == 2 and 0 < pair[1] - pair[0] < math.inf for pair in ends))
        low, sides = [pair[0] for pair in ends[:d]], [pair[1] - pair[0] for pair in ends[:d]]
        need(first in (None, (low, sides, border)))
        first = low, sides, border
        rows = [line.split() for line in lines[9 : 9 + n]]
        need(len(rows) == n and all(len(row) == d + 2 for row in rows))
        points = [_numbers(row[2:]) for row in rows]
        _not_flat(points)
        sets.append(_boxed(points, low, sides, 0.0 if border == "pp pp pp" else BELOW))
        lines = lines[9 + n :]
    return sets


def strict_edat(data: bytes) -> Sets:
    """Read sets parted by lines of ``#``, each with the three lines of its box."""
    lines = _text_of(data)
    known(all(line.strip() for line in lines))
    sets: Sets = []
    first = None
    for section in "\n".join(lines).split("\n#\n"):
        known("#" not in section)
        rows = [_numbers(line.split()) for line in section.split("\n")]
        known(len(rows) > 3 and len(rows[2]) == 1)
        low, high, (toric,) = rows[:3]
        need(len(low) == len(high) and toric in (0, 1))
        sides = [b - a for a, b in zip(low, high, strict=True)]
        need(all(0 < side < math.inf for side in sides) and first in (None, (low, high, toric)))
        first = low, high, toric
        sets.append(_boxed(rows[3:], low, sides, 0.0 if toric else BELOW))
    return sets


def strict_json(data: bytes) -> Sets:
    """Read a list of points or of such lists, or an object that has them as ``points`` beside their box."""

    def refuse(_: str) -> None:
        raise NoPointsError

    try:
        content = json.loads(data.decode("utf-8-sig"), parse_constant=refuse)
    except (ValueError, RecursionError):
        raise NoPointsError from None
    about: dict[str, Any] = {}
    if isinstance(content, dict):
        known({*content} <= {"low", "sides", "toroidal", "points"} and data.count(b'"') == 2 * len(content))
        need("points" in content)
        about, content = content, content["points"]
    need(isinstance(content, list) and content)
    several = all(isinstance(part, list) and part and isinstance(part[0], list) for part in content)
    sets = content if several else [content]
    need(all(isinstance(row, list) and row for one in sets for row in one))
    d = len(sets[0][0])
    known(isinstance(about.get("sides", []), list) and isinstance(about.get("low", []), list))
    low, sides = [*about.get("low", [0.0] * d)], [*about.get("sides", [1.0] * d)]
    known("low" not in about or "sides" in about)
    every = [low, sides, *(row for one in sets for row in one)]
    need(all(len(row) == d and all(type(v) in (int, float) for v in row) for row in every))
    need(all(abs(v) < 1e308 for row in every for v in row) and all(side > 0 for side in sides))
    known(about.get("toroidal") in (None, True, False) and type(about.get("toroidal")) is not int)
    edge = 0.0 if about.get("toroidal") is True or "sides" not in about else BELOW
    return [_boxed([[float(v) for v in row] for row in one], low, sides, edge) for one in sets]
