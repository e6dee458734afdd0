"""Power of a cube by the gridded FFT: spreading and power on the OpenCL device, the transform on the host."""

from __future__ import annotations

import numpy as np

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.error_model import Errors, coordinates
from gbnbench.analysis.spectrum.evaluators.gridded_fft.bands import dealt_to_bands
from gbnbench.analysis.spectrum.evaluators.gridded_fft.errors import fft_errors
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import (
    RealGrid,
    real_grid,
    transform_of_window,
    window_terms,
)
from gbnbench.analysis.spectrum.evaluators.gridded_fft.transform import harmonics
from gbnbench.analysis.spectrum.evaluators.two_group_product import norms_of
from gbnbench.core.torus import FloatArray

BATCH_BYTES = 16 << 20  # of the grids of a batch


def fft_powers(
    p: Precision,
    x: FloatArray,
    fmax: int,
    weights: FloatArray | None = None,
    half: bool = False,
    mean: bool = True,
) -> tuple[FloatArray, Errors]:
    sets, n, d = x.shape
    grid = real_grid(d, fmax, p.name)
    rt, threads = p.runtime, p.runtime.device.compute_units
    together = max(1, min(sets, BATCH_BYTES // (grid.size * grid.itemsize)))
    if together > threads:
        together = together // threads * threads
    norms = norms_of(weights, sets, n)
    base = 2 * fmax + 1
    shape = (fmax + 1 if half else base,) + (base,) * (d - 1)
    power = np.empty((1 if mean else sets, *shape), p.sum)
    out = rt.shared(power)
    gains = rt.upload((transform_of_window(grid) ** -2.0).astype(p.sum))
    over = rt.upload(norms.astype(p.sum))
    terms = rt.upload(window_terms(p.name).astype(p.real))
    nodes = np.empty((together, *grid.shape), p.real)
    grids = rt.shared(nodes)
    run = RUN
    part = rt.empty(nodes.nbytes if run < n else 4)
    spread = p.program("grid_spread.cl", AXES=d, WIDTH=grid.width, TERMS=len(window_terms(p.name)))
    finish = p.program("grid_power.cl", AXES=d)
    for first in range(0, sets, together):
        some = x[first : first + together]
        bands = dealt_to_bands(p, grid, some)
        weight, stride = _weights(p, weights, first, len(some), n, bands.order)
        spread.run(
            "grid_spread",
            (bands.count, len(some)),
            (1, 1),
            rt.upload(bands.turns),
            np.uint32(n),
            rt.upload(weight),
            np.uint32(stride),
            rt.upload(bands.starts),
            np.uint32(bands.count),
            np.uint32(run),
            np.uint32(grid.nodes),
            np.uint32(bands.rows),
            np.uint32(grid.row_length),
            terms,
            grids,
            part,
            np.uint64(grid.size),
        )
        rt.finish()
        transformed = np.ascontiguousarray(harmonics(grid, nodes[: len(some)], threads))
        finish.run(
            "grid_power",
            (fmax + 1 if d == 1 else base,),
            (1,),
            rt.shared(transformed),
            np.uint64(transformed[0].size * 2),
            np.uint32(transformed.shape[-1]),
            np.uint32(grid.nodes),
            np.uint32(base),
            np.int32(fmax),
            np.uint32(len(some)),
            over,
            np.uint32(first),
            gains,
            np.uint32(half),
            out,
            np.uint64(0 if mean else power[0].size),
        )
        rt.finish()
    if mean and sets > 1:
        power /= sets
    return (power[0] if mean else power), fft_errors(p, grid, n, coordinates(x, p.name, weights))


RUN = 1 << 30


def _weights(p, weights, first, count, n, order):
    if weights is None:
        return np.ones(n, p.real), 0
    if order is None:
        return (weights if len(weights) == 1 else weights[first : first + count]).astype(p.real), 0 if len(weights) == 1 else n
    dealt = np.broadcast_to(weights if len(weights) == 1 else weights[first : first + count], (count, n))
    return np.take_along_axis(dealt, order, axis=1).astype(p.real), n
