"""Power of large grids in up to three dimensions by FINUFFT (Barnett, Magland & af Klinteberg 2019).

A type 1 transform of n points to a grid of G frequencies costs n + G log G, where the exact product costs
n G. Its error is chosen. FINUFFT is optional (``pip install finufft``) and loaded on first use. Reference:
SIAM J. Sci. Comput. 41(5), 2019.
"""

from __future__ import annotations

import math
from functools import cache
from importlib.util import find_spec
from typing import Any

import numpy as np

from gbnbench.analysis.spectrum.evaluators.nufft.cost import half_grid_pays, nufft_seconds, upsampling_factor
from gbnbench.analysis.spectrum.evaluators.nufft.limits import check_tolerance
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, fixed_point

ALONE = 0.01  # seconds below which one thread is faster than several


@cache
def available() -> bool:
    """Tell whether FINUFFT is installed and loads here."""
    if find_spec("finufft") is None:
        return False
    try:
        import finufft as _  # noqa: F401 - only whether it loads
    except (ImportError, OSError, RuntimeError):
        return False
    return True


def nufft_power(
    x: FloatArray,
    fmax: int,
    tolerance: float,
    weights: FloatArray | None = None,
    threads: int | None = None,
) -> FloatArray:
    """Power of one point set at every integer frequency with |f_a| <= fmax, to a tolerance.

    Parameters
    ----------
    x : (n, d) float64
        Checked points of the unit torus, d <= 3.
    fmax : int
        Largest harmonic on each axis, cycles per unit length.
    tolerance : float
        FINUFFT's eps, 1e-14 to 0.1; ``nufft_tolerance`` finds it from an error of sqrt(power).
    weights : (n,) float64, optional
        A weight for each point, 1 without.
    threads : int, optional
        Threads of FINUFFT. If not given, one for transforms of less than 10 ms, where more threads cost more
        than they gain, and otherwise as many as there are cores.

    Returns
    -------
    (2*fmax+1,)*d float64
        |sum_k w_k exp(-2 pi i f.x_k)|^2 / sum_k w_k^2, zero frequency at the centre.

    Raises
    ------
    InputError
        If FINUFFT is not installed, does not do these dimensions, cannot reach the tolerance or has no room.

    Notes
    -----
    Weights are real, so the half of the frequencies with f_1 >= 0 gives the rest. With strengths
    w exp(-2 pi i s x_1), s = (fmax + 1) // 2, a grid of fmax + 1 modes on the first axis holds that half.
    This halves the FFT for one sine and cosine a point, and is done unless points outnumber frequencies.
    FINUFFT is given 2 pi (x - rint(x)), where the difference is exact; 2 pi x would round twice as coarsely.
    """
    check_tolerance(x.shape[1], tolerance)
    if not available():
        raise InputError("FINUFFT is not installed here: pip install finufft, or ask for an exact method")
    n, d = x.shape
    base = 2 * fmax + 1
    scaled = np.ones(n) if weights is None else weights / np.abs(weights).max()
    halved = half_grid_pays(n, d, fmax)
    strengths = scaled.astype(np.complex128)
    if halved:
        shift = (fixed_point(x[:, 0], 64) * np.uint64((fmax + 1) // 2)).view(np.int64)
        angle = shift * (2 * math.pi / 2.0**64)
        strengths.real, strengths.imag = scaled * np.cos(angle), -scaled * np.sin(angle)
    amplitude = _transform(
        np.ascontiguousarray((2 * math.pi * (x - np.rint(x))).T),
        strengths,
        (fmax + 1 if halved else base,) + (base,) * (d - 1),
        tolerance,
        upsampling_factor(n, d, fmax, tolerance),
        1 if threads is None and nufft_seconds(n, d, fmax, tolerance) < ALONE else threads,
    )
    cube = np.empty((base,) * d)
    part = cube[base - len(amplitude) :]
    np.multiply(amplitude.real, amplitude.real, out=part)
    part += amplitude.imag**2
    part /= float(scaled @ scaled)
    flat = cube.reshape(-1)
    flat[: flat.size // 2] = flat[: flat.size // 2 : -1]
    # DC is known, and its error would be coherent.
    flat[flat.size // 2] = scaled.sum() ** 2 / float(scaled @ scaled)
    return cube


def _transform(
    radians: FloatArray,
    strengths: Any,
    modes: tuple[int, ...],
    tolerance: float,
    upsampling: float,
    threads: int | None,
) -> Any:
    import finufft

    call: Any = (finufft.nufft1d1, finufft.nufft2d1, finufft.nufft3d1)[len(modes) - 1]
    try:
        return call(
            *radians,
            strengths,
            modes if len(modes) > 1 else max(modes),
            eps=tolerance,
            isign=-1,
            nthreads=threads or 0,
            upsampfac=upsampling,
        )
    except RuntimeError as error:
        raise InputError(f"FINUFFT cannot evaluate {math.prod(modes)} frequencies: {error}") from None
