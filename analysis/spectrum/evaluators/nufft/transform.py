"""FINUFFT as the cheaper evaluation of large grids in up to three dimensions (Barnett et al. 2019).

A type 1 transform costs n + G log G for a grid of G, the exact product n G: where both are large it wins, at
an error that is chosen. FINUFFT is optional (``pip install finufft``) and loaded on first use: Barnett,
Magland & af Klinteberg, SIAM J. Sci. Comput. 41(5), 2019.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from typing import Any

import numpy as np

from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, fixed_point

DIMENSIONS = 3  # FINUFFT's largest
TIGHTEST, LOOSEST = 1e-14, 1e-1  # tolerances that change anything
NARROW, WIDE = 1.25, 2.0  # upsampling of the grid: small FFTs and wide kernels, or the reverse
NARROW_REACHES = 1e-7  # below, its kernels magnify rounding at the corners of a grid
ALONE = 0.01  # seconds that one thread does alone
UNIT = 2.0**-53

# Errors of sqrt(power), met with n = 16 to 3e5 and F = 4 to 20,000. Scattered points: over the tolerance,
TYPICAL, LARGEST = 0.35, 1.0
# and in units of 2^-53: always, for each harmonic, and for each point over the root of the modes.
FLOOR, FLOOR_HARMONIC, FLOOR_POINT = 15.0, 1.0, 0.1
# On coincident points, where errors are coherent, over sqrt(n) and at least three times what was met.
COHERENT, COHERENT_FLOOR, COHERENT_HARMONIC = 30.0, 100.0, 3.0
COHERENT_POINT = (5.0, 8.0, 20.0)  # by dimension
COHERENT_POINT_NARROW = 1e5
SUBPROBLEM = (10_000, 100_000, 100_000)  # points FINUFFT sums one after another, in 1, 2 and 3 dimensions


@dataclass(frozen=True)
class Cost:
    """CPU nanoseconds on one core of what a transform in some dimension does.

    Attributes
    ----------
    call : float
        Once.
    axis : float
        A grid line's point and kernel's point, for the kernel's Fourier series.
    point, shift, cell : float
        A point; a point whose strength is shifted; a grid point that a point is spread to.
    grid, far : float
        A grid point and level of the FFT; the same more for each doubling past the cache.
    """

    call: float
    axis: float
    point: float
    shift: float
    cell: float
    grid: float
    far: float


# Fitted to 476 calls of FINUFFT 2.5.1 on an EPYC core: 98% within a factor of two.
COSTS = (
    Cost(230e3, 1.1, 18, 48, 3.6, 2.1, 0.06),
    Cost(330e3, 5.6, 45, 54, 0.56, 1.06, 0.52),
    Cost(380e3, 0.0, 99, 54, 0.34, 1.1, 0.50),
)
CACHED = 3e5  # complex grid points


@cache
def available() -> bool:
    """Whether FINUFFT is installed and loads here."""
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
        Without, one where that takes less than 10 ms, else as many as there are cores: FINUFFT's threads cost
        more than they gain on small transforms.

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
    Strengths are real, so half the frequencies suffice: with strengths exp(-2 pi i s x_1),
    s = (fmax + 1) // 2, a grid of fmax + 1 modes on the first axis holds those with f_1 >= 0. That halves the
    FFT, at a sine and cosine a point, and is done where there are no more points than frequencies. Points go
    in as 2 pi (x - rint(x)), whose difference is exact; 2 pi x rounds twice as coarsely.
    """
    _check(x.shape[1], tolerance)
    if not available():
        raise InputError("FINUFFT is not installed here: pip install finufft, or ask for an exact method")
    n, d = x.shape
    base = 2 * fmax + 1
    scaled = np.ones(n) if weights is None else weights / np.abs(weights).max()
    halved = _halved(n, d, fmax)
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
        _upsampling(n, d, fmax, tolerance),
        1 if threads is None and nufft_seconds(n, d, fmax, tolerance) < ALONE else threads,
    )
    cube = np.empty((base,) * d)
    part = cube[base - len(amplitude) :]
    np.multiply(amplitude.real, amplitude.real, out=part)
    part += amplitude.imag**2
    part /= float(scaled @ scaled)
    flat = cube.reshape(-1)
    flat[: flat.size // 2] = flat[: flat.size // 2 : -1]
    flat[flat.size // 2] = scaled.sum() ** 2 / float(
        scaled @ scaled
    )  # known, where its error would be coherent
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
            modes if len(modes) > 1 else modes[0],
            eps=tolerance,
            isign=-1,
            nthreads=threads or 0,
            upsampfac=upsampling,
        )
    except RuntimeError as error:
        raise InputError(f"FINUFFT cannot evaluate {math.prod(modes)} frequencies: {error}") from None


