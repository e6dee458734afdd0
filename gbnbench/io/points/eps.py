"""Point sets in the EPS files of PSA: a preamble, a line ``x y p`` for each point, and grestore.

After the files and the source of PSA v1.1 (Schlömer & Heck). PSA itself skips every line that it cannot read;
here such a line is an error, so that a damaged file never gives a smaller set.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points.number_parser import NUMBER, shown
from gbnbench.io.points.text import outside_text

_SETUP = frozenset(b"def bind gsave save scale translate newpath setgray setrgbcolor setlinewidth".split())
_ENDING = frozenset(b"grestore restore showpage stroke fill end \x04".split())


def read_eps(path: Path, data: bytes) -> list[FloatArray]:
    """Read the one 2D set of a PSA .eps file.

    Parameters
    ----------
    path : Path
        Named in errors.
    data : bytes
        The whole file.

    Returns
    -------
    list of one (n, 2) float64
        In [0, 1).

    Raises
    ------
    FormatError
        If a line is neither preamble, point nor ending, or the gsave is never undone (a truncated file).
    """
    points: list[tuple[float, float]] = []
    opened = ended = False
    number = 0
    for number, line in enumerate(data.removeprefix(b"\xef\xbb\xbf").splitlines(), start=1):
        tokens = line.split()
        if not tokens or (tokens[0].startswith(b"%") and tokens[-1] != b"p"):
            continue
        if tokens[-1] == b"p" and not ended:
            points.append(_point(path, tokens, number))
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
    found = np.array(points)
    found[found == 1] = 0
    return [found]


def _point(path: Path, tokens: list[bytes], number: int) -> tuple[float, float]:
    if len(tokens) != 3:
        raise FormatError(path, f"a point is 'x y p'; got {shown(b' '.join(tokens))}", number)
    for token in tokens[:2]:
        if not NUMBER.fullmatch(token):
            raise FormatError(path, f"{shown(token)} is not a number", number)
        if not 0 <= float(token) <= 1:
            raise FormatError(path, outside_text(float(token)), number)
    return float(tokens[0]), float(tokens[1])
