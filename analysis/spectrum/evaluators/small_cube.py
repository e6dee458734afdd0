"""Power of a cube that is so small that launches take longer than its arithmetic: all of it in one launch."""

from __future__ import annotations

from typing import Any

import numpy as np

from gbnbench.analysis.spectrum.digits import multiplied_columns
from gbnbench.analysis.spectrum.evaluators.cube_writer import CubeWriter
from gbnbench.analysis.spectrum.evaluators.point_slots import tile_columns
from gbnbench.analysis.spectrum.evaluators.two_group_product import TwoGroupProduct
from gbnbench.analysis.spectrum.evaluators.work_model import ENTRY, TILE
from gbnbench.core.torus import FloatArray
from gbnbench.opencl import Launch

MOST_WORK = 1e6  # multiply-adds of all sets, some 20 us of a core, up to which one work-item does them


class SmallCube:
    """One launch that does what the launches of a product and of a cube's writer do, to the last bit.

    Parameters
    ----------
    product : TwoGroupProduct
        The product of the whole groups, on a CPU; its tables and amplitudes are used.
    writer : CubeWriter
        The cube, which is written.
    """

    def __init__(self, product: TwoGroupProduct, writer: CubeWriter) -> None:
        self.product, self._writer = product, writer
        self._launches: dict[int, Launch] = {}

    def __call__(self, x: FloatArray, weights: FloatArray | None, norms: Any) -> None:
        """Enqueue the launch.

        Parameters
        ----------
        x : (sets, n, d) float64
            Points.
        weights : (sets or 1, n) float64 or None
            Weights of the points.
        norms : buffer
            Numbers by which the squared amplitudes of each set are divided.
        """
        product = self.product
        self._points = product.p.runtime.readable(x)  # it lives until the kernel has read it
        weight, stride = (given := product.with_weights(weights)).weight, given.weight_stride
        if stride not in self._launches:
            self._launches[stride] = self._launch(len(x), x.shape[2], stride)
        self._launches[stride](self._points, weight, norms)

    def _launch(self, sets: int, d: int, weight_stride: int) -> Launch:
        product, writer = self.product, self._writer
        tables, slots = product.frequencies, product.slots
        return product.program.prepared(
            "small_cube",
            (1,),
            (1,),
            *(None, None, None),  # points, weights and norms, which each call gives
            np.uint32(product.n),
            product.turns.buffer,
            product.turns.lost,
            np.uint32(product.stride),
            np.uint32(d),
            np.uint32(weight_stride),
            *tables.layout,
            *product.tables,
            np.uint32(slots.length),
            np.uint32(slots.pitch),
            np.uint32(slots.splits),
            np.uint32(slots.launches(product.n)),
            tables.all_columns,
            np.uint32(sets),
            np.uint32(tables.a.count),
            np.uint32(tables.b.count),
            np.uint32(tables.zero_last),
            product.amplitude,
            writer.gains,
            writer.out,
            np.uint64(writer.start),
            np.uint64(writer.set_size),
        )


def is_small(product: TwoGroupProduct, sets: int) -> bool:
    """Tell whether one work-item of a CPU shall do all of a product.

    Parameters
    ----------
    product : TwoGroupProduct
        The product of whole groups.
    sets : int
        Sets in all.

    Returns
    -------
    bool
        True where its sets take one batch, and the work is little.
    """
    tables, slots = product.frequencies, product.slots
    a, b = tables.tiles * tables.rows, multiplied_columns(tables.b.count, tile_columns(product.p))
    work = sets * product.n * (TILE * a * b + ENTRY * (a + b))
    return product.p.runtime.device.is_cpu and slots.sets >= sets and work <= MOST_WORK
