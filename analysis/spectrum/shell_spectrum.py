"""Radial power and anisotropy on exact shells, without the cube, in any dimension."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.analysis.precision import PrecisionName
from gbnbench.analysis.spectrum.ball_power import ball_power
from gbnbench.analysis.spectrum.bands import joined_shells, separate_bands
from gbnbench.analysis.spectrum.box_shells import equal_lengths
from gbnbench.analysis.spectrum.choice import choose
from gbnbench.analysis.spectrum.input_checks import check_weights
from gbnbench.analysis.spectrum.limits import check_harmonic, default_radius
from gbnbench.analysis.spectrum.listed_shells import default_shells, half_ball
from gbnbench.analysis.spectrum.request import Progress, check_band, shell_request
from gbnbench.analysis.spectrum.shell_moments import moments_of_list
from gbnbench.core.errors import InputError
from gbnbench.core.results.radial import ShellSpectrum
from gbnbench.core.sides import Sides, as_sides
from gbnbench.core.torus import FloatArray, as_realizations, spacing
from gbnbench.opencl import use_device


def shells(
    x: ArrayLike,
    fmax: int | None = None,
    precision: PrecisionName = "double",
    *,
    band: Sequence[float] | Sequence[Sequence[float]] | None = None,
    corners: bool = False,
    weights: ArrayLike | None = None,
    floor: float | None = None,
    progress: Progress | None = None,
    sides: ArrayLike | None = None,
    device: str | None = None,
) -> ShellSpectrum:
    """Mean and spread of power on every exact shell of |f|, and nothing else.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) array_like
        Points on the unit torus; power is averaged over realizations before it is reduced.
    fmax : int, optional
        Shells up to |f| = fmax, all of which the cube |f_a| <= fmax holds whole; by default as far as nu = 2,
        or as affordable (``default_shells``).
    precision : {"double", "float"}
        As in ``periodogram``.
    band : (low, high) or sequence of them, optional
        Only shells with low <= |f| <= high, cycles per unit length; of several bands, those of each.
    corners : bool
        Every frequency of the cube, up to |f| = sqrt(d) fmax, where shells are cut by its faces.
    weights : (n,) or (realizations, n) array_like, optional
        As in ``periodogram``.
    floor : float, optional
        Smallest power of a frequency that must be known to 1%; lets float be chosen where it does.
    progress : callable, optional
        Called now and then with the share done.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given. |f| is then the length of
        k_a = f_a / s_a, the volume being 1, and by default reaches as far as in ``gbnbench.measures``.
    device : str, optional
        The OpenCL device, as in ``periodogram``.

    Returns
    -------
    ShellSpectrum
        ``gbnbench.radial`` and ``gbnbench.analysis.radial.anisotropy`` make the same tables as of a cube.

    Raises
    ------
    InputError
        If x, fmax, band, weights or sides are not what they must be, the shells hold too many frequencies
        where (2*fmax+1)**d exceeds 2^63, or corners are asked for of a torus with unequal sides.
    DeviceError
        If the OpenCL device lacks the precision.

    Notes
    -----
    Only frequencies inside the ball or band are evaluated: at d = 10 and fmax = 3 these are the 2e5 with
    |f| <= 3, out of 2.8e8 in the cube. Memory does not grow with their number. Where the cube cannot even be
    counted, (2*fmax+1)**d > 2^63, the frequencies of the shells are listed and evaluated one by one. For
    unequal sides they are listed or evaluated as the box that holds them, whichever is cheaper, and kept in
    memory. Points are taken a million at a time, so that those of a large file may stay there:
    ``shells(numpy.load(FILE, mmap_mode="r"), band=[(1, 64), (3000, 3010)])``.

    Examples
    --------
    >>> import numpy as np
    >>> x = np.random.default_rng(0).random((256, 6))
    >>> shells(x, 2).count.tolist()
    [12, 60, 160, 252]
    """
    points = as_realizations(x)
    sets, n, d = points.shape
    w = check_weights(weights, sets, n)
    lengths = as_sides(sides, d)
    if lengths is not None and corners:
        raise InputError("corners are those of a cube; leave them out for a torus with unequal sides")
    bands = separate_bands(band)
    parts = []
    with use_device(device):
        for k, one in enumerate(bands):
            tell = None if progress is None else _part_of(progress, k, len(bands))
            if lengths is not None:
                parts.append(_of_box(points, fmax, one, lengths, w, precision, floor, tell))
            else:
                parts.append(_of_cube(points, fmax, one, corners, w, precision, floor, tell))
    return joined_shells(parts)


def _part_of(progress: Progress, k: int, count: int) -> Progress:
    """Tell the share done of one of several bands as that of all."""
    return lambda share: progress((k + share) / count)


def _of_cube(
    points: FloatArray,
    fmax: int | None,
    band: Sequence[float] | None,
    corners: bool,
    w: FloatArray | None,
    precision: PrecisionName,
    floor: float | None,
    progress: Progress | None,
) -> ShellSpectrum:
    """Evaluate the exact shells of |f| of a torus with equal sides."""
    sets, n, d = points.shape
    if fmax is None:
        fmax, band = default_shells(n, d) if band is None else (max(1, math.ceil(band[1])), band)
    request = shell_request(n, d, fmax, sets, band, corners)
    evaluator = choose(request, precision, floor)
    if request.what == "listed":
        square, frequencies = half_ball(d, request.high, request.low)
        power, errors = evaluator.listed(points, frequencies, w)
        moments = moments_of_list(power, square)
    else:
        moments, errors = evaluator.shells(points, request, w, progress)
    ran_on = evaluator.device
    errors = errors.averaged(sets, n)
    return ShellSpectrum(
        frequency=np.sqrt(moments.square.astype(np.float64)),
        nu=np.sqrt(moments.square.astype(np.float64)) * spacing(n, d),
        power=moments.mean,
        count=2 * moments.count,
        deviation=moments.deviation,
        n=n,
        d=d,
        realizations=sets,
        fmax=request.fmax,
        precision=evaluator.precision,
        method=evaluator.method,
        device=ran_on,
        error_rms=errors.rms,
        error_bound=errors.bound,
    )


def _of_box(
    points: FloatArray,
    fmax: int | None,
    band: Sequence[float] | None,
    sides: Sides,
    weights: FloatArray | None,
    precision: PrecisionName,
    floor: float | None,
    progress: Progress | None,
) -> ShellSpectrum:
    """Evaluate the exact shells of |k| of a torus with unequal sides."""
    sets, n, d = points.shape
    if fmax is None:
        fmax = default_radius(n, d, 1, sides) if band is None else max(1, math.ceil(band[1]))
    largest = check_harmonic(fmax, d)
    low, high = (0.0, float(largest)) if band is None else check_band(band, largest, largest)
    ball = ball_power(points, (low, high), sides, weights, precision, floor, progress)
    group, count = equal_lengths(ball.square)
    frequency = np.bincount(group, np.sqrt(ball.square)) / count
    mean = np.bincount(group, ball.power) / count
    deviation = np.bincount(group, (ball.power - mean[group]) ** 2).astype(np.float64, copy=False)
    errors = ball.errors.averaged(sets, n)
    return ShellSpectrum(
        frequency=frequency,
        nu=frequency * spacing(n, d),
        power=mean,
        count=2 * count,
        deviation=deviation,
        n=n,
        d=d,
        realizations=sets,
        fmax=largest,
        precision=ball.evaluator.precision,
        method=ball.evaluator.method,
        device=ball.evaluator.device,
        error_rms=errors.rms,
        error_bound=errors.bound,
        sides=sides,
    )
