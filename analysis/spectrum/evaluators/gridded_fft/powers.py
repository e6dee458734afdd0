"""Power of a cube by the gridded FFT: points are carried to grids, which are transformed.

F(f) is the transform of the grid over the product of the window's transforms (kaiser_bessel.py). Points have
real strengths, so the grid is real, and half of its transform is enough. In double the error of the window is
less than rounding, and cells and places are exact, so that no digit is lost.
"""

from __future__ import annotations

import math
from functools import lru_cache, partial
from typing import Any

import numpy as np

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.coordinate_rounding import coordinates
from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.gridded_fft.bands import division
from gbnbench.analysis.spectrum.evaluators.gridded_fft.dealt_points import DealtPoints
from gbnbench.analysis.spectrum.evaluators.gridded_fft.errors import fft_errors, most_crowd, too_crowded
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import RealGrid, real_grid
from gbnbench.analysis.spectrum.evaluators.gridded_fft.plane_transform import plane_serves, transform_numbers
from gbnbench.analysis.spectrum.evaluators.gridded_fft.transform_choice import transform_for
from gbnbench.analysis.spectrum.evaluators.kept_memory import kept
from gbnbench.analysis.spectrum.evaluators.two_group_product import norms_of
from gbnbench.core.torus import FloatArray

BATCH_BYTES = 4 << 20  # of the grids of a batch, or of their transformed rows in the plane


class TooCrowdedError(Exception):
    """Points share bins of the grid more than by chance, and errors would be larger than what is allowed."""


def fft_powers(
    p: Precision,
    x: FloatArray,
    fmax: int,
    weights: FloatArray | None = None,
    half: bool = False,
    mean: bool = True,
    allowed: float = math.inf,
) -> tuple[FloatArray, Errors]:
    """Evaluate the power at all frequencies with |f_a| <= fmax.

    Parameters and returns are those of ``cube_product.cube_powers``; the device is a CPU, and d at most 3.
    ``TooCrowdedError`` is raised where points are crowded and the typical error of sqrt(power) would be
    larger than ``allowed``.
    """
    sets, n, d = x.shape
    grid, base, rt = real_grid(d, fmax, p.name), 2 * fmax + 1, p.runtime
    together = sets_together(p, grid, sets)
    power = np.empty((1 if mean else sets, fmax + 1 if half else base, *(base,) * (d - 1)), p.sum)
    norms, over = _of_equal_points(p, sets, n) if weights is None else _norms(p, weights, sets, n)
    out = rt.shared(power)
    errors, most = Errors(0.0, 0.0), most_crowd(p, grid, n, allowed)
    rounded = None if weights is None else coordinates(x, p.name, weights)
    for first in range(0, sets, together):
        end = min(first + together, sets)
        bands, rows = division(rt.device.compute_units, grid, end - first, n)
        points = kept(DealtPoints, p, grid, together, n, bands, rows)
        transform = transform_for(p, grid, together, rows)
        reals = rt.readable(x[first:end])  # it lives until kernels have read it
        weight = weights if weights is None or len(weights) == 1 else weights[first:end]
        points(reals, weight, end - first, most)
        write = partial(transform.write_powers, points, over, first, half, out, 0 if mean else power[0].size)
        if not transform.needs_runs:
            write()
        rt.finish()
        crowds = points.crowds()
        if any(too_crowded(p, grid, n, crowd, runs, allowed) for crowd, runs in crowds):
            raise TooCrowdedError
        if transform.needs_runs:
            write()
            rt.finish()
        at = points.coordinates() if rounded is None else rounded
        for crowd, runs in crowds:
            errors = errors.or_larger(fft_errors(p, grid, n, crowd, runs, at))
    total = norms if weights is None else np.broadcast_to(weights.sum(axis=1), (sets,)) ** 2 / norms
    centre = (slice(None), 0 if half else fmax, *(fmax,) * (d - 1))
    power[centre] = total.sum() if mean else total  # DC is known, and its error would be coherent
    if mean and sets > 1:
        power /= sets
    found = np.asarray(power, np.float64)
    return (found[0] if mean else found), errors


def _norms(p: Precision, weights: FloatArray | None, sets: int, n: int) -> tuple[FloatArray, Any]:
    """Norms of the sets, and one over them on the device."""
    norms = norms_of(weights, sets, n)
    return norms, p.runtime.upload((1 / norms).astype(p.sum))


@lru_cache(maxsize=64)
def _of_equal_points(p: Precision, sets: int, n: int) -> tuple[FloatArray, Any]:
    """Norms of sets of weight 1, which are only read."""
    return _norms(p, None, sets, n)


def sets_together(p: Precision, grid: RealGrid, sets: int) -> int:
    """Count the sets of a batch: as many as fit in the cache, and a multiple of the cores.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    grid : RealGrid
        Layout of a grid.
    sets : int
        Sets in all.

    Returns
    -------
    int
    """
    cores = p.runtime.device.compute_units
    numbers = transform_numbers(grid) if plane_serves(p, grid) else grid.size
    fitting = max(1, min(sets, BATCH_BYTES // (numbers * grid.itemsize)))
    return fitting if fitting < cores else fitting // cores * cores
