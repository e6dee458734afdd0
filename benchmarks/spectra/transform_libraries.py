"""Power by the libraries of non-uniform FFTs, FINUFFT and ducc0, each in its best calls."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spectrum.evaluators.nufft.ducc import DUCC0
from gbnbench.analysis.spectrum.evaluators.nufft.finufft import FINUFFT
from gbnbench.analysis.spectrum.evaluators.nufft.transform import shifted
from gbnbench.analysis.spectrum.evaluators.nufft.transform_library import DIMENSIONS
from gbnbench.core.torus import FloatArray

TOLERANCES = {
    "FINUFFT": (1e-3, 1e-6, 1e-9, 1e-12, 1e-14),
    "ducc0, half": (1e-3, 1e-6, 1e-9, 1e-12, 1e-13),
    "ducc0, all": (1e-3, 1e-6, 1e-9, 1e-12, 1e-13),
}


def transform_calls(d: int) -> Iterator[tuple[str, float, Callable[[FloatArray, int], FloatArray]]]:
    """Yield the libraries that are installed, at each of their tolerances.

    Parameters
    ----------
    d : int
        Dimension.

    Yields
    ------
    library : str
    tolerance : float
        Relative error that it is asked for.
    call : callable
        From points (n, d) and fmax to power.
    """
    if d > DIMENSIONS:
        return
    libraries = {"FINUFFT": finufft} if FINUFFT.available else {}
    if DUCC0.available:
        libraries |= {"ducc0, half": partial(ducc, half=True), "ducc0, all": partial(ducc, half=False)}
    for library, call in libraries.items():
        for tolerance in TOLERANCES[library]:
            yield library, tolerance, partial(call, tolerance=tolerance)


def finufft(x: FloatArray, fmax: int, tolerance: float) -> FloatArray:
    """Compute power by FINUFFT's type 1 transform on one thread, one call for each set.

    Parameters
    ----------
    x : (n, d) float64
        Points.
    fmax : int
        Largest harmonic on each axis.
    tolerance : float
        FINUFFT's eps.

    Returns
    -------
    (2*fmax+1,)*d float64
    """
    import finufft as library

    transform: Any = getattr(library, f"nufft{x.shape[1]}d1")
    modes: Any = (2 * fmax + 1,) * x.shape[1]
    turns = [np.multiply(2 * np.pi, coordinate) for coordinate in np.ascontiguousarray(x.T)]
    ones = np.ones(len(x), complex)
    amplitude = transform(
        *turns, ones, modes if len(modes) > 1 else modes[0], eps=tolerance, isign=-1, nthreads=1
    )
    return squared(amplitude, len(x))


def ducc(x: FloatArray, fmax: int, tolerance: float, *, half: bool) -> FloatArray:
    """Compute power by ducc0's transform on one thread.

    Parameters
    ----------
    x : (n, d) float64
        Points.
    fmax : int
        Largest harmonic on each axis.
    tolerance : float
        ducc0's epsilon.
    half : bool
        Only f_0 >= 0, by strengths exp(-2 pi i s x_0), s = (fmax + 1) // 2, whose phases are reduced in
        integers; the other half follows by symmetry. Without, all frequencies of strengths 1.

    Returns
    -------
    (2*fmax+1,)*d float64
    """
    import ducc0

    n, d = x.shape
    base = 2 * fmax + 1
    strengths = shifted(x[:, 0], np.ones(n), (fmax + 1) // 2) if half else np.ones(n, complex)
    call: Any = ducc0.nufft.nu2u
    amplitude = call(
        points=strengths,
        coord=x - np.rint(x),
        forward=True,
        epsilon=tolerance,
        nthreads=1,
        out=np.empty((fmax + 1 if half else base, *(base,) * (d - 1)), complex),
        periodicity=1.0,
    )
    if not half:
        return squared(amplitude, n)
    power = np.empty((base,) * d)
    power[fmax:] = squared(amplitude, n)
    power[:fmax] = np.flip(power[fmax + 1 :])
    return power


def squared(amplitude: NDArray[np.complex128], n: int) -> FloatArray:
    """Compute power from amplitudes.

    Parameters
    ----------
    amplitude : (...) complex128
        Sums over points.
    n : int
        Points.

    Returns
    -------
    (...) float64
        |F|^2 / n.
    """
    power: FloatArray = (amplitude.real**2 + amplitude.imag**2) / n
    return power
