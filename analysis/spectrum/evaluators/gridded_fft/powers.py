"""Power of a cube by the gridded FFT: points are carried to grids, which are transformed.

F(f) is the transform of the grid over the product of the window's transforms (kaiser_bessel.py). Points have
real strengths, so the grid is real, and half of its transform is enough. In double the error of the window is
less than rounding, and cells and places are exact, so that no digit is lost.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.error_model import Errors, coordinates
from gbnbench.analysis.spectrum.evaluators.gridded_fft.bands import (
    Bands,
    BinnedPoints,
    binned,
    dealt_to_bands,
)
from gbnbench.analysis.spectrum.evaluators.gridded_fft.errors import fft_errors
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import RealGrid, real_grid, transform_of_window
from gbnbench.analysis.spectrum.evaluators.gridded_fft.workspace import Workspace, workspace
from gbnbench.analysis.spectrum.evaluators.two_group_product import norms_of
from gbnbench.core.torus import FloatArray

BATCH_BYTES = 4 << 20  # of the grids of a batch


def fft_powers(
    p: Precision,
    x: FloatArray,
    fmax: int,
    weights: FloatArray | None = None,
    half: bool = False,
    mean: bool = True,
    points: BinnedPoints | None = None,
) -> tuple[FloatArray, Errors]:
    """Evaluate the power at all frequencies with |f_a| <= fmax.

    Parameters and returns are those of ``cube_product.cube_powers``; the device is a CPU, and d at most 3.
    ``points`` are the same points with their bins, where those are known.
    """
    sets, n, d = x.shape
    grid, base, rt = real_grid(d, fmax, p.name), 2 * fmax + 1, p.runtime
    together = sets_together(p, grid, sets)
    work = workspace(p, grid, together)
    power = np.empty((1 if mean else sets, fmax + 1 if half else base, *(base,) * (d - 1)), p.sum)
    norms = norms_of(weights, sets, n)
    out, over = rt.shared(power), rt.upload((1 / norms).astype(p.sum))
    at, errors = coordinates(x, p.name, weights), Errors(0.0, 0.0)
    for first in range(0, sets, together):
        end = min(first + together, sets)
        some = binned(p, grid, x[first:end]) if points is None else points[first:end]
        bands = dealt_to_bands(p, grid, some)
        errors = errors.or_larger(fft_errors(p, grid, n, bands.crowd, bands.runs, at))
        weight = None if weights is None or len(weights) == 1 else weights[first:end]
        spread(p, grid, work, bands, weights if weight is None else weight)
        work.transform.write_powers(
            work.grids, end - first, over, first, half, out, 0 if mean else power[0].size
        )
        rt.finish()
    total = norms if weights is None else np.broadcast_to(weights.sum(axis=1), (sets,)) ** 2 / norms
    centre = (slice(None), 0 if half else fmax, *(fmax,) * (d - 1))
    power[centre] = total.sum() if mean else total  # DC is known, and its error would be coherent
    if mean and sets > 1:
        power /= sets
    found = np.asarray(power, np.float64)
    return (found[0] if mean else found), errors


def spread(p: Precision, grid: RealGrid, work: Workspace, bands: Bands, weights: FloatArray | None) -> None:
    """Carry the points of a batch to their grids.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    grid : RealGrid
        Layout of a grid.
    work : Workspace
        The grids, which are written, and the kernels.
    bands : Bands
        The points.
    weights : (sets or 1, n) float64 or None
        Weights of the points, in the order before they were dealt to bands.
    """
    sets, _, n = bands.turns.shape
    rt = p.runtime
    mean = transform_of_window(grid)[0] ** grid.d / grid.nodes**grid.d / bands.runs
    means = np.broadcast_to(mean * (n if weights is None else weights.sum(axis=1)), (sets,))
    weight, stride = _in_order(p, weights, bands.order, sets, n)
    work.program.run(
        "grid_spread",
        (bands.count, sets),
        (1, 1),
        rt.upload(bands.turns),
        np.uint32(n),
        rt.upload(weight),
        np.uint32(stride),
        rt.upload(bands.starts),
        np.uint32(bands.count),
        np.uint32(bands.runs),
        rt.upload(means.astype(p.real)),
        np.uint32(grid.nodes),
        np.uint32(bands.rows),
        np.uint32(grid.row_length),
        work.terms,
        work.grids,
        work.parts if bands.runs > 1 else work.grids,
        np.uint64(grid.size),
    )


def _in_order(
    p: Precision, weights: FloatArray | None, order: NDArray[np.intp] | None, sets: int, n: int
) -> tuple[NDArray[Any], int]:
    """Bring weights in the order of the points; the numbers from one set's to the next set's, 0 if shared."""
    if weights is None:
        return np.ones(n, p.real), 0
    if order is not None:
        return np.take_along_axis(np.broadcast_to(weights, (sets, n)), order, axis=1).astype(p.real), n
    return weights.astype(p.real), 0 if len(weights) == 1 else n


def sets_together(p: Precision, grid: RealGrid, sets: int) -> int:
    """Count the sets of a batch: as many as their grids fit in the cache, and a multiple of the cores.

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
    fitting = max(1, min(sets, BATCH_BYTES // (grid.size * grid.itemsize)))
    return fitting if fitting < cores else fitting // cores * cores
