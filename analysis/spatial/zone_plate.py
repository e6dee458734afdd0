"""Zone plate sampled at the points and resampled to pixels (row 4 of Ahmed, Ren & Wonka 2022, Fig. 8)."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike
from scipy.sparse import csr_array

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import FloatArray, as_realizations

POINTS_PER_PIXEL = 4
# Local frequency of the pattern at the far end of each side, as nu = |f| spacing: 60^2/512 turns of the usual
# picture, sin((60/512 r)^2) with r in pixels, 512 pixels and two points a pixel along each axis.
EDGE_NU = (60 / 512) ** 2 * 512 * 0.5 / math.pi
FILTER_SIGMA = 0.6  # pixels
FILTER_RADIUS = 2  # pixels; the Gaussian has fallen to 1/250
CHUNK = 1 << 22  # samples taken at once


def zone_plate(x: ArrayLike, pixels: int = 512) -> FloatArray:
    """Picture of a chirp whose local frequency grows from 0 at the origin to nu = 1.12 along each side.

    Parameters
    ----------
    x : (n, 2) or (realizations, n, 2) float64
        Points on the unit torus; of several sets the first is drawn.
    pixels : int
        Side of the picture.

    Returns
    -------
    (pixels, pixels) float64
        In [0, 1]; column is x, row is y, row 0 at y = 0. A pixel that no sample reaches is 1/2.

    Raises
    ------
    RefusalError
        If d is not 2.
    InputError
        If pixels < 1.

    Notes
    -----
    The torus is repeated as a tile of s = max(1, round(sqrt(n)/2)) pixels, so that about four points fall in
    a pixel whatever n is, and (1 + sin(pi 1.12 r^2 / (L h)))/2 is sampled at every point, L being the side of
    the picture and h = s/sqrt(n) the spacing of points. Each pixel is the mean of the samples around its
    centre, weighted by a Gaussian of sigma 0.6 pixels cut to a square of +-2 pixels.

    Aliasing shows the spectrum: the fringes around the origin carry the noise of low frequencies, which a
    good blue noise does not have, and the grey beyond them the noise that P(nu) folds back.
    """
    points = as_realizations(x)[0]
    n, d = points.shape
    if d != 2:
        raise RefusalError(f"the zone plate is a picture of the plane; got d={d}")
    if pixels < 1:
        raise InputError(f"pixels must be at least 1; got {pixels}")
    side = max(1, round(math.sqrt(n) / POINTS_PER_PIXEL**0.5))
    tiles = math.ceil(pixels / side)
    turns = EDGE_NU / (pixels * side / math.sqrt(n))
    ring = 1 + FILTER_RADIUS // side  # tiles around the picture from which samples reach into it
    weighted, weight = np.zeros((side * side, tiles, tiles)), np.zeros((side * side, 1, 1))
    chunk = max(1, CHUNK // max(64, (tiles + 2 * ring) ** 2))
    for start in range(0, n, chunk):
        local = points[start : start + chunk] * side
        _splat(local, _samples(local, side, tiles, ring, turns), weighted, weight)
    mean = np.full_like(weighted, 0.5)
    np.divide(weighted, weight, out=mean, where=weight > 0)
    picture = mean.reshape(side, side, tiles, tiles).transpose(2, 0, 3, 1).reshape(tiles * side, tiles * side)
    return np.clip(picture[:pixels, :pixels], 0.0, 1.0)


def _samples(local: FloatArray, side: int, tiles: int, ring: int, turns: float) -> FloatArray:
    """Pattern at the points of every tile: (n, tiles + 2 ring, tiles + 2 ring), rows of tiles first."""
    corner = np.arange(-ring, tiles + ring) * float(side)
    square: FloatArray = (local[:, :, None] + corner) ** 2
    phase: FloatArray = square[:, 1, :, None] + square[:, 0, None, :]
    phase *= math.pi * turns
    np.sin(phase, out=phase)
    phase += 1
    phase *= 0.5
    return phase


def _splat(local: FloatArray, samples: FloatArray, weighted: FloatArray, weight: FloatArray) -> None:
    """Add samples and their weights to the pixels around them.

    All tiles have the same points, so the weights from points to the pixels of one tile serve them all: one
    sparse product for each neighbouring tile that a filter can reach from.
    """
    side, tiles = math.isqrt(len(weighted)), weighted.shape[1]
    ring = (samples.shape[1] - tiles) // 2
    taps = np.arange(-FILTER_RADIUS - 1, FILTER_RADIUS + 1)
    pixel = np.floor(local + 0.5).astype(np.intp)[:, :, None] + taps  # those whose centre may be in reach
    distance = pixel + 0.5 - local[:, :, None]
    along = np.exp(-(distance**2) / (2 * FILTER_SIGMA**2))
    along[np.abs(distance) > FILTER_RADIUS] = 0.0
    tile, pixel = np.divmod(pixel, side)
    both = along[:, 1, :, None] * along[:, 0, None, :]
    target = pixel[:, 1, :, None] * side + pixel[:, 0, None, :]
    owner = np.broadcast_to(np.arange(len(local))[:, None, None], both.shape)
    for up in np.unique(tile[:, 1]):
        for right in np.unique(tile[:, 0]):
            use = (tile[:, 1, :, None] == up) & (tile[:, 0, None, :] == right) & (both > 0)
            senders, column = np.unique(owner[use], return_inverse=True)
            if not len(senders):
                continue
            weights = csr_array((both[use], (target[use], column)), shape=(side * side, len(senders)))
            rows = slice(ring - up, ring - up + tiles)
            columns = slice(ring - right, ring - right + tiles)
            sent = samples[senders, rows, columns].reshape(len(senders), -1)
            weighted += (weights @ sent).reshape(weighted.shape)
            weight += weights.sum(axis=1).reshape(weight.shape)
