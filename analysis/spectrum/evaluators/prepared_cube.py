"""All that the product of a cube needs besides the points, prepared once for requests that are alike."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import Any

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.coordinate_rounding import NOT_ROUNDED, Coordinates
from gbnbench.analysis.spectrum.digits import Harmonics, cheapest_division, half_size
from gbnbench.analysis.spectrum.evaluators.cube_writer import CubeWriter
from gbnbench.analysis.spectrum.evaluators.frequency_group import Group
from gbnbench.analysis.spectrum.evaluators.point_slots import Slots, tile_columns, tile_rows
from gbnbench.analysis.spectrum.evaluators.row_runs import most_rows, row_blocks
from gbnbench.analysis.spectrum.evaluators.small_cube import SmallCube, is_small
from gbnbench.analysis.spectrum.evaluators.two_group_product import TwoGroupProduct, norms_of
from gbnbench.core.torus import FloatArray


class PreparedCube:
    """The division of a cube's axes, the products of its groups, and the cube on the device.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    n, d, sets : int
        Points of a set, dimension, and number of sets.
    fmax : int or tuple of d ints
        Largest harmonic on each axis.
    half, mean : bool
        As in ``cube_product.cube_powers``.

    Attributes
    ----------
    writer : CubeWriter
        The cube of power on the device.
    """

    def __init__(
        self, p: Precision, n: int, d: int, sets: int, fmax: Harmonics, half: bool, mean: bool
    ) -> None:
        self._p, self._n, self._d, self._sets = p, n, d, sets
        self._divided = cheapest_division(d, fmax, tile_rows(p), tile_columns(p))
        self.writer = CubeWriter(p, self._divided, fmax, sets, d, half=half, mean=mean)
        whole = half_size(self._divided.leading) <= most_rows(p, self._divided, n)
        self._whole = self._product(Group(self._divided.leading)) if whole else None
        small = self._whole is not None and is_small(self._whole, sets)
        self._rounded = NOT_ROUNDED
        self._small = SmallCube(self._whole, self.writer) if self._whole is not None and small else None

    @property
    def nbytes(self) -> int:
        """Bytes on the device."""
        return self.writer.nbytes + (0 if self._whole is None else self._whole.nbytes)

    def fill(self, x: FloatArray, weights: FloatArray | None) -> list[Slots]:
        """Evaluate the cube, and leave it on the device.

        Parameters
        ----------
        x : (sets, n, d) float64
            Points.
        weights : (sets or 1, n) float64 or None
            Weights of the points.

        Returns
        -------
        list of Slots
            Those of each run of leading frequencies.
        """
        norms = self._counts if weights is None else self._upload_norms(weights)
        if self._small is not None:
            self._small(x, weights, norms)
            return [self._small.product.slots]
        used, self._rounded = [], NOT_ROUNDED
        for first_row, rows, product in self._products():
            for first, count in product.batches(x, weights):
                self.writer.add(
                    *(product.program, product.amplitude, product.slots.splits, norms),
                    *(first, count, first_row, rows),
                    zero_last=product.frequencies.zero_last,
                )
            used.append(product.slots)
            self._rounded = self._rounded.or_larger(product.rounded)
        return used

    def coordinates(self) -> Coordinates:
        """Tell how far the coordinates of the last sets were rounded, once the cube was downloaded.

        Returns
        -------
        Coordinates
            For the worst of the sets, which had no weights.
        """
        return self._rounded if self._small is None else self._small.product.turns.coordinates(self._sets)

    def _products(self) -> Iterator[tuple[int, int, TwoGroupProduct]]:
        """Give the first frequency and the length of each run of leading frequencies, with its product."""
        if self._whole is not None:
            yield 0, half_size(self._divided.leading), self._whole
            return
        for first_row, group in row_blocks(self._p, self._divided, self._n):
            yield first_row, group.count, self._product(group)

    def _product(self, leading: Group) -> TwoGroupProduct:
        return TwoGroupProduct(self._p, self._n, self._d, self._sets, leading, Group(self._divided.trailing))

    @cached_property
    def _counts(self) -> Any:
        return self._upload_norms(None)

    def _upload_norms(self, weights: FloatArray | None) -> Any:
        return self._p.runtime.upload(norms_of(weights, self._sets, self._n).astype(self._p.sum))
