"""Time and memory of non-uniform FFTs, by a model that was fitted to measured calls of each library."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache

from gbnbench.analysis.spectrum.evaluators.nufft.transform_library import Library, Upsampling

CACHED = 3e5  # complex grid points beyond which an FFT leaves the cache
WIDEST = 16  # points across the widest kernel of both libraries


@dataclass(frozen=True)
class Layout:
    """The way in which a set of points is transformed.

    Attributes
    ----------
    halved : bool
        Whether strengths are shifted, so that the modes are those of half the frequencies.
    upsampling : Upsampling
        Factor by which the library's grid exceeds the modes.
    grid : float
        Complex points of that grid.
    seconds : float
        Expected CPU seconds on one core.
    """

    halved: bool
    upsampling: Upsampling
    grid: float
    seconds: float


@lru_cache(maxsize=256)
def cheapest_layout(library: Library, n: int, d: int, fmax: int, tolerance: float) -> Layout:
    """Find the cheapest way: half the modes for one sine and cosine a point, or all of them.

    Parameters
    ----------
    library : Library
        The library.
    n, d, fmax : int
        Points, dimensions and the largest |f_a|.
    tolerance : float
        Relative error asked for.

    Returns
    -------
    Layout

    Raises
    ------
    InputError
        If the library does not do these dimensions or cannot reach the tolerance.
    """
    library.check(d, tolerance)
    return min(_layouts(library, n, d, fmax, tolerance), key=lambda layout: layout.seconds)


def nufft_seconds(library: Library, n: int, d: int, fmax: int, tolerance: float) -> float:
    """Estimate the CPU seconds of ``nufft_power`` on one core.

    Parameters and errors are those of ``cheapest_layout``.

    Returns
    -------
    float
        Seconds; within a factor of two on the machine where the model was fitted.

    Notes
    -----
    The constants were fitted on one machine with one build of each library. Elsewhere all times change by
    about the same factor.
    """
    return cheapest_layout(library, n, d, fmax, tolerance).seconds


def nufft_bytes(library: Library, n: int, d: int, fmax: int, tolerance: float) -> int:
    """Size the memory that ``nufft_power`` takes: upsampled grid, amplitudes, cube and points.

    Parameters and errors are those of ``cheapest_layout``.

    Returns
    -------
    int
        Bytes.
    """
    layout, base = cheapest_layout(library, n, d, fmax, tolerance), 2 * fmax + 1
    modes = (fmax + 1 if layout.halved else base) * base ** (d - 1)
    return int(16 * layout.grid + 32 * modes + 8 * base**d + n * (16 * d + 48))


def _layouts(library: Library, n: int, d: int, fmax: int, tolerance: float) -> Iterator[Layout]:
    """Count the work of every layout that reaches the tolerance."""
    cost, base = library.costs[d - 1], 2 * fmax + 1
    for upsampling in library.upsampling:
        if tolerance < upsampling.reaches:
            continue
        factor = upsampling.factor
        # Barnett et al.: a kernel of width w has pi (w - 1) sqrt(1 - 1 / factor) / ln 10 digits.
        decay = math.pi * math.sqrt(1 - 1 / factor)
        width = max(library.narrowest, min(WIDEST, math.ceil(1 - math.log(tolerance) / decay)))
        for halved in (True, False):
            first = fmax + 1 if halved else base
            grid = max(first * base ** (d - 1) * factor**d, (2 * width) ** d)
            far = min(1.0, max(0.0, math.log2(grid / CACHED)))
            nanoseconds = (
                cost.call
                + cost.axis * factor * (first + (d - 1) * base) * width
                + n * (cost.point + cost.shift * halved + cost.cell * width**d)
                + grid * math.log2(grid) * (cost.grid + cost.far * far)
            )
            yield Layout(halved, upsampling, float(grid), float(1e-9 * nanoseconds))
