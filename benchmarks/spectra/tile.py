"""Rate of the tile of the product beside the multiply-add peak: its kernel alone, on ready tables."""

from __future__ import annotations

import time

import numpy as np

from gbnbench.analysis.precision import precision_of
from gbnbench.analysis.spectrum.digits import cheapest_division
from gbnbench.analysis.spectrum.evaluators.frequency_group import Group
from gbnbench.analysis.spectrum.evaluators.point_slots import tile_columns, tile_rows
from gbnbench.analysis.spectrum.evaluators.two_group_product import TwoGroupProduct
from gbnbench.opencl.peak_rate import fma_peak

N, D, F, SETS = 1024, 2, 64, 16
CALLS, ROUNDS = 16, 12


def tile_share(precision: str) -> tuple[float, float]:
    """Measure the tile and the peak in turn, so that both meet the same machine.

    Returns
    -------
    tile, peak : float
        Useful flops a second of one core, by CPU time; the best of each.
    """
    p = precision_of(precision)
    divided = cheapest_division(D, F, tile_rows(p), tile_columns(p))
    product = TwoGroupProduct(p, N, D, SETS, Group(divided.leading), Group(divided.trailing))
    x = np.random.default_rng(0).random((SETS, N, D))
    count = 0
    for _, count in product.batches(x):  # noqa: B007 - the last batch's tables are left on the device
        pass
    if product.slots.items:  # slots that have no tables of their own are left out
        count = min(count, product.slots.items // product.slots.splits)
    a, b = product.frequencies.a.count, product.frequencies.b.count
    flops = 8.0 * a * b * min(N, product.slots.length * product.slots.splits) * count
    best, peak = np.inf, 0.0
    for _ in range(ROUNDS):
        p.runtime.finish()
        began = time.process_time()
        for _ in range(CALLS):
            product.multiply(count)
        p.runtime.finish()
        best = min(best, (time.process_time() - began) / CALLS)
        peak = max(peak, fma_peak(precision))
    return flops / best, peak
