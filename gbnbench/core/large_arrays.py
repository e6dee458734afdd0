"""Large arrays put together from parts: beyond a size they lie in a nameless file, which the system pages."""

from __future__ import annotations

import math
import tempfile
from collections.abc import Iterable

import numpy as np

from gbnbench.core.torus import FloatArray

IN_MEMORY = 1 << 28  # bytes up to which an array lies in memory


class RowFiller:
    """An array that is filled with parts, one after another along its first axis.

    Parameters
    ----------
    shape : tuple of int
        Of the whole.
    """

    def __init__(self, shape: tuple[int, ...]) -> None:
        self._whole, self._row = empty_array(shape), 0

    def add(self, part: FloatArray) -> None:
        """Copy the next rows."""
        self._whole[self._row : self._row + len(part)] = part
        self._row += len(part)

    def whole(self) -> FloatArray:
        """Return the array; raises ValueError while rows are missing."""
        if self._row != len(self._whole):
            raise ValueError(f"{self._row} rows were given for {len(self._whole)}")
        return self._whole


def filled(shape: tuple[int, ...], parts: Iterable[FloatArray]) -> FloatArray:
    """Fill an array with parts; each is let go before the next is looked at.

    Parameters
    ----------
    shape : tuple of int
        Of the whole.
    parts : iterable of float64
        Each of some rows, together all of them.

    Returns
    -------
    float64
        As ``numpy.concatenate`` gives it.

    Raises
    ------
    ValueError
        If the parts are not of this shape together.

    Examples
    --------
    >>> filled((3, 2), [np.zeros((1, 2)), np.ones((2, 2))]).tolist()
    [[0.0, 0.0], [1.0, 1.0], [1.0, 1.0]]
    """
    filler = RowFiller(shape)
    for part in parts:
        filler.add(part)
    return filler.whole()


def empty_array(shape: tuple[int, ...]) -> FloatArray:
    """Make an array without values; beyond the size it lies in a file that nobody sees.

    Parameters
    ----------
    shape : tuple of int
        Its shape.

    Returns
    -------
    float64
    """
    if 8 * math.prod(shape) <= IN_MEMORY:
        return np.empty(shape)
    with tempfile.TemporaryFile(prefix="gbnbench-") as file:  # the mapping keeps it
        return np.memmap(file, dtype=np.float64, mode="w+", shape=shape)
