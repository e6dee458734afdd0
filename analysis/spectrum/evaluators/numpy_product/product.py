"""The exact periodogram in plain numpy, for machines without an OpenCL device, as one product of two tables.

exp(-2 pi i f.x) is a product over dimensions. These are split in a leading and a trailing group; cosines and
sines of each group's half space of frequencies are tabulated for a chunk of points, and one real matrix
product gives the four sums from which F(fa, fb), F(fa, -fb) and, by Hermitian symmetry, the other two
quadrants follow: two flops a frequency and point instead of eight. Phases are exact, by integer wrap of
64-bit fractions of a turn.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, fixed_point

REALS: dict[str, type[np.floating[Any]]] = {"double": np.float64, "float": np.float32}
CHUNK = 256  # points of one product, whose sum is in the precision asked for; chunks are added in double
TABLE_BYTES = 48 << 20  # both groups' tables of a chunk, with what making them takes
BLOCK_BYTES = 8 << 20  # one product's sums before they are added up
LISTED = 1 << 19  # phases of listed frequencies at a time
WHOLE = 8  # harmonics up to which each has a sine and cosine of its own
TURN = 2.0**64
UNITS = np.array([1, -1j, -1, 1j])  # exp(-i pi q / 2)

COSINE = 7.0  # bound of a tabulated exp(-i phase): 2.4 of its angle, two units in the last place of each part
PRODUCT = math.sqrt(5)  # bound of a complex product (Brent, Percival & Zimmermann 2007)


def separable_power(
    x: FloatArray, fmax: int, precision: str = "double", weights: FloatArray | None = None
) -> FloatArray:
    """Power of one point set at every integer frequency with |f_a| <= fmax.

    Parameters
    ----------
    x : (n, d) float64
        Checked points of the unit torus.
    fmax : int
        Largest harmonic on each axis, cycles per unit length.
    precision : {"double", "float"}
        Of tables and of sums over 256 points; these are added up in double either way.
    weights : (n,) float64, optional
        A weight for each point, 1 without.

    Returns
    -------
    (2*fmax+1,)*d float64
        |sum_k w_k exp(-2 pi i f.x_k)|^2 / sum_k w_k^2, zero frequency at the centre.

    Raises
    ------
    InputError
        If precision is neither of the two.

    Notes
    -----
    Takes the memory of two cubes and some 64 MB. Errors: ``separable_errors``.

    Examples
    --------
    >>> separable_power(np.array([[0.0], [0.5]]), 2)
    array([2., 0., 2., 0., 2.])
    """
    real = _real(precision)
    d = x.shape[1]
    turns, fmaxes = _axes(fixed_point(x, 64).T, fmax)
    scaled, squares = _scaled(weights, len(x))
    leading = len(fmaxes) // 2
    a, b = (_half_count(group) for group in (fmaxes[:leading], fmaxes[leading:]))
    sums = np.zeros((2 * a, 2 * b))
    rows = 2 * max(1, BLOCK_BYTES // (4 * b * np.dtype(real).itemsize))
    product = np.empty((min(rows, 2 * a), 2 * b), real)
    for chunk in _chunks(len(x), _per_point(fmaxes, real)):
        table_a = _group_table(turns[:leading, chunk], fmaxes[:leading], real, axis=1)
        table_b = _group_table(turns[leading:, chunk], fmaxes[leading:], real, axis=0)
        if scaled is not None:
            table_a *= scaled[chunk].astype(real)
        for row in range(0, 2 * a, rows):
            block = sums[row : row + rows]
            block += np.matmul(table_a[row : row + rows], table_b.T, out=product[: len(block)])
    cube = _cube_of(sums.reshape(a, 2, 2, b), squares)
    if d == 1:
        beyond = (cube.size - 1) // 2 - fmax
        cube = cube.ravel()[beyond : cube.size - beyond]
    return cube.reshape((2 * fmax + 1,) * d)


def separable_selected(
    x: FloatArray,
    frequencies: NDArray[np.int64],
    precision: str = "double",
    weights: FloatArray | None = None,
) -> FloatArray:
    """Power of one point set at listed frequencies, one sine and cosine a point and frequency.

    Parameters
    ----------
    x : (n, d) float64
        Checked points of the unit torus.
    frequencies : (m, d) int64
        Any integers; phases wrap exactly.
    precision : {"double", "float"}
        Of sines and cosines; they are added up in double either way.
    weights : (n,) float64, optional
        A weight for each point, 1 without.

    Returns
    -------
    (m,) float64
        |sum_k w_k exp(-2 pi i f.x_k)|^2 / sum_k w_k^2.

    Raises
    ------
    InputError
        If precision is neither of the two.

    Examples
    --------
    >>> separable_selected(np.array([[0.0], [0.5]]), np.array([[2**40], [2**40 + 1]]))
    array([2., 0.])
    """
    real = _real(precision)
    turns = fixed_point(x, 64).T
    multiples = frequencies.astype(np.uint64)
    scaled, squares = _scaled(weights, len(x))
    width = min(len(x), LISTED)
    height = max(1, LISTED // width)
    amplitude = np.zeros(len(frequencies), np.complex128)
    for row in range(0, len(frequencies), height):
        block = multiples[row : row + height]
        for begin in range(0, len(x), width):
            chunk = slice(begin, begin + width)
            phase = block[:, :1] * turns[0, chunk]
            for axis in range(1, len(turns)):
                phase += block[:, axis : axis + 1] * turns[axis, chunk]
            wave = _unit(phase, real)
            if scaled is not None:
                wave *= scaled[chunk].astype(real)
            amplitude[row : row + height] += wave.sum(axis=1, dtype=np.complex128)
    power: FloatArray = (amplitude.real**2 + amplitude.imag**2) / squares
    return power


def separable_errors(
    n: int,
    d: int,
    fmax: int,
    precision: str = "double",
    x: FloatArray | None = None,
    weights: FloatArray | None = None,
    listed: bool = False,
) -> Errors:
    """Errors of the square root of what ``separable_power`` returns.

    Parameters
    ----------
    n, d, fmax : int
        Points, dimensions and the largest |f_a|.
    precision : {"double", "float"}
        As asked for.
    x : (n, d) float64, optional
        The points, so that the rounding of their coordinates is what it is, none for most sets, and not
        the worst possible.
    weights : (n,) float64, optional
        A weight for each point.
    listed : bool
        Of ``separable_selected`` instead.

    Returns
    -------
    Errors
        The bound holds for every set, coincident points included; rms is typical of scattered points.

    Raises
    ------
    InputError
        If precision is neither of the two.

    Notes
    -----
    With u the unit roundoff, to first order, each over sum |w| and then times sum |w| / sqrt(sum w^2):

    - a coordinate is rounded to 2^-64 of a turn, which moves it by at most 2^-65 if it is below 2^-12 and not
      at all from there up: 2 pi |f| times that in each dimension;
    - a tabulated exp(-i phase) is off by 7 u, two units in the last place allowed to numpy's cosine, and a
      product of k of them by sqrt(5) u (k - 1) more;
    - a sum over K points in any order is off by K u times the sum of moduli (Higham 2002, eq. 3.5), and
      |cc| + |ss| <= 1 for each point; real and imaginary part make that sqrt(2). Chunks are added in double.
      Listed frequencies are summed pairwise.

    What is typical is the root of the sum of the parts' variances, with factors measured on random sets of
    16 to 1e5 points.
    """
    u = float(np.finfo(_real(precision)).eps) / 2
    u64 = 2.0**-53
    scaled, squares = _scaled(weights, n)
    worst = (n if scaled is None else float(np.abs(scaled).sum())) / math.sqrt(squares)
    phase, phase_rms = _phase_errors(n, d, fmax, x, scaled)
    if listed:
        factors, chunk, chunks = 1, 0, 18 + math.ceil(math.log2(n)) + n // LISTED
    else:
        fmaxes = _axes(np.empty((d, 0), np.uint64), fmax)[1]
        factors = sum(1 if f <= WHOLE else 2 for f in fmaxes)
        points = _chunk_points(_per_point(fmaxes, _real(precision)))
        chunk, chunks = min(n, points), -(-n // points)
    weighing = 0 if weights is None else 2
    table = u * (COSINE * factors + PRODUCT * max(0, factors - 2) + weighing)
    sums = math.sqrt(2) * (u * chunk + u64 * (min(n, chunks) + 4))
    bound = worst * min(2.0, phase + 1.01 * (table + sums))
    typical = (
        (u * 0.5) ** 2 * (factors + 0.5 * weighing)
        + (u * 0.3) ** 2 * chunk
        + (u64 * 0.3) ** 2 * (chunks + 4)
        + phase_rms**2
    )
    return Errors(rms=min(math.sqrt(typical), bound), bound=bound)


def _real(precision: str) -> type[np.floating[Any]]:
    if precision not in REALS:
        raise InputError(f'precision must be "double" or "float"; got {precision!r}')
    return REALS[precision]


def _scaled(weights: FloatArray | None, n: int) -> tuple[FloatArray | None, float]:
    """Weights over their largest, so that nothing overflows in float, and the sum of their squares."""
    if weights is None:
        return None, float(n)
    scaled = weights / np.abs(weights).max()
    return scaled, float(scaled @ scaled)


def _axes(turns: NDArray[np.uint64], fmax: int) -> tuple[NDArray[np.uint64], list[int]]:
    """Coordinates and largest multiples of the product: in one dimension f = (2 s + 1) h + l, |l| <= s."""
    if len(turns) > 1:
        return turns, [fmax] * len(turns)
    fine, coarse = _split(fmax)
    return np.concatenate([turns * np.uint64(2 * fine + 1), turns]), [coarse, fine]


def _split(fmax: int) -> tuple[int, int]:
    """Balanced s and h such that (2 s + 1) h + s >= fmax."""
    fine = math.isqrt(fmax // 2)
    return fine, -(-(fmax - fine) // (2 * fine + 1))


def _half_count(fmaxes: list[int]) -> int:
    return (math.prod(2 * f + 1 for f in fmaxes) + 1) // 2


def _per_point(fmaxes: list[int], real: type[np.floating[Any]]) -> int:
    """Bytes a point needs: a group's complex table while it is made, and both real ones."""
    leading = len(fmaxes) // 2
    a, b = (_half_count(group) for group in (fmaxes[:leading], fmaxes[leading:]))
    return (4 * max(a, b) + 2 * (a + b)) * np.dtype(real).itemsize


