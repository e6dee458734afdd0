"""``gbnbench.reconstruct``: the picture, or the volume, that points draw."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.analysis.reconstruction.density_estimates import ESTIMATES, Estimate, reconstructed_density
from gbnbench.analysis.reconstruction.shaping import LEAST
from gbnbench.api.stippling import Stippling
from gbnbench.core.errors import InputError
from gbnbench.core.flags import check_flags
from gbnbench.core.settings import nearest
from gbnbench.core.torus import FloatArray
from gbnbench.opencl import use_device
from gbnbench.studies.stippling.tones import tones
from gbnbench.studies.stippling.units import checked_shape, in_pixels

SIDES = {2: 512, 3: 64}  # of a picture or a volume whose shape is not given


def reconstruct(
    points: ArrayLike | Stippling,
    amplitudes: ArrayLike | None = None,
    shape: tuple[int, ...] | None = None,
    *,
    method: Estimate = "shaping",
    invert: bool = False,
    coverage: float | None = None,
    sigma: float | None = None,
    progress: Callable[[int, int, str], None] | None = None,
    device: str | None = None,
) -> FloatArray:
    """Find the picture that points draw, dense being dark: from anybody's stippling, by the points alone.

    Parameters
    ----------
    points : Stippling, or (n, 2) or (n, 3) array_like
        What ``gbnbench.stipple`` returned: its points, and unless others are given its amplitudes, shape and
        coverage. Or points by anybody, in the unit square, 0 to 1: x to the right, y up (and z along the
        slices of a volume), each axis divided by its own count of pixels.
    amplitudes : (n,) array_like, optional
        Above 0, in any scale: how dense the points are around each. By default Algorithm 2 finds them.
    shape : tuple of int, optional
        Pixels of the result, (rows, columns) or (slices, rows, columns), whose ratio is that of the picture's
        sides. By default 512 x 512, or 64 x 64 x 64.
    method : {"shaping", "kernel", "voronoi"}
        Kernels as wide as the amplitudes say; kernels of one width; or one over the area of each point's
        Voronoi cell, for comparison.
    invert : bool
        Dense is light, as where white ink was used on black.
    coverage : float, optional
        Mean darkness of the picture, above 0 and at most 1, which points do not tell; a ``Stippling`` has it.
        It holds before what exceeds black is cut to it. By default as dense as one point in a hundred lies,
        or denser, is black.
    sigma : float, optional
        Width of kernels in spacings of a uniform set: by default 0.5, of kernels of one width 0.6 (in volumes
        0.7).
    progress : callable, optional
        Called with (steps done, steps in all, what is being done).
    device : str, optional
        Part of the name of the OpenCL device, or its position, as in ``GBNBENCH_DEVICE``.

    Returns
    -------
    ``shape`` float64
        Tones, 0 black to 1 white, rows from the top.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    DeviceError
        If a device is named and fits none or several.

    Notes
    -----
    Algorithm 2 of Ahmed, Ren & Wonka, "Gaussian blue noise", 2022, in 10 iterations, points mirrored at the
    borders. The kernel of x_k is a_k exp(-a_k^(2/d) r^2 / (2 sigma^2)), averaged over each pixel. Amplitudes
    that are given are scaled to mean 1.

    Examples
    --------
    >>> import gbnbench
    >>> made = gbnbench.stipple("camera", 500, method="gbn[gradients=10]")
    >>> gbnbench.reconstruct(made).shape, gbnbench.reconstruct(made.points, shape=(128, 128)).shape
    ((512, 512), (128, 128))
    """
    check_flags(invert=invert)
    if isinstance(points, Stippling):
        coverage = points.coverage if coverage is None else coverage
        shape = points.density.shape if shape is None else shape
        if amplitudes is None and method == "shaping":
            amplitudes = points.amplitudes
        points = points.points
    density = density_of_points(
        points, amplitudes, shape, method=method, sigma=sigma, progress=progress, device=device
    )
    return tones(density, coverage=coverage, invert=invert)


def density_of_points(
    points: ArrayLike,
    amplitudes: ArrayLike | None = None,
    shape: tuple[int, ...] | None = None,
    *,
    method: Estimate = "shaping",
    sigma: float | None = None,
    progress: Callable[[int, int, str], None] | None = None,
    device: str | None = None,
) -> FloatArray:
    """Find the density that points have.

    Parameters
    ----------
    points, amplitudes, shape, method, sigma, progress, device
        As ``reconstruct`` takes them.

    Returns
    -------
    ``shape`` float64
        Points a pixel, rows from the top.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    """
    x = _points(points)
    n, d = x.shape
    if method not in ESTIMATES:
        known = ", ".join(ESTIMATES)
        raise InputError(f"method must be one of {known}; got {method!r}{nearest(str(method), ESTIMATES)}")
    sides = (SIDES[d],) * d if shape is None else checked_shape(shape, (d,))
    given = None if amplitudes is None else _amplitudes(amplitudes, n, method)
    if sigma is not None and not (0 < sigma < math.inf and method != "voronoi"):
        raise InputError(f"sigma must be above 0, and is of kernels; got {sigma} for method {method!r}")
    with use_device(device):
        return reconstructed_density(
            np.ascontiguousarray(in_pixels(x, sides[::-1])[:, ::-1]), sides,
            estimate=method, sigma=sigma, amplitudes=given, told=progress,
        )  # fmt: skip


def _points(points: ArrayLike) -> FloatArray:
    try:
        x = np.asarray(points, np.float64)
    except (TypeError, ValueError):
        raise InputError("points must be an array (n, 2) or (n, 3) of real numbers") from None
    if not x.size:
        raise InputError("points holds no point: a picture needs at least one")
    if x.ndim != 2 or x.shape[1] not in SIDES:
        raise InputError(
            f"points must be (n, 2) of a picture or (n, 3) of a volume; got an array of shape {x.shape}"
        )
    outside = ~((x >= 0) & (x <= 1))
    if outside.any():
        row, column = (int(i) for i in np.argwhere(outside)[0])
        raise InputError(
            f"points must lie in the unit square, 0 to 1; coordinate {column} of point {row} is "
            f"{float(x[row, column])!r}: divide pixels by the picture's size, with y from the lower border"
        )
    return x


def _amplitudes(amplitudes: ArrayLike, n: int, method: Estimate) -> FloatArray:
    a = np.asarray(amplitudes, np.float64)
    if method != "shaping":
        raise InputError(f"amplitudes go with method 'shaping'; {method!r} has no use for them")
    if a.shape != (n,):
        raise InputError(f"amplitudes must be one number a point, ({n},); got an array of shape {a.shape}")
    if not (a > 0).all() or not np.isfinite(a).all():
        raise InputError("amplitudes must be finite numbers above 0")
    scaled: FloatArray = np.maximum(a / a.mean(), LEAST)
    return scaled
