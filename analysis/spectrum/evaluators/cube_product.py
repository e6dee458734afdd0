"""Power of a cube of frequencies, or of its half with f_0 >= 0, by the exact two-group product."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from gbnbench.analysis.precision import Precision, padded
from gbnbench.analysis.spectrum.digits import Division, cheapest_division, half_size, size
from gbnbench.analysis.spectrum.error_model import Errors, coordinates, rounded_at_worst
from gbnbench.analysis.spectrum.evaluators.frequency_tables import Group
from gbnbench.analysis.spectrum.evaluators.point_slots import (
    AMPLITUDE_BYTES,
    TABLE_BYTES,
    Slots,
    choose_slots,
    tile_rows,
)
from gbnbench.analysis.spectrum.evaluators.protocol import DeviceEvaluator, EvaluationCost
from gbnbench.analysis.spectrum.evaluators.two_group_product import TwoGroupProduct, norms_of, product_errors
from gbnbench.analysis.spectrum.evaluators.work_model import ENTRY, TILE, WRITTEN, device_cost
from gbnbench.analysis.spectrum.request import Frequencies, SpectrumRequest
from gbnbench.core.torus import FloatArray
from gbnbench.opencl import Program

GPU_COLUMNS = 64  # frequencies of a row that one work-item of a GPU turns into power


@dataclass(frozen=True)
class CubeProduct(DeviceEvaluator):
    """The two-group product on the OpenCL device, for cubes and half cubes in any dimension."""

    method: ClassVar[str] = "product"
    title: ClassVar[str] = "two-group product"
    serves: ClassVar[tuple[Frequencies, ...]] = ("cube", "half cube")

    def work(self, request: SpectrumRequest) -> float:
        """Count the pairs of frequencies, the tables and the powers that are written."""
        p, n, d, f = self.on_device, request.n, request.d, request.fmax
        divided = cheapest_division(d, f, tile_rows(p))
        a, b = half_size(divided.leading), half_size(divided.trailing)
        each = (TILE * padded(a, tile_rows(p)) * b + ENTRY * (a + b)) * n
        return request.realizations * float(each + WRITTEN * (2 * f + 1) ** d / 2)

    def cost(self, request: SpectrumRequest) -> EvaluationCost:
        """Estimate the product's cost on the device."""
        slots = product_slots(self.on_device, request)
        launches = 3.0 * slots.launches(request.n) * -(-request.realizations // slots.sets)
        held = 3 * 8 * (2 * request.fmax + 1) ** request.d + 2 * TABLE_BYTES
        return device_cost(self.on_device, request, self.work(request), launches, held)

    def expected_errors(self, request: SpectrumRequest) -> Errors:
        """State the product's errors, coordinates being exact in double and rounded at worst in float."""
        p, n = self.on_device, request.n
        at = rounded_at_worst(n, request.d, p.name)
        return product_errors(p, n, product_slots(p, request), request.fmax, at)

    def cube(
        self, x: FloatArray, fmax: int, weights: FloatArray | None, *, half: bool, mean: bool
    ) -> tuple[FloatArray, Errors]:
        """Evaluate the power of a cube, as ``Evaluator.cube`` describes it."""
        return cube_powers(self.on_device, x, fmax, weights, half, mean)


def product_slots(p: Precision, request: SpectrumRequest) -> Slots:
    """Deal the points of a request out to work-items, as the product of a cube does.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    request : SpectrumRequest
        A request for a cube, or for shells of one.

    Returns
    -------
    Slots
    """
    divided = cheapest_division(request.d, request.fmax, tile_rows(p))
    a, b = half_size(divided.leading), half_size(divided.trailing)
    return choose_slots(
        p, request.n, request.realizations, padded(a, tile_rows(p)), padded(b, p.runtime.group)
    )


def cube_powers(
    p: Precision,
    x: FloatArray,
    fmax: int,
    weights: FloatArray | None = None,
    half: bool = False,
    mean: bool = True,
) -> tuple[FloatArray, Errors]:
    """Evaluate the power at all frequencies with |f_a| <= fmax.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    x : (sets, n, d) float64
        Checked points.
    fmax : int
        Largest harmonic on each axis.
    weights : (sets or 1, n) float64, optional
        Weights of the points; power is divided by the sum of their squares.
    half : bool
        Only the half with f_0 >= 0.
    mean : bool
        Average over sets; otherwise the power of each set.

    Returns
    -------
    power : (2*fmax+1,)*d float64
        The first axis is only fmax+1 long for a half. An axis of sets precedes it unless ``mean``.
    errors : Errors
        Errors of the square root of the power of any one set.
    """
    sets, n, d = x.shape
    divided = cheapest_division(d, fmax, tile_rows(p))
    at, rms, bound = coordinates(x, p.name, weights), 0.0, 0.0
    writer: CubeWriter | None = None
    for first_row, rows in row_blocks(p, divided):
        product = TwoGroupProduct(p, n, d, sets, rows, Group(divided.trailing))
        if writer is None:
            writer = CubeWriter(p, divided, fmax, norms_of(weights, sets, n), d, half=half, mean=mean)
        for first, count in product.batches(x, weights):
            writer.add(
                product.program, product.amplitude, product.slots.splits, first, count, first_row, rows.count
            )
        errors = product_errors(p, n, product.slots, fmax, at)
        rms, bound = max(rms, errors.rms), max(bound, errors.bound)
    assert writer is not None  # noqa: S101 - there is a row
    return writer.result(), Errors(rms, bound)


class CubeWriter:
    """A cube of power on the device, to which batches of amplitudes are added.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    divided : Division
        The two groups of axes.
    fmax : int
        Largest harmonic on each axis.
    norms : (sets,) float64
        Numbers by which the squared amplitudes of each set are divided.
    d : int
        Dimension.
    half, mean : bool
        As in ``cube_powers``.
    gains : (rows,) float64, optional
        Numbers by which the squared amplitudes at each leading frequency are divided besides; 1 if not given.
    """

    def __init__(
        self,
        p: Precision,
        divided: Division,
        fmax: int,
        norms: FloatArray,
        d: int,
        half: bool,
        mean: bool,
        gains: FloatArray | None = None,
    ) -> None:
        self._p, self._fmax, self._d, self._half, self._mean = p, fmax, d, half, mean
        self._sets = len(norms)
        self._rows, self._columns = half_size(divided.leading), half_size(divided.trailing)
        shape = covered(divided, d)
        self._start = shape[0] // 2 * math.prod(shape[1:]) if half else 0
        self._count = math.prod(shape) - self._start
        self._shape = (shape[0] - shape[0] // 2, *shape[1:]) if half else shape
        self._out = p.runtime.empty(self._count * (1 if mean else self._sets) * np.dtype(p.sum).itemsize)
        self._norms = p.runtime.upload(norms.astype(p.sum))
        self._gains = p.runtime.upload((np.ones(self._rows) if gains is None else gains).astype(p.sum))

    def add(
        self, program: Program, amplitude: Any, splits: int, first: int, count: int, first_row: int, rows: int
    ) -> None:
        """Turn the amplitudes of a batch into power, which is added up over sets or written set by set.

        Parameters
        ----------
        program : Program
            The kernels that were built for the product.
        amplitude : buffer
            Amplitudes of the batch.
        splits : int
            Slots of a set, whose amplitudes are added up.
        first, count : int
            First set of the batch, and how many sets it has.
        first_row, rows : int
            First leading frequency of the amplitudes, and how many there are.
        """
        each = GPU_COLUMNS if self._p.runtime.group > 1 else self._columns
        program.run(
            "cube_power",
            (-(-self._columns // each), rows),
            (1, 1),
            amplitude,
            np.uint32(self._rows),
            np.uint32(first_row),
            np.uint32(rows),
            np.uint32(self._columns),
            np.uint32(padded(self._columns, self._p.runtime.group)),
            np.uint32(each),
            np.uint32(splits),
            np.uint32(count),
            self._norms,
            self._gains,
            np.uint32(first),
            self._out,
            np.uint64(self._start),
            np.uint64(0 if self._mean else self._count),
        )

    def result(self) -> FloatArray:
        """Download the cube, and cut off the frequencies beyond its edge that the groups cover."""
        fmax, sets = self._fmax, 1 if self._mean else self._sets
        power = self._p.runtime.download(self._out, np.empty((sets, *self._shape), self._p.sum))
        inner = tuple(
            slice(0, fmax + 1) if self._half and a == 0 else slice(have // 2 - fmax, have // 2 + fmax + 1)
            for a, have in enumerate(self._shape)
        )
        power = np.ascontiguousarray(power[(slice(None), *inner)], np.float64)
        if not self._mean:
            return power
        if self._sets > 1:
            power /= self._sets
        mean: FloatArray = power[0]
        return mean


def row_blocks(p: Precision, divided: Division) -> Iterator[tuple[int, Group]]:
    """Cut the leading frequencies in runs whose amplitudes fit in ``AMPLITUDE_BYTES``.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    divided : Division
        The two groups of axes.

    Yields
    ------
    first : int
        Position of the run's first frequency.
    group : Group
        The frequencies of the run; the whole group where one run holds it.
    """
    total, columns = half_size(divided.leading), half_size(divided.trailing)
    most = max(
        tile_rows(p),
        AMPLITUDE_BYTES // (8 * np.dtype(p.sum).itemsize * columns) // tile_rows(p) * tile_rows(p),
    )
    if total <= most:
        yield 0, Group(divided.leading)
        return
    centre = size(divided.leading) // 2
    for first in range(0, total, most):
        order = np.arange(centre + first, centre + min(first + most, total), dtype=np.uint64)
        yield first, Group(divided.leading, order)


def covered(divided: Division, d: int) -> tuple[int, ...]:
    """Count the frequencies on each axis that the sums of the two groups cover.

    Parameters
    ----------
    divided : Division
        The two groups of axes.
    d : int
        Dimension.

    Returns
    -------
    tuple of int
        2*fmax+1 on each axis, or a few more on the one that is cut.
    """
    shape = [1] * d
    for axis in (*divided.leading, *divided.trailing):
        shape[axis.coordinate] *= axis.base
    return tuple(shape)
