"""Starts along a Hilbert curve: equal shares of the density, so that low frequencies are right at once."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density

JITTER = 2.0  # shares
LARGE = 1 << 20  # pixels of an image whose curve goes through blocks of them
FINE = 0.25  # side of these in mean spacings, at most


def hilbert_start(density: Density, n: int, rng: np.random.Generator) -> FloatArray:
    """Draw points in proportion to a density, about one from each of n equal shares along a Hilbert curve.

    Parameters
    ----------
    density : Density
        The density.
    n : int
        Points.
    rng : numpy.random.Generator
        The stream that they are drawn from.

    Returns
    -------
    (n, d) float64
        In pixels, all where the density is above 0.

    Notes
    -----
    Each point is drawn from two shares' length around its own, and the shares begin anywhere along the curve:
    on a constant density one point from each share would lie in one cell of a grid each, which a set
    remembers to the end (at n = 1,024 its peak is 3.9 in place of 1.9).
    """
    side = _block_side(density, n)
    masses = _blocks(density.values, side).sum(axis=-1) if side > 1 else density.values
    places = np.argwhere(masses > 0)
    order = np.argsort(hilbert_index(places), kind="stable")
    places = places[order]
    share = np.cumsum(masses[tuple(places.T)])
    drawn = (rng.random() + (np.arange(n) + JITTER * rng.random(n)) / n) % 1 * share[-1]
    pixel = np.minimum(np.searchsorted(share, drawn, side="right"), len(places) - 1)
    inside = np.minimum(rng.random((n, density.d)), np.nextafter(1, 0))
    start: FloatArray = places[pixel].astype(np.float64)
    if side > 1:
        part = 1 - np.clip((share[pixel] - drawn) / masses[tuple(places[pixel].T)], 0, 1)
        start = start * side + _pixels_within(density, places[pixel], side, part)
    return start + inside


def _block_side(density: Density, n: int) -> int:
    """Side of the blocks that stand for the pixels of large images: at most a quarter of a spacing."""
    if density.values.size <= LARGE:
        return 1
    spacing = (density.values.size / n) ** (1 / density.d)
    return 1 << max(0, int(spacing * FINE).bit_length() - 1)


def _blocks(values: FloatArray, side: int) -> FloatArray:
    """Lay out pixels block by block: the last axis has those of a block, with zeros beyond the borders."""
    padded = np.pad(values, [(0, -size % side) for size in values.shape])
    cut = padded.reshape([part for size in padded.shape for part in (size // side, side)])
    d = values.ndim
    return cut.transpose(*range(0, 2 * d, 2), *range(1, 2 * d, 2)).reshape(*cut.shape[::2], side**d)


def _pixels_within(
    density: Density, block: NDArray[np.intp], side: int, part: FloatArray
) -> NDArray[np.intp]:
    """Choose a pixel of a block each: where its mass, in the order of rows, reaches a part of the whole."""
    d = density.d
    within = np.stack(np.unravel_index(np.arange(side**d), (side,) * d), axis=1)
    at = block[:, None] * side + within
    there = (at < density.shape).all(axis=2)
    values = density.values[tuple(np.minimum(at, np.array(density.shape) - 1).T)].T * there
    reached = np.cumsum(values, axis=1)
    last = side**d - 1 - np.argmax(values[:, ::-1] > 0, axis=1)
    index = np.minimum((reached <= (part * reached[:, -1])[:, None]).sum(axis=1), last)
    chosen: NDArray[np.intp] = within[index]
    return chosen


def hilbert_index(places: NDArray[np.intp]) -> NDArray[np.int64]:
    """Give cells their numbers along a Hilbert curve.

    Parameters
    ----------
    places : (m, d) int
        Cells, at least 0.

    Returns
    -------
    (m,) int64
        Position along the curve through the cube of 2^b cells a side that holds them all.

    References
    ----------
    J. Skilling, *Programming the Hilbert curve*, AIP Conf. Proc. 707, 2004.
    """
    x = [places[:, a].astype(np.int64) for a in range(places.shape[1])]
    d, bits = len(x), max(1, int(places.max()).bit_length())
    q = 1 << (bits - 1)
    while q > 1:
        low = q - 1
        for a in range(d):
            inverted = (x[a] & q) > 0
            exchanged = np.where(inverted, 0, (x[0] ^ x[a]) & low)
            x[0] = np.where(inverted, x[0] ^ low, x[0] ^ exchanged)
            if a:
                x[a] = x[a] ^ exchanged
        q >>= 1
    for a in range(1, d):
        x[a] ^= x[a - 1]
    turned = np.zeros_like(x[0])
    q = 1 << (bits - 1)
    while q > 1:
        turned = np.where(x[d - 1] & q, turned ^ (q - 1), turned)
        q >>= 1
    index = np.zeros_like(x[0])
    for b in range(bits - 1, -1, -1):
        for a in range(d):
            index = index << 1 | ((x[a] ^ turned) >> b & 1)
    return index