def nufft_tolerance(rms: float, n: int = 1, d: int = 1, fmax: int = 0) -> float:
    """Loosest tolerance that reaches a typical error of sqrt(power).

    Parameters
    ----------
    rms : float
        Error allowed, root mean square over frequencies.
    n, d, fmax : int, optional
        Points, dimensions and largest harmonic: FINUFFT's rounding grows with them.

    Raises
    ------
    InputError
        If FINUFFT cannot reach it; the text gives what it can.
    """
    floor = _floor(n, d, fmax)
    left = math.sqrt(rms**2 - floor**2) / LARGEST if rms > floor else 0.0
    if left < TIGHTEST:
        raise InputError(
            f"FINUFFT reaches an error of sqrt(power) of {math.hypot(floor, LARGEST * TIGHTEST):.1e} with "
            f"n={n}, d={d}, |f| <= {fmax}; got rms={rms:g}. Ask for an exact method"
        )
    return min(left, LOOSEST)


def nufft_errors(n: int, d: int, fmax: int, tolerance: float, weights: FloatArray | None = None) -> Errors:
    """Errors of the square root of what ``nufft_power`` returns.

    Parameters
    ----------
    n, d, fmax : int
        Points, dimensions and the largest |f_a|.
    tolerance : float
        As asked for.
    weights : (n,) float64, optional
        A weight for each point.

    Returns
    -------
    Errors
        Of scattered points, and a bound. It is empirical, not proven like the exact methods': some three
        times the largest error met on scattered, clustered and coincident points, where errors add up
        coherently to a few times the tolerance times sqrt(n).

    Raises
    ------
    InputError
        If FINUFFT does not do these dimensions or cannot reach the tolerance.
    """
    _check(d, tolerance)
    worst = math.sqrt(n)
    if weights is not None:
        scaled = np.abs(weights) / np.abs(weights).max()
        worst = float(scaled.sum() / np.linalg.norm(scaled))
    wide = _upsampling(n, d, fmax, tolerance) == WIDE
    point = COHERENT_POINT[d - 1] if wide else COHERENT_POINT_NARROW
    together = min(n, SUBPROBLEM[d - 1])
    rounding = UNIT * (COHERENT_FLOOR + COHERENT_HARMONIC * fmax + point * together)
    return Errors(
        rms=math.hypot(TYPICAL * tolerance, _floor(n, d, fmax)),
        bound=worst * min(2.0, COHERENT * tolerance + rounding),
    )


def nufft_seconds(n: int, d: int, fmax: int, tolerance: float) -> float:
    """Estimate CPU seconds of ``nufft_power`` on one core: within a factor of two where it was fitted.

    Notes
    -----
    Constants were fitted on that one machine and with one build of FINUFFT; elsewhere times differ by what
    the machine does, and hardly in their ratios.
    """
    _check(d, tolerance)
    return _seconds(n, d, fmax, tolerance, _upsampling(n, d, fmax, tolerance))


def nufft_bytes(n: int, d: int, fmax: int, tolerance: float) -> int:
    """Memory that ``nufft_power`` takes: upsampled grid, half space of amplitudes, cube, points."""
    modes, grid = _sizes(n, d, fmax, _upsampling(n, d, fmax, tolerance))
    return int(16 * grid + 32 * modes + 8 * (2 * fmax + 1) ** d + n * (16 * d + 48))


def _check(d: int, tolerance: float) -> None:
    if d > DIMENSIONS:
        raise InputError(
            f"FINUFFT transforms at most {DIMENSIONS} dimensions; got d={d}. Ask for an exact method"
        )
    if not TIGHTEST <= tolerance <= LOOSEST:
        raise InputError(
            f"a tolerance of FINUFFT must lie in {TIGHTEST:g} .. {LOOSEST:g}; got {tolerance:g}. "
            "Below that ask for an exact method"
        )


def _floor(n: int, d: int, fmax: int) -> float:
    """Error of rounding alone, on scattered points."""
    return UNIT * math.hypot(FLOOR, FLOOR_HARMONIC * fmax, FLOOR_POINT * n / math.sqrt((2 * fmax + 1) ** d))


def _halved(n: int, d: int, fmax: int) -> bool:
    """Whether half a grid is worth a sine and cosine a point."""
    return bool(n <= (2 * fmax + 1) ** d)


def _sizes(n: int, d: int, fmax: int, upsampling: float) -> tuple[int, float]:
    """Modes asked of FINUFFT, and points of its grid."""
    base = 2 * fmax + 1
    modes = (fmax + 1 if _halved(n, d, fmax) else base) * base ** (d - 1)
    return int(modes), modes * upsampling**d


def _upsampling(n: int, d: int, fmax: int, tolerance: float) -> float:
    """Choose the cheaper upsampling; FINUFFT's own choice hardly looks at the sizes."""
    if tolerance < NARROW_REACHES:
        return WIDE
    return min((WIDE, NARROW), key=lambda factor: _seconds(n, d, fmax, tolerance, factor))


def _seconds(n: int, d: int, fmax: int, tolerance: float, upsampling: float) -> float:
    cost = COSTS[d - 1]
    halved = _halved(n, d, fmax)
    # Barnett, Magland & af Klinteberg: digits = pi (w - 1) sqrt(1 - 1 / upsampling) / ln 10
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
