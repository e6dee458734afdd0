"""Power of large grids in up to three dimensions by a library's non-uniform FFT.

A type 1 transform of n points to a grid of G frequencies costs n + G log G, where the exact product costs
n G. Its error is chosen. Either library is optional, and the first that is installed is taken.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gbnbench.analysis.spectrum.evaluators.nufft.cost import cheapest_layout
from gbnbench.analysis.spectrum.evaluators.nufft.ducc import DUCC0
from gbnbench.analysis.spectrum.evaluators.nufft.finufft import FINUFFT
from gbnbench.analysis.spectrum.evaluators.nufft.transform_library import Library
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, fixed_point

LIBRARIES = (DUCC0, FINUFFT)  # the first is the faster one
REMEDY = "pip install gbnbench[fast] (ducc0), or pip install finufft"


def installed() -> tuple[Library, ...]:
    """List the libraries that are installed and load here, the preferred one first."""
    return tuple(library for library in LIBRARIES if library.available)


def nufft_power(
    library: Library,
    x: FloatArray,
    fmax: int,
    tolerance: float,
    weights: FloatArray | None = None,
    *,
    half: bool = False,
) -> FloatArray:
    """Power of one point set at every integer frequency with |f_a| <= fmax, to a tolerance.

    Parameters
    ----------
    library : Library
        The library.
    x : (n, d) float64
        Checked points of the unit torus, d <= 3.
    fmax : int
        Largest harmonic on each axis, cycles per unit length.
    tolerance : float
        The library's relative error, up to 0.1; ``nufft_tolerance`` finds it from an error of sqrt(power).
    weights : (n,) float64, optional
        A weight for each point, 1 without.
    half : bool
        Only the half with f_0 >= 0.

    Returns
    -------
    (2*fmax+1,)*d float64
        |sum_k w_k exp(-2 pi i f.x_k)|^2 / sum_k w_k^2, zero frequency at the centre; the first axis only
        fmax+1 long for a half.

    Raises
    ------
    InputError
        If the library is not installed, does not do these dimensions, cannot reach the tolerance or has no
        room.

    Notes
    -----
    Weights are real, so the half of the frequencies with f_0 >= 0 gives the rest. With strengths
    w exp(-2 pi i s x_0), s = (fmax + 1) // 2, a grid of fmax + 1 modes on the first axis holds that half.
    This halves the FFT for one sine and cosine a point, and is done unless points far outnumber frequencies.
    The libraries are given x - rint(x), which is exact.
    """
    n, d = x.shape
    layout = cheapest_layout(library, n, d, fmax, tolerance)
    if not library.available:
        raise InputError(f"{library.name} is not installed here: {REMEDY}, or ask for an exact method")
    base = 2 * fmax + 1
    scaled = np.ones(n) if weights is None else weights / np.abs(weights).max()
    modes = (fmax + 1 if layout.halved else base, *(base,) * (d - 1))
    try:
        amplitude = library.transform(
            x - np.rint(x),
            shifted(x[:, 0], scaled, (fmax + 1) // 2) if layout.halved else scaled.astype(np.complex128),
            modes,
            tolerance,
            layout.upsampling.factor,
        )
    except (RuntimeError, MemoryError) as error:
        raise InputError(
            f"{library.name} cannot evaluate {math.prod(modes)} frequencies: {error}. Ask for another method"
        ) from None
    amplitude = amplitude[-fmax - 1 :]
    power = np.empty((fmax + 1 if half else base, *(base,) * (d - 1)))
    kept = power[-fmax - 1 :]
    np.multiply(amplitude.real, amplitude.real, out=kept)
    kept += amplitude.imag**2
    kept /= float(scaled @ scaled)
    middle = kept[:1].reshape(-1)  # f_0 = 0, where each frequency stands beside its mirror image
    middle[: middle.size // 2] = middle[: middle.size // 2 : -1]
    # DC is known, and its error would be coherent.
    middle[middle.size // 2] = scaled.sum() ** 2 / float(scaled @ scaled)
    if not half:
        power[:fmax] = np.flip(kept[1:])
    return power


def shifted(coordinate: FloatArray, weights: FloatArray, shift: int) -> Any:
    """Compute strengths whose spectrum is that of the weights, shifted along one axis.

    Parameters
    ----------
    coordinate : (n,) float64
        Coordinates on that axis, in [0, 1).
    weights : (n,) float64
        Weights of the points.
    shift : int
        Modes by which the spectrum is shifted.

    Returns
    -------
    (n,) complex128
        w exp(-2 pi i shift x), good to 5 units of 2^-53: phases are reduced in integers, where shift times x
        would lose as many digits as it has before the point.
    """
    phase = (fixed_point(coordinate, 64) * np.uint64(shift)).view(np.int64)
    angle = phase * (2 * math.pi / 2.0**64)
    strengths = np.empty(len(weights), np.complex128)
    strengths.real, strengths.imag = weights * np.cos(angle), -weights * np.sin(angle)
    return strengths
