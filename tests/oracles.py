"""Slow twins in plain numpy, sharing no code with the package, that the tests measure it against."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def direct_power(x: ArrayLike, frequencies: ArrayLike) -> NDArray[np.float64]:
    """|sum_k exp(-2 pi i f.x_k)|**2 / n by the definition, in long double: (n, d), (m, d) -> (m,)."""
    points = np.asarray(x, dtype=np.longdouble)
    turn = 8 * np.arctan(np.longdouble(1))
    power = []
    for f in np.asarray(frequencies):
        turns = points @ f.astype(np.longdouble)
        phase = turn * (turns - np.rint(turns))
        power.append((np.cos(phase).sum() ** 2 + np.sin(phase).sum() ** 2) / len(points))
    return np.array(power, dtype=np.float64)


def half_space(fmax: int, d: int) -> NDArray[np.int64]:
    """One of each pair f, -f of nonzero integer vectors with |f_a| <= fmax: (m, d)."""
    cube = np.indices((2 * fmax + 1,) * d).reshape(d, -1).T - fmax
    return cube[len(cube) // 2 + 1 :]


def nearest_by_tiling(x: ArrayLike, probes: ArrayLike) -> tuple[NDArray[np.intp], NDArray[np.float64]]:
    """Nearest point on the torus to each probe, and its image's place, over all 3**d tiles: (p,), (p, d)."""
    points, at = np.asarray(x, dtype=float), np.asarray(probes, dtype=float)
    n, d = points.shape
    tiles = np.indices((3,) * d).reshape(d, -1).T - 1.0
    images = (points[None] + tiles[:, None]).reshape(-1, d)
    owner, place = np.empty(len(at), dtype=np.intp), np.empty_like(at)
    for start in range(0, len(at), 2000):
        block = slice(start, start + 2000)
        squares = sum((at[block, a, None] - images[None, :, a]) ** 2 for a in range(d))
        best = np.argmin(squares, axis=1)
        owner[block], place[block] = best % n, images[best]
    return owner, place
