"""Dots in a terminal: eight to a sign of Braille."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from gbnbench.api.stippling import Stippling

COLUMNS = 76
BLANK = 0x2800
BITS = np.array([[0, 3], [1, 4], [2, 5], [6, 7]])  # of a sign's dots, rows first


def braille(drawn: Iterable[Stippling]) -> str:
    """Show the points of stipplings as Braille.

    Parameters
    ----------
    drawn : iterable of Stippling
        In two dimensions, of one size.

    Returns
    -------
    str
        Lines of 76 signs.
    """
    sets = list(drawn)
    width, height = sets[0].size
    cell = width / (2 * COLUMNS)
    signs = np.zeros((max(1, -(-int(np.ceil(height / cell)) // 4)), COLUMNS), np.int64)
    for made in sets:
        x, y = np.floor(made.pixels / cell).astype(int).T
        np.bitwise_or.at(signs, (y // 4, x // 2), 1 << BITS[y % 4, x % 2])
    return "\n".join("".join(chr(BLANK + sign) for sign in row) for row in signs.tolist())
