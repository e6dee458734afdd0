"""Point sets in the EPS files of PSA: a preamble, a line ``x y p`` for each point, and grestore.

After the files and the source of PSA v1.1 (Schlömer & Heck). PSA itself skips every line that it cannot read;
here such a line is an error, so that a damaged file never gives a smaller set.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.io.points.file_format import LEGIBLE
from gbnbench.io.points.formats.format import Format
from gbnbench.io.points.literals import NUMBER, shown
from gbnbench.io.points.point_file import PointFile
from gbnbench.io.points.point_sets import Coordinates, FileContent

_SETUP = frozenset(b"def bind gsave save scale translate newpath setgray setrgbcolor setlinewidth".split())
_ENDING = frozenset(b"grestore restore showpage stroke fill end \x04".split())


def _recognises(file: PointFile) -> bool:
    named = file.suffix == ".eps" and not file.head.translate(None, LEGIBLE)
    return named or file.head.startswith((b"%!", b"\xef\xbb\xbf%!"))


def _read(file: PointFile) -> FileContent:
    """Read the one 2D set; a line that is no preamble, point or ending is refused, and a gsave left open."""
    path, data = file.path, file.read()
    points: list[tuple[float, float]] = []
    lines: list[int] = []
    opened = ended = False
    number = 0
    for number, line in enumerate(data.removeprefix(b"\xef\xbb\xbf").splitlines(), start=1):
        tokens = line.split()
        if not tokens or (tokens[0].startswith(b"%") and tokens[-1] != b"p"):
            continue
        if tokens[-1] == b"p" and not ended:
            points.append(_point(path, tokens, number))
            lines.append(number)
        elif not points and not ended and (tokens[0].startswith(b"/") or tokens[-1] in _SETUP):
            opened |= b"gsave" in tokens
        elif points and all(token in _ENDING for token in tokens):
            ended = True
        else:
            said = f"{shown(line.strip())} is no line of a PSA .eps file ('x y p' for each point)"
            raise FormatError(path, said, number)
    if not points:
        raise FormatError(path, "no lines 'x y p': of EPS files only those that PSA writes hold points")
    if opened and not ended:
        raise FormatError(path, "the file is truncated: no grestore closes the points", number)
    return FileContent([Coordinates(np.array(points), np.array(lines))])


def _point(path: Path, tokens: list[bytes], number: int) -> tuple[float, float]:
    if len(tokens) != 3:
        raise FormatError(path, f"a point is 'x y p'; got {shown(b' '.join(tokens))}", number)
    for token in tokens[:2]:
        if not NUMBER.fullmatch(token):
            raise FormatError(path, f"{shown(token)} is not a number", number)
    return float(tokens[0]), float(tokens[1])


EPS = Format("PSA's .eps", (".eps",), _recognises, _read)
