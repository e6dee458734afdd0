"""Amplitudes of a large set as sums over blocks of its points, in memory that does not grow with the set.

Sums over points are linear: those of the blocks add up to those of the set. They are added with the rounding
kept, so that the error is that of a block, relative to all points, and a few roundings more.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.coordinate_rounding import Coordinates
from gbnbench.analysis.spectrum.error_model import UNIT, Errors
from gbnbench.analysis.spectrum.evaluators.frequency_group import Group
from gbnbench.analysis.spectrum.evaluators.two_group_product import TwoGroupProduct, product_errors
from gbnbench.core.double_double import two_sum
from gbnbench.core.torus import FloatArray

POINTS = 1 << 20  # of a block
MERGED = 4  # roundings of the sum over blocks: its two parts', and those of their sum and of the kernel's


class BlockedSum:
    """A sum of arrays, one after another, with the rounding kept."""

    def __init__(self) -> None:
        self._total: FloatArray | float = 0.0
        self._rest: FloatArray | float = 0.0

    def add(self, part: FloatArray) -> None:
        """Add an array of the same shape as those before.

        Parameters
        ----------
        part : (...) float64
            What is added; where it is not finite, as in memory that nothing wrote, the sum is not either.
        """
        with np.errstate(invalid="ignore", over="ignore"):
            self._total, rest = two_sum(self._total, part)
            self._rest = self._rest + rest

    @property
    def value(self) -> FloatArray:
        """The sum so far."""
        with np.errstate(invalid="ignore", over="ignore"):
            return np.asarray(self._total + self._rest)


def point_blocks(x: FloatArray, weights: FloatArray | None) -> Iterator[tuple[FloatArray, FloatArray | None]]:
    """Cut a set in blocks of ``POINTS`` points, the last of which is filled up by points without weight.

    Parameters
    ----------
    x : (n, d) float64
        Points, n > POINTS; may be mapped from a file.
    weights : (n,) float64 or None
        Their weights.

    Yields
    ------
    x : (1, POINTS, d) float64
    weights : (1, POINTS) float64 or None
    """
    n, d = x.shape
    for begin in range(0, n, POINTS):
        block = x[begin : begin + POINTS]
        own = None if weights is None else weights[begin : begin + POINTS]
        lacking = POINTS - len(block)
        if lacking:
            own = np.concatenate([np.ones(len(block)) if own is None else own, np.zeros(lacking)])
            block = np.concatenate([block, np.zeros((lacking, d))])
        yield block[None], None if own is None else own[None]


class BlockedProduct:
    """The two-group product of sets of more than ``POINTS`` points, block by block.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    n, d : int
        Points of a set, and dimension.
    a, b : Group
        Leading and trailing group of frequencies.
    bounds : (row tiles, 2) uint32
        As ``TwoGroupProduct`` takes them.

    Attributes
    ----------
    product : TwoGroupProduct
        Of one block.
    """

    def __init__(self, p: Precision, n: int, d: int, a: Group, b: Group, bounds: NDArray[np.uint32]) -> None:
        self._p, self._blocks = p, -(-n // POINTS)
        self.product = TwoGroupProduct(p, POINTS, d, 1, a, b, bounds)

    def amplitude(self, x: FloatArray, weights: FloatArray | None, progress: Callable[[float], None]) -> Any:
        """Evaluate the amplitudes of one set.

        Parameters
        ----------
        x : (n, d) float64
            Points.
        weights : (n,) float64 or None
            Their weights.
        progress : callable
            Called with the share of the points that are done.

        Returns
        -------
        buffer
            As ``TwoGroupProduct.amplitude`` with one slot.
        """
        product, total = self.product, BlockedSum()
        shape = (product.slots.count, product.amplitude_numbers // product.slots.count)
        for k, (block, own) in enumerate(point_blocks(x, weights)):
            for _ in product.batches(block, own):
                found = self._p.runtime.download(product.amplitude, np.empty(shape, self._p.sum))
                for of_slot in found:
                    total.add(of_slot.astype(np.float64, copy=False))
            progress((k + 1) / self._blocks)
        return self._p.runtime.upload(total.value.astype(self._p.sum))

    def errors(self, fmax: int, at: Coordinates) -> Errors:
        """State the errors of sqrt(power).

        Parameters
        ----------
        fmax : int
            Largest harmonic on an axis.
        at : Coordinates
            Rounding of the coordinates of the whole set.

        Returns
        -------
        Errors
        """
        return merged_errors(self._p, product_errors(self._p, POINTS, self.product.slots, fmax, at), at)


def amplitudes_of_sets(
    p: Precision,
    x: FloatArray,
    weights: FloatArray | None,
    groups: tuple[Group, Group],
    bounds: NDArray[np.uint32],
    fmax: int,
    at: Coordinates,
    progress: Callable[[float], None],
) -> Iterator[tuple[TwoGroupProduct, Any, int, int, int, Errors]]:
    """Evaluate the amplitudes of two groups' frequencies, one batch of sets after another, or one large set.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    x : (sets, n, d) float64
        Checked points.
    weights : (sets or 1, n) float64 or None
        Their weights.
    groups : (Group, Group)
        Leading and trailing group of frequencies.
    bounds : (row tiles, 2) uint32
        As ``TwoGroupProduct`` takes them.
    fmax : int
        Largest harmonic on an axis.
    at : Coordinates
        Rounding of the coordinates.
    progress : callable
        Called with the share done, of large sets.

    Yields
    ------
    product : TwoGroupProduct
        Whose kernels read the amplitudes.
    amplitude : buffer
        Amplitudes of the batch.
    splits, first, count : int
        Slots of a set in it, the first set, and number of sets.
    errors : Errors
        Of sqrt(power).
    """
    sets, n, d = x.shape
    if n > POINTS:
        blocked = BlockedProduct(p, n, d, *groups, bounds)
        for k in range(sets):
            own = None if weights is None else weights[k if len(weights) > 1 else 0]
            amplitude = blocked.amplitude(x[k], own, lambda share, k=k: progress((k + share) / sets))  # type: ignore[misc]
            yield blocked.product, amplitude, 1, k, 1, blocked.errors(fmax, at)
        return
    product = TwoGroupProduct(p, n, d, sets, *groups, bounds)
    errors = product_errors(p, n, product.slots, fmax, at)
    for first, batch in product.batches(x, weights):
        yield product, product.amplitude, product.slots.splits, first, batch, errors


def merged_errors(p: Precision, of_block: Errors, at: Coordinates) -> Errors:
    """State the errors of sums over blocks.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    of_block : Errors
        Of the sum over a block, relative to the whole set.
    at : Coordinates
        Rounding of the coordinates of the whole set.

    Returns
    -------
    Errors
    """
    unit = UNIT["double" if p.sum is np.float64 else "float"]
    bound = of_block.bound + 2 * math.sqrt(2.0) * MERGED * unit * at.share
    return Errors(of_block.rms, min(bound, 1.001 * at.share))
