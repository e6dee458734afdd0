"""Zone plate sampled at the points and resampled to pixels (row 4 of Ahmed, Ren & Wonka 2022, Fig. 8)."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csr_array

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.sides import Sides, as_sides
from gbnbench.core.torus import FloatArray, as_realizations

POINTS_PER_PIXEL = 4
# Local frequency of the pattern at the far end of each side, as nu = |f| spacing: 60^2/512 turns of the usual
# picture, sin((60/512 r)^2) with r in pixels, 512 pixels and two points a pixel along each axis.
EDGE_NU = (60 / 512) ** 2 * 512 * 0.5 / math.pi
FILTER_SIGMA = 0.6  # pixels
FILTER_RADIUS = 2  # pixels; the Gaussian has fallen to 1/250
CHUNK = 1 << 22  # samples taken at once
SCALES = 0.15  # share by which the tile of a rectangle may be larger or smaller to have the right ratio


def zone_plate(x: ArrayLike, pixels: int = 512, sides: ArrayLike | None = None) -> FloatArray:
    """Picture of a chirp whose local frequency grows from 0 at the origin to nu = 1.12 along each side.

    Parameters
    ----------
    x : (n, 2) or (realizations, n, 2) float64
        Points on the unit torus; of several sets the first is drawn.
    pixels : int
        Side of the picture.
    sides : (2,) array_like, optional
        Lengths of the torus's sides, whose ratio counts; a square if not given.

    Returns
    -------
    (pixels, pixels) float64
        In [0, 1]; column is x, row is y, row 0 at y = 0. A pixel that no sample reaches is 1/2.

    Raises
    ------
    RefusalError
        If d is not 2.
    InputError
        If pixels < 1, or sides are not two lengths.

    Notes
    -----
    The torus is repeated as a tile of s = max(1, round(sqrt(n)/2)) pixels, so that about four points fall in
    a pixel whatever n is, and (1 + sin(pi 1.12 r^2 / (L h)))/2 is sampled at every point, L being the side of
    the picture and h = s/sqrt(n) the spacing of points. The tile of a rectangle is s_x by s_y pixels of about
    the same area, those whose ratio is nearest to that of the sides, and h = sqrt(s_x s_y / n). Each pixel is
    the mean of the samples around its centre, weighted by a Gaussian of sigma 0.6 pixels cut to a square of
    +-2 pixels.

    Aliasing shows the spectrum: the fringes around the origin carry the noise of low frequencies, which a
    good blue noise does not have, and the grey beyond them the noise that P(nu) folds back.
    """
    points = as_realizations(x)[0]
    n, d = points.shape
    if d != 2:
        raise RefusalError(f"the zone plate is a picture of the plane; got d={d}")
    if pixels < 1:
        raise InputError(f"pixels must be at least 1; got {pixels}")
    tile = _tile(n, as_sides(sides, d))
    tiles = _Pair(*(math.ceil(pixels / side) for side in tile))
    turns = EDGE_NU / (pixels * math.sqrt(tile.x * tile.y) / math.sqrt(n))
    # Tiles around the picture from which samples reach into it.
    ring = _Pair(*(1 + FILTER_RADIUS // side for side in tile))
    weighted, weight = np.zeros((tile.y * tile.x, tiles.y, tiles.x)), np.zeros((tile.y * tile.x, 1, 1))
    chunk = max(1, CHUNK // max(64, (tiles.x + 2 * ring.x) * (tiles.y + 2 * ring.y)))
    for start in range(0, n, chunk):
        local = points[start : start + chunk] * tile
        _splat(local, _samples(local, tile, tiles, ring, turns), tile, ring, weighted, weight)
    mean = np.full_like(weighted, 0.5)
    np.divide(weighted, weight, out=mean, where=weight > 0)
    rows = mean.reshape(tile.y, tile.x, tiles.y, tiles.x).transpose(2, 0, 3, 1)
    picture = rows.reshape(tiles.y * tile.y, tiles.x * tile.x)
    return np.clip(picture[:pixels, :pixels], 0.0, 1.0)


class _Pair(NamedTuple):
    """Whole numbers along x and along y."""

    x: int
    y: int


def _tile(n: int, sides: Sides | None) -> _Pair:
    """Pixels of one torus: a square of about n/4, or the rectangle near that whose ratio is nearest."""
    side = math.sqrt(n) / POINTS_PER_PIXEL**0.5
    if sides is None:
        return _Pair(max(1, round(side)), max(1, round(side)))
    ratio = sides[0] / sides[1]
    widths = range(max(1, round(side * sides[0] * (1 - SCALES))), round(side * sides[0] * (1 + SCALES)) + 2)
    near = [_Pair(width, max(1, round(width / ratio))) for width in widths]
    # Of equally good ones the nearest in size.
    return min(
        near,
        key=lambda p: (round(abs(math.log(p.x / p.y / ratio)), 9), abs(math.log(p.x / (side * sides[0])))),
    )


def _samples(local: FloatArray, tile: _Pair, tiles: _Pair, ring: _Pair, turns: float) -> FloatArray:
    """Pattern at the points of every tile: (n, tiles + 2 ring along y, the same along x)."""
    square_x, square_y = (
        (local[:, axis, None] + np.arange(-ring[axis], tiles[axis] + ring[axis]) * float(tile[axis])) ** 2
        for axis in (0, 1)
    )
    phase: FloatArray = square_y[:, :, None] + square_x[:, None, :]
    phase *= math.pi * turns
    np.sin(phase, out=phase)
    phase += 1
    phase *= 0.5
    return phase


def _splat(
    local: FloatArray, samples: FloatArray, size: _Pair, ring: _Pair, weighted: FloatArray, weight: FloatArray
) -> None:
    """Add samples and their weights to the pixels around them.

    All tiles have the same points, so the weights from points to the pixels of one tile serve them all: one
    sparse product for each neighbouring tile that a filter can reach from.
    """
    _, rows_of_tiles, columns_of_tiles = weighted.shape
    taps = np.arange(-FILTER_RADIUS - 1, FILTER_RADIUS + 1)
    pixel = np.floor(local + 0.5).astype(np.intp)[:, :, None] + taps  # those whose centre may be in reach
    distance = pixel + 0.5 - local[:, :, None]
    along = np.exp(-(distance**2) / (2 * FILTER_SIGMA**2))
    along[np.abs(distance) > FILTER_RADIUS] = 0.0
    tile, pixel = np.divmod(pixel, np.array(size)[:, None])
    both = along[:, 1, :, None] * along[:, 0, None, :]
    target = pixel[:, 1, :, None] * size.x + pixel[:, 0, None, :]
    owner = np.broadcast_to(np.arange(len(local))[:, None, None], both.shape)
    for up in np.unique(tile[:, 1]):
        for right in np.unique(tile[:, 0]):
            use = (tile[:, 1, :, None] == up) & (tile[:, 0, None, :] == right) & (both > 0)
            senders, column = np.unique(owner[use], return_inverse=True)
            if not len(senders):
                continue
            weights = csr_array((both[use], (target[use], column)), shape=(len(weighted), len(senders)))
            rows = slice(ring.y - up, ring.y - up + rows_of_tiles)
            columns = slice(ring.x - right, ring.x - right + columns_of_tiles)
            sent = samples[senders, rows, columns].reshape(len(senders), -1)
            weighted += (weights @ sent).reshape(weighted.shape)
            weight += weights.sum(axis=1).reshape(weight.shape)
