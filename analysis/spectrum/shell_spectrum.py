"""Radial power and anisotropy on exact shells, without the cube, in any dimension."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.analysis.precision import PrecisionName
from gbnbench.analysis.spectrum.choice import choose
from gbnbench.analysis.spectrum.limits import default_shell_fmax
from gbnbench.analysis.spectrum.periodogram import check_weights
from gbnbench.analysis.spectrum.request import shell_request
from gbnbench.core.results.radial import ShellSpectrum
from gbnbench.core.torus import as_realizations, spacing
from gbnbench.opencl import use_device


def shells(
    x: ArrayLike,
    fmax: int | None = None,
    precision: PrecisionName = "double",
    *,
    band: Sequence[float] | None = None,
    corners: bool = False,
    weights: ArrayLike | None = None,
    floor: float | None = None,
    progress: Callable[[float], None] | None = None,
    device: str | None = None,
) -> ShellSpectrum:
    """Mean and spread of power on every exact shell of |f|, and nothing else.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) array_like
        Points on the unit torus; power is averaged over realizations before it is reduced.
    fmax : int, optional
        Shells up to |f| = fmax, all of which the cube |f_a| <= fmax holds whole; by default as far as nu = 2,
        or as affordable (``default_shell_fmax``).
    precision : {"double", "float"}
        As in ``periodogram``.
    band : (low, high), optional
        Only shells with low <= |f| <= high, cycles per unit length.
    corners : bool
        Every frequency of the cube, up to |f| = sqrt(d) fmax, where shells are cut by its faces.
    weights : (n,) or (realizations, n) array_like, optional
        As in ``periodogram``.
    floor : float, optional
        Smallest power of a frequency that must be known to 1%; lets float be chosen where it does.
    progress : callable, optional
        Called now and then with the share done.
    device : str, optional
        The OpenCL device, as in ``periodogram``.

    Returns
    -------
    ShellSpectrum
        ``gbnbench.radial`` and ``gbnbench.analysis.radial.anisotropy`` make the same tables as of a cube.

    Raises
    ------
    InputError
        If x, fmax, band or weights are not what they must be, or (2*fmax+1)**d exceeds 2^63.
    DeviceError
        If the OpenCL device lacks the precision.

    Notes
    -----
    Only frequencies inside the ball or band are evaluated: at d = 10 and fmax = 3 these are the 2e5 with
    |f| <= 3, out of 2.8e8 in the cube. Memory does not grow with their number.

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
    if fmax is None:
        fmax = default_shell_fmax(n, d) if band is None else max(1, math.ceil(band[1]))
    request = shell_request(n, d, fmax, sets, band, corners)
    with use_device(device):
        evaluator = choose(request, precision, floor)
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
