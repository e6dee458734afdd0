"""Tiles: points laid side by side, as many times along each axis as wanted, on one larger torus."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, wrap


def repeated(x: FloatArray, counts: Sequence[int]) -> FloatArray:
    """Lay a tile side by side, and take the whole as the new unit torus.

    Parameters
    ----------
    x : (..., n, d) float64
        Points of the tile.
    counts : (d,) sequence of int
        Tiles along each axis.

    Returns
    -------
    (..., n * product of counts, d) float64
        All points of one tile, then all of the next; the last axis moves fastest.

    Raises
    ------
    InputError
        If counts are not d whole numbers of at least 1.

    Notes
    -----
    The spectrum is that of the tile at the frequencies that are multiples of ``counts``, times their
    product, and 0 at all others: neighbouring copies of a point stand on a lattice.
    """
    d = x.shape[-1]
    check_counts(counts, d)
    tiles = np.stack(np.meshgrid(*(np.arange(c) for c in counts), indexing="ij"), axis=-1).reshape(-1, d)
    laid = (x[..., None, :, :] + tiles[:, None, :]) / np.array(counts)
    return wrap(laid.reshape(*x.shape[:-2], -1, d))


def check_counts(counts: Sequence[int], d: int) -> tuple[int, ...]:
    """Check counts of tiles.

    Parameters
    ----------
    counts : sequence of int
        Tiles along each axis.
    d : int
        Axes.

    Returns
    -------
    tuple of d int

    Raises
    ------
    InputError
        If they are not d whole numbers of at least 1.
    """
    whole = np.ndim(counts) == 1 and all(isinstance(c, (int, np.integer)) and c >= 1 for c in counts)
    if not whole or len(counts) != d:
        raise InputError(f"repeat must be {d} whole numbers of at least 1, one for each axis; got {counts!r}")
    return tuple(int(c) for c in counts)