def _chunk_points(per_point: int) -> int:
    return min(CHUNK, max(1, TABLE_BYTES // per_point))


def _chunks(n: int, per_point: int) -> list[slice]:
    points = _chunk_points(per_point)
    return [slice(begin, min(n, begin + points)) for begin in range(0, n, points)]


def _unit(phase: NDArray[np.uint64], real: type[np.floating[Any]]) -> NDArray[Any]:
    """exp(-2 pi i phase / 2^64), the nearest quarter turn taken off in integers."""
    quarter = (phase + np.uint64(1 << 61)) >> np.uint64(62)
    angle = ((phase - (quarter << np.uint64(62))).view(np.int64) * (2 * math.pi / TURN)).astype(
        real, copy=False
    )
    wave = np.empty(phase.shape, np.result_type(real, np.complex64))
    wave.real = np.cos(angle)
    wave.imag = -np.sin(angle)
    wave *= UNITS.astype(wave.dtype)[quarter.view(np.int64) & 3]
    return wave


def _axis_table(turns: NDArray[np.uint64], fmax: int, real: type[np.floating[Any]]) -> NDArray[Any]:
    """exp(-2 pi i f x) at f = 0 .. fmax, few of them by sine and cosine: (fmax+1, points) complex."""
    if fmax <= WHOLE:
        return _unit(np.arange(fmax + 1, dtype=np.uint64)[:, None] * turns, real)
    s, h = _split(fmax)
    fine = _both_signs(_unit(np.arange(s + 1, dtype=np.uint64)[:, None] * turns, real))
    coarse = _unit(np.arange(0, (2 * s + 1) * h + 1, 2 * s + 1, dtype=np.uint64)[:, None] * turns, real)
    table: NDArray[Any] = (coarse[:, None] * fine).reshape(-1, len(turns))
    return table[s : s + fmax + 1]


def _both_signs(table: NDArray[Any]) -> NDArray[Any]:
    return np.concatenate([table[:0:-1].conj(), table])


def _group_table(
    turns: NDArray[np.uint64], fmaxes: list[int], real: type[np.floating[Any]], axis: int
) -> NDArray[Any]:
    """Real and imaginary parts of a group's half space, from its centre on: (2 count, points).

    With axis 0 all real parts come first, with axis 1 each is followed by its imaginary part.
    """
    table = _axis_table(turns[0], fmaxes[0], real)
    for x, fmax in zip(turns[1:], fmaxes[1:], strict=True):
        table = (table[:, None] * _both_signs(_axis_table(x, fmax, real))).reshape(-1, turns.shape[1])
    table = table[len(table) - _half_count(fmaxes) :]
    return np.stack([np.real(table), np.imag(table)], axis=axis).reshape(-1, turns.shape[1])


def _cube_of(sums: FloatArray, squares: float) -> FloatArray:
    """Power of all four quadrants from the four sums of one: (a, 2, 2, b) -> (2 a - 1, 2 b - 1)."""
    a, b = sums.shape[0], sums.shape[3]
    cube = np.empty((2 * a - 1, 2 * b - 1))
    rows = max(1, BLOCK_BYTES // (32 * b))
    for row in range(0, a, rows):
        (cc, cs), (sc, ss) = np.moveaxis(sums[row : row + rows], 0, 2)
        half = cube[a - 1 + row : a - 1 + row + len(cc)]
        half[:, : b - 1] = ((cc + ss) ** 2 + (sc - cs) ** 2)[:, :0:-1]
        half[:, b - 1 :] = (cc - ss) ** 2 + (sc + cs) ** 2
        half /= squares
    cube[: a - 1] = cube[: a - 1 : -1, ::-1]
    return cube


def _phase_errors(
    n: int, d: int, fmax: int, x: FloatArray | None, weights: FloatArray | None
) -> tuple[float, float]:
    """Bound what rounding coordinates does, over sum |w|, and its typical size, over the norm of w."""
    if x is None:
        rounding, mean_square = d * 0.5, d * 2.0**-12 / 12
    else:
        turns = x * TURN
        rest = np.abs(turns - np.rint(turns))
        share = np.ones(n) / n if weights is None else np.abs(weights) / np.abs(weights).sum()
        rounding = float(share @ rest.sum(axis=1))
        mean_square = float(share**2 @ (rest**2).sum(axis=1) / (share @ share))
    scale = 2 * math.pi * fmax / TURN
    return scale * rounding, scale * math.sqrt(mean_square / 3)
