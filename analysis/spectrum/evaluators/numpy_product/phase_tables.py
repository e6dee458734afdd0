"""Tables of exp(-2 pi i f.x) for a half space of frequencies, from exact fixed-point phases."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError

REALS: dict[str, type[np.floating[Any]]] = {"double": np.float64, "float": np.float32}
WHOLE = 8  # up to this fmax each harmonic has a sine and cosine of its own
TURN = 2.0**64
UNITS = np.array([1, -1j, -1, 1j])  # exp(-i pi q / 2) for q = 0 .. 3


def real_type(precision: str) -> type[np.floating[Any]]:
    """Give the numpy type of a precision, or raise InputError if it is neither "double" nor "float"."""
    if precision not in REALS:
        raise InputError(f'precision must be "double" or "float"; got {precision!r}')
    return REALS[precision]


def product_axes(turns: NDArray[np.uint64], fmax: int) -> tuple[NDArray[np.uint64], list[int]]:
    """Give the coordinates and largest multiples of the axes of a product; one axis is cut in two.

    In one dimension f = (2 s + 1) h + l with |l| <= s, so that (2 s + 1) x and x serve as two coordinates.

    Parameters
    ----------
    turns : (d, n) uint64
        Coordinates in units of 2^-64.
    fmax : int
        Largest harmonic on each axis.

    Returns
    -------
    turns : (axes, n) uint64
    fmaxes : list of int
        Largest multiple on each axis.
    """
    if len(turns) > 1:
        return turns, [fmax] * len(turns)
    fine, coarse = split_harmonic(fmax)
    return np.concatenate([turns * np.uint64(2 * fine + 1), turns]), [coarse, fine]


def split_harmonic(fmax: int) -> tuple[int, int]:
    """Find s and h of about the same size with (2 s + 1) h + s >= fmax."""
    fine = math.isqrt(fmax // 2)
    return fine, -(-(fmax - fine) // (2 * fine + 1))


def half_count(fmaxes: list[int]) -> int:
    """Count zero and one half space of a group with these largest multiples."""
    return (math.prod(2 * f + 1 for f in fmaxes) + 1) // 2


def phasors(phase: NDArray[np.uint64], real: type[np.floating[Any]]) -> NDArray[Any]:
    """Evaluate exp(-2 pi i phase / 2^64), with the nearest quarter turn taken off in integers.

    Parameters
    ----------
    phase : uint64
        Phases of any shape, in units of 2^-64 turns.
    real : type
        float64 or float32.

    Returns
    -------
    complex128 or complex64
        Of the shape of ``phase``.
    """
    quarter = (phase + np.uint64(1 << 61)) >> np.uint64(62)
    angle = ((phase - (quarter << np.uint64(62))).view(np.int64) * (2 * math.pi / TURN)).astype(
        real, copy=False
    )
    wave = np.empty(phase.shape, np.result_type(real, np.complex64))
    wave.real = np.cos(angle)
    wave.imag = -np.sin(angle)
    wave *= UNITS.astype(wave.dtype)[quarter.view(np.int64) & 3]
    return wave


def axis_table(turns: NDArray[np.uint64], fmax: int, real: type[np.floating[Any]]) -> NDArray[Any]:
    """Tabulate exp(-2 pi i f x) at f = 0 .. fmax, most of them as products of two others.

    Parameters
    ----------
    turns : (points,) uint64
        One coordinate in units of 2^-64.
    fmax : int
        Largest frequency.
    real : type
        float64 or float32.

    Returns
    -------
    (fmax + 1, points) complex128 or complex64
    """
    if fmax <= WHOLE:
        return phasors(np.arange(fmax + 1, dtype=np.uint64)[:, None] * turns, real)
    s, h = split_harmonic(fmax)
    fine = _both_signs(phasors(np.arange(s + 1, dtype=np.uint64)[:, None] * turns, real))
    coarse = phasors(np.arange(0, (2 * s + 1) * h + 1, 2 * s + 1, dtype=np.uint64)[:, None] * turns, real)
    table: NDArray[Any] = (coarse[:, None] * fine).reshape(-1, len(turns))
    return table[s : s + fmax + 1]


def _both_signs(table: NDArray[Any]) -> NDArray[Any]:
    return np.concatenate([table[:0:-1].conj(), table])


def group_table(
    turns: NDArray[np.uint64], fmaxes: list[int], real: type[np.floating[Any]], axis: int
) -> NDArray[Any]:
    """Tabulate real and imaginary parts of exp(-2 pi i f.x) over the half space of a group.

    Parameters
    ----------
    turns : (axes, points) uint64
        Coordinates of the group in units of 2^-64.
    fmaxes : list of int
        Largest multiple on each axis.
    real : type
        float64 or float32.
    axis : {0, 1}
        0: all real parts come first; 1: each is followed by its imaginary part.

    Returns
    -------
    (2 * count, points) float64 or float32
    """
    table = axis_table(turns[0], fmaxes[0], real)
    for x, fmax in zip(turns[1:], fmaxes[1:], strict=True):
        table = (table[:, None] * _both_signs(axis_table(x, fmax, real))).reshape(-1, turns.shape[1])
    table = table[len(table) - half_count(fmaxes) :]
    return np.stack([np.real(table), np.imag(table)], axis=axis).reshape(-1, turns.shape[1])
