"""Power of every one of several sets, at the frequencies of a cube or at listed ones."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import PrecisionName
from gbnbench.analysis.spectrum.choice import choose
from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.periodogram import cube_request, listed_spectrum, made_spectrum
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.sides import Sides
from gbnbench.core.torus import FloatArray


def power_of_each(
    x: FloatArray, fmax: int, precision: PrecisionName = "double", sides: Sides | None = None
) -> tuple[FloatArray, Spectrum]:
    """Power of every realization, with the spectrum of the first.

    Parameters
    ----------
    x : (realizations, n, d) float64
        Checked points.
    fmax : int
        Largest harmonic on each axis; for unequal sides the largest |k|.
    precision : {"double", "float"}
        As in ``periodogram``.
    sides : tuple of d floats, optional
        As ``as_sides`` returns them.

    Returns
    -------
    powers : (realizations,) + (2*fmax+1,)*d float64
        A box for unequal sides, as in ``periodogram``.
    spectrum : Spectrum
        Of the first set; its errors hold for each of them.

    Raises
    ------
    InputError
        If fmax is not a positive integer, or the powers do not fit in memory.
    """
    sets, n, d = x.shape
    f, request = cube_request(n, d, fmax, sets, sides)
    powers, errors, evaluator = choose(request, precision, None).evaluate(x, request, None, mean=False)
    first = replace(request, realizations=1)
    return powers, made_spectrum(powers[0], first, evaluator, errors, fmax=f, sides=sides)


def each_power(
    x: FloatArray, fmax: int, precision: PrecisionName = "double", sides: Sides | None = None
) -> tuple[FloatArray, Spectrum]:
    """Power of every realization, and their mean.

    Parameters, and what is raised, are those of ``power_of_each``.

    Returns
    -------
    powers : (realizations,) + (2*fmax+1,)*d float64
        A box for unequal sides, as in ``periodogram``.
    spectrum : Spectrum
        Their mean.
    """
    powers, first = power_of_each(x, fmax, precision, sides)
    return powers, averaged(first, powers.mean(axis=0), len(x))


def averaged(first: Spectrum, mean: FloatArray, sets: int) -> Spectrum:
    """Make the mean spectrum of several sets.

    Parameters
    ----------
    first : Spectrum
        Of one set, with errors that hold for each of them.
    mean : float64
        Mean power, in the shape of the first's.
    sets : int
        How many sets.

    Returns
    -------
    Spectrum
    """
    errors = Errors(first.error_rms, first.error_bound).averaged(sets, first.n)
    return replace(first, power=mean, realizations=sets, error_rms=errors.rms, error_bound=errors.bound)


def listed_power_of_each(
    x: FloatArray,
    frequencies: NDArray[np.int64],
    precision: PrecisionName = "double",
    sides: Sides | None = None,
) -> tuple[FloatArray, Spectrum]:
    """Power of every realization at listed frequencies, with the spectrum of the first.

    Parameters
    ----------
    x : (realizations, n, d) float64
        Checked points.
    frequencies : (m, d) int64
        Cycles per unit length.
    precision : {"double", "float"}
        As in ``periodogram``.
    sides : tuple of d floats, optional
        As ``as_sides`` returns them.

    Returns
    -------
    powers : (realizations, m) float64
    spectrum : Spectrum
        Of the first set; its errors hold for each of them.
    """
    each = [listed_spectrum(one[None], frequencies, precision, None, None, None, sides) for one in x]
    powers = np.stack([one.power for one in each])
    worst = {name: max(getattr(one, name) for one in each) for name in ("error_rms", "error_bound")}
    return powers, replace(each[0], **worst)
