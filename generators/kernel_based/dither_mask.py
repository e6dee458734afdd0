"""Void-and-cluster dither masks: an order of pixels whose first ones are spread evenly (Ulichney 1993)."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError
from gbnbench.core.least_values import whole_number
from gbnbench.generators.kernel_based.raster_kernel import RasterKernel, gaussian, spatiotemporal
from gbnbench.generators.kernel_based.void_and_cluster import initial_binary_pattern
from gbnbench.generators.ranges import check_range

INITIAL = 0.1  # share of ones in the initial binary pattern
MOST_PIXELS = 2**18  # 512 x 512, a minute: each rank is a search among all pixels
SMALLEST, LARGEST = 2, 2**16  # pixels of a side
TOLD_EVERY = 256  # ranks


def dither_mask(
    shape: int | Sequence[int] = 64,
    *,
    seed: int = 0,
    sigma: float = 1.5,
    sigma_time: float = 1.5,
    progress: Callable[[int, int, str], None] | None = None,
) -> NDArray[np.int64]:
    """Rank the pixels of a toroidal raster, so that the pixels below any rank are a blue-noise pattern.

    Parameters
    ----------
    shape : int or sequence of int
        Side of a square, or (rows, columns), or (frames, rows, columns) of a mask for animations. Each is at
        least 2, and there are at most 2**18 pixels in all.
    seed : int
        Of the initial binary pattern, >= 0.
    sigma : float
        Width of the Gaussian in pixels, 0.1 to 20; Ulichney's is 1.5.
    sigma_time : float
        Its width along time in frames, 0.1 to 20; of a mask with frames alone.
    progress : callable, optional
        Called with (ranks given, ranks in all, what is being done).

    Returns
    -------
    (rows, columns) or (frames, rows, columns) int64
        Each of 0 to pixels - 1 once. ``(ranks + 0.5) / ranks.size`` are thresholds in (0, 1).

    Raises
    ------
    InputError
        If an argument breaks its rule.

    Notes
    -----
    Phases I and II of Ulichney's void-and-cluster; phase III is the same as phase II on a torus. With frames
    a pixel acts on those of its own frame and on itself in other frames, as in the spatiotemporal masks of
    Wolfe et al. (2022): each frame is blue, and so is each pixel over time. 64 x 64 take 0.1 CPU seconds,
    256 x 256 take two and 512 x 512 forty.

    References
    ----------
    Ulichney, "The void-and-cluster method for dither array generation", Proc. SPIE 1913, 1993.

    Examples
    --------
    >>> ranks = dither_mask(16)
    >>> ranks.shape, sorted(ranks.ravel().tolist()) == list(range(256))
    ((16, 16), True)
    """
    sides = checked_shape(shape)
    check_range("sigma", sigma, 0.1, 20, "pixels")
    check_range("sigma_time", sigma_time, 0.1, 20, "frames")
    seed = whole_number("seed", seed, 0)
    kernel = gaussian(sides, sigma) if len(sides) == 2 else spatiotemporal(sides, sigma, sigma_time)
    return mask_ranks(sides, kernel, np.random.default_rng(seed), progress)


def checked_shape(shape: int | Sequence[int]) -> tuple[int, ...]:
    """Return the shape of a mask, or raise an error that says why it is none.

    Parameters
    ----------
    shape : int or sequence of int
        As ``dither_mask`` takes it.

    Returns
    -------
    tuple of 2 or 3 int

    Raises
    ------
    InputError
        If it is no side, nor two or three sides of 2 or more, or has too many pixels.
    """
    given = np.atleast_1d(np.asarray(shape))
    if given.ndim != 1 or given.dtype.kind not in "iu" or not 1 <= len(given) <= 3:
        raise InputError(
            "the shape of a mask must be one side, rows and columns, or frames, rows and columns, in whole "
            f"numbers; got {shape!r}"
        )
    sides: tuple[int, ...] = tuple(given.tolist() * (2 if len(given) == 1 else 1))
    if not all(SMALLEST <= side <= LARGEST for side in sides):
        raise InputError(f"each side of a mask must have {SMALLEST} to {LARGEST:,} pixels; got {shape!r}")
    if math.prod(sides) > MOST_PIXELS:
        raise InputError(
            f"a mask must have at most {MOST_PIXELS:,} pixels, such as 512 x 512, since each is searched for "
            f"among all; got {math.prod(sides):,}. Masks are periodic: lay a smaller one side by side"
        )
    return sides


def mask_ranks(
    shape: Sequence[int],
    kernel: RasterKernel,
    rng: np.random.Generator,
    progress: Callable[[int, int, str], None] | None = None,
) -> NDArray[np.int64]:
    """Give the pixels of a torus an order in which the first ones are spread evenly.

    Parameters
    ----------
    shape : sequence of int
        Pixels on each axis.
    kernel : RasterKernel
        What a pixel gives to those around it.
    rng : numpy.random.Generator
        Draws the initial binary pattern.
    progress : callable, optional
        Called with (ranks given, ranks in all, what is being done).

    Returns
    -------
    ``shape`` int64
        A permutation of 0 to pixels - 1.
    """
    pattern = initial_binary_pattern(shape, kernel, INITIAL, rng)
    pixels, first = len(pattern.ones), pattern.count
    ranks = np.empty(pixels, np.int64)
    emptied = pattern.copy()
    for rank in range(first - 1, -1, -1):
        pixel = emptied.tightest_cluster()
        emptied.remove(pixel)
        ranks[pixel] = rank
    for rank in range(first, pixels):
        pixel = pattern.largest_void()
        pattern.add(pixel)
        ranks[pixel] = rank
        if progress is not None and (rank % TOLD_EVERY == 0 or rank == pixels - 1):
            progress(rank + 1, pixels, "ranks of the mask")
    return ranks.reshape(tuple(shape))
