"""Mean power at the frequencies of a ball or band of |k| of a torus with unequal sides.

The frequencies asked for are evaluated one by one, or as the box |f_a| <= |k| s_a that holds them, whichever
takes fewer multiply-adds: the box up to about eight dimensions, as far as it fits in memory.
"""

from __future__ import annotations

import math
from contextlib import suppress
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import PrecisionName
from gbnbench.analysis.spectrum.box_shells import harmonics_within
from gbnbench.analysis.spectrum.choice import choose
from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.protocol import Evaluator
from gbnbench.analysis.spectrum.request import Progress, SpectrumRequest, box_request
from gbnbench.analysis.spectrum.shells import EDGE
from gbnbench.core.errors import InputError
from gbnbench.core.integer_frequencies import MOST_FREQUENCIES
from gbnbench.core.sides import Sides, squared_lengths
from gbnbench.core.torus import FloatArray

CHUNK = 1 << 14  # listed frequencies evaluated between two reports of progress


@dataclass(frozen=True)
class BallPower:
    """Power of one half space of a ball or band, averaged over sets.

    Attributes
    ----------
    square : (m,) float64
        |k|^2 of each frequency.
    power : (m,) float64
        Its mean power.
    evaluator : Evaluator
        What evaluated it.
    errors : Errors
        Errors of the square root of the power of any one set.
    """

    square: FloatArray
    power: FloatArray
    evaluator: Evaluator
    errors: Errors


def ball_power(
    x: FloatArray,
    band: tuple[float, float],
    sides: Sides,
    weights: FloatArray | None,
    precision: PrecisionName,
    floor: float | None,
    progress: Progress | None,
) -> BallPower:
    """Evaluate the power at every frequency of a band, of each pair f, -f once.

    Parameters
    ----------
    x : (sets, n, d) float64
        Checked points.
    band : (float, float)
        Smallest and largest |k|, DC being left out.
    sides : tuple of d floats
        As ``as_sides`` returns them.
    weights : (sets or 1, n) float64 or None
        As ``check_weights`` returns them.
    precision : {"double", "float"}
        As in ``gbnbench.periodogram``.
    floor : float or None
        Smallest power that must be known to 1%.
    progress : callable or None
        Called now and then with the share done.

    Returns
    -------
    BallPower

    Raises
    ------
    InputError
        If no frequency lies in the band, or it has too many.
    """
    _, n, d = x.shape
    request = cheapest_request(n, d, len(x), band, sides, precision, floor)
    evaluator = choose(request, precision, floor)
    if request.what == "cube":
        power, errors, evaluator = evaluator.evaluate(x, request, weights, mean=True)
        square = squared_lengths(harmonics_within(band[1], sides), sides).ravel()
        wanted = _within(square, band)
        wanted[: len(wanted) // 2 + 1] = False  # one half space
        _refuse_none(wanted.any(), band)
        return BallPower(square[wanted], power.ravel()[wanted], evaluator, errors)
    frequencies, square = half_band(band, sides)
    _refuse_none(len(square) > 0, band)
    power, rms, bound = np.empty(len(square)), 0.0, 0.0
    for begin in range(0, len(square), CHUNK):
        some = slice(begin, begin + CHUNK)
        power[some], errors = evaluator.listed(x, frequencies[some], weights)
        rms, bound = max(rms, errors.rms), max(bound, errors.bound)
        if progress is not None:
            progress(min(1.0, (begin + CHUNK) / len(square)))
    return BallPower(square, power, evaluator, Errors(rms, bound))


def cheapest_request(
    n: int,
    d: int,
    realizations: int,
    band: tuple[float, float],
    sides: Sides,
    precision: PrecisionName,
    floor: float | None,
) -> SpectrumRequest:
    """Make the request for a band: listed, or as the box that holds it, whichever takes less work.

    Parameters
    ----------
    n, d, realizations : int
        Points in a set, dimension, number of sets.
    band : (float, float)
        Smallest and largest |k|.
    sides : tuple of d floats
        As ``as_sides`` returns them.
    precision : {"double", "float"}
        As in ``gbnbench.periodogram``.
    floor : float or None
        Smallest power that must be known to 1%.

    Returns
    -------
    SpectrumRequest
        Of a box, or of listed frequencies, whose number is estimated by the volume of the band.
    """
    harmonics = harmonics_within(band[1], sides)
    ball = math.pi ** (d / 2) / math.gamma(d / 2 + 1)
    count = max(1, math.ceil(ball * (band[1] ** d - band[0] ** d) / 2))
    listed = SpectrumRequest("listed", n, d, max(harmonics), realizations, count)
    with suppress(InputError):  # too large for memory
        box = box_request(n, d, harmonics, realizations)
        work = choose(box, precision, floor).work(box)
        if work <= choose(listed, precision, floor).work(listed):
            return box
    return listed


def half_band(
    band: tuple[float, float], sides: Sides, most_rows: int = MOST_FREQUENCIES
) -> tuple[NDArray[np.int64], FloatArray]:
    """List the frequencies of a band whose first nonzero component is positive, axis by axis.

    Parameters
    ----------
    band : (float, float)
        Smallest and largest |k|.
    sides : tuple of d floats
        As ``as_sides`` returns them.
    most_rows : int
        Frequencies beyond which they are refused.

    Returns
    -------
    frequencies : (m, d) int64
        DC left out.
    square : (m,) float64
        Their |k|^2.

    Raises
    ------
    InputError
        If there are more than are listed.
    """
    most = (band[1] * (1 + EDGE)) ** 2
    rows, square = np.zeros((1, 0), np.int64), np.zeros(1)
    for side, largest in zip(sides, harmonics_within(band[1], sides), strict=True):
        f = np.arange(-largest, largest + 1)
        if len(rows) * len(f) > 8 * MOST_FREQUENCIES:
            _refuse_many(band)
        total = square[:, None] + f**2 / side**2
        row, column = np.nonzero((total <= most) & ((rows != 0).any(axis=1, keepdims=True) | (f >= 0)))
        rows, square = np.column_stack([rows[row], f[column]]), total[row, column]
        if len(rows) > most_rows + 1:  # with DC
            _refuse_many(band)
    wanted = _within(square, band)
    return rows[wanted], square[wanted]


def _within(square: FloatArray, band: tuple[float, float]) -> NDArray[np.bool_]:
    low, high = band
    return (square > 0) & (square >= (low * (1 - EDGE)) ** 2) & (square <= (high * (1 + EDGE)) ** 2)


def _refuse_none(found: bool | np.bool_, band: tuple[float, float]) -> None:
    if not found:
        raise InputError(f"no frequency of this torus has |k| from {band[0]:g} to {band[1]:g}")


def _refuse_many(band: tuple[float, float]) -> None:
    raise InputError(
        f"|k| from {band[0]:g} to {band[1]:g} holds more than the {MOST_FREQUENCIES:,} frequencies that are "
        "listed, and the box that holds them does not fit in memory; ask for a smaller fmax"
    )
