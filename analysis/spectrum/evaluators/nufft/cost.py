"""Time and memory of FINUFFT's transforms, by a model that was fitted to measured calls."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gbnbench.analysis.spectrum.evaluators.nufft.limits import check_tolerance

NARROW, WIDE = 1.25, 2.0  # upsampling factors: small FFTs with wide kernels, or large with narrow
NARROW_REACHES = 1e-7  # at tighter tolerances NARROW magnifies rounding at the corners of a grid


@dataclass(frozen=True)
class TransformCost:
    """Parts of a transform's time on one core in one dimension, in nanoseconds.

    Attributes
    ----------
    call : float
        For each call.
    axis : float
        For each pair of a grid line's point and a kernel's point, which make the Fourier series of the
        kernel.
    point, shift, cell : float
        For each point, for each point whose strength is shifted, and for each grid point that a point
        reaches.
    grid, far : float
        For each grid point and level of the FFT, and the same besides for a grid beyond the cache.
    """

    call: float
    axis: float
    point: float
    shift: float
    cell: float
    grid: float
    far: float


# By dimension; fitted to 476 calls of FINUFFT 2.5.1 on an EPYC core, of which 98% lie within a factor of two.
COSTS = (
    TransformCost(230e3, 1.1, 18, 48, 3.6, 2.1, 0.06),
    TransformCost(330e3, 5.6, 45, 54, 0.56, 1.06, 0.52),
    TransformCost(380e3, 0.0, 99, 54, 0.34, 1.1, 0.50),
)
CACHED = 3e5  # complex grid points beyond which an FFT leaves the cache


def nufft_seconds(n: int, d: int, fmax: int, tolerance: float) -> float:
    """Estimate the CPU seconds of ``nufft_power`` on one core.

    Parameters
    ----------
    n, d, fmax : int
        Points, dimensions and the largest |f_a|.
    tolerance : float
        Tolerance of FINUFFT.

    Returns
    -------
    float
        Seconds; within a factor of two on the machine where the model was fitted.

    Raises
    ------
    InputError
        If FINUFFT does not do these dimensions or cannot reach the tolerance.

    Notes
    -----
    The constants were fitted on one machine with one build of FINUFFT. Elsewhere all times change by about
    the same factor.
    """
    check_tolerance(d, tolerance)
    return _seconds(n, d, fmax, tolerance, upsampling_factor(n, d, fmax, tolerance))


def nufft_bytes(n: int, d: int, fmax: int, tolerance: float) -> int:
    """Size the memory that ``nufft_power`` takes: upsampled grid, half space of amplitudes, cube and points.

    Parameters
    ----------
    n, d, fmax : int
        Points, dimensions and the largest |f_a|.
    tolerance : float
        Tolerance of FINUFFT.

    Returns
    -------
    int
        Bytes.
    """
    modes, grid = _sizes(n, d, fmax, upsampling_factor(n, d, fmax, tolerance))
    return int(16 * grid + 32 * modes + 8 * (2 * fmax + 1) ** d + n * (16 * d + 48))


def half_grid_pays(n: int, d: int, fmax: int) -> bool:
    """Tell whether transforming half a grid pays for one more sine and cosine a point.

    Parameters
    ----------
    n, d, fmax : int
        Points, dimensions and the largest |f_a|.

    Returns
    -------
    bool
    """
    return bool(n <= (2 * fmax + 1) ** d)


def _sizes(n: int, d: int, fmax: int, upsampling: float) -> tuple[int, float]:
    """Count the modes asked of FINUFFT, and the points of its grid."""
    base = 2 * fmax + 1
    modes = (fmax + 1 if half_grid_pays(n, d, fmax) else base) * base ** (d - 1)
    return int(modes), modes * upsampling**d


def upsampling_factor(n: int, d: int, fmax: int, tolerance: float) -> float:
    """Choose the cheaper upsampling factor, since FINUFFT's own choice hardly depends on the sizes.

    Parameters
    ----------
    n, d, fmax : int
        Points, dimensions and the largest |f_a|.
    tolerance : float
        Tolerance of FINUFFT.

    Returns
    -------
    float
        1.25 or 2.
    """
    if tolerance < NARROW_REACHES:
        return WIDE
    return min((WIDE, NARROW), key=lambda factor: _seconds(n, d, fmax, tolerance, factor))


def _seconds(n: int, d: int, fmax: int, tolerance: float, upsampling: float) -> float:
    cost = COSTS[d - 1]
    halved = half_grid_pays(n, d, fmax)
    # Barnett et al.: a kernel of width w has pi (w - 1) sqrt(1 - 1 / upsampling) / ln 10 digits.
    decay = math.pi * math.sqrt(1 - 1 / upsampling)
    width = max(2, min(16, math.ceil(1 - math.log(tolerance) / decay)))
    grid = max(_sizes(n, d, fmax, upsampling)[1], (2 * width) ** d)
    lines = upsampling * ((fmax + 1 if halved else 2 * fmax + 1) + (d - 1) * (2 * fmax + 1))
    far = min(1.0, max(0.0, math.log2(grid / CACHED)))
    nanoseconds = (
        cost.call
        + cost.axis * lines * width
        + n * (cost.point + cost.shift * halved + cost.cell * width**d)
        + grid * math.log2(grid) * (cost.grid + cost.far * far)
    )
    return float(1e-9 * nanoseconds)
