"""Runs of leading frequencies in which the product of a large cube is evaluated, and their memory."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gbnbench.analysis.precision import Precision, padded
from gbnbench.analysis.spectrum.digits import Division, cheapest_division, half_size, size
from gbnbench.analysis.spectrum.evaluators.frequency_group import Group
from gbnbench.analysis.spectrum.evaluators.point_slots import (
    AMPLITUDE_BYTES,
    PAIR_SUMS,
    PLAIN_POINTS,
    PLAIN_SUMS,
    Slots,
    choose_slots,
    tile_columns,
    tile_rows,
)
from gbnbench.analysis.spectrum.request import SpectrumRequest


def most_rows(p: Precision, divided: Division, n: int) -> int:
    """Count the leading frequencies whose amplitudes fit in ``AMPLITUDE_BYTES``.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    divided : Division
        The two groups of axes.
    n : int
        Points of a set.

    Returns
    -------
    int
        One tile of them or more.
    """
    of_a_row = pair_sums(n) * np.dtype(p.sum).itemsize * half_size(divided.trailing)
    return max(tile_rows(p), AMPLITUDE_BYTES // of_a_row // tile_rows(p) * tile_rows(p))


def pair_sums(n: int) -> int:
    """Count the numbers that a pair of frequencies has at most: fewer where no rounding is kept.

    Parameters
    ----------
    n : int
        Points of a set.

    Returns
    -------
    int
    """
    return PLAIN_SUMS if n <= PLAIN_POINTS else PAIR_SUMS


def row_blocks(p: Precision, divided: Division, n: int) -> Iterator[tuple[int, Group]]:
    """Cut the leading frequencies in runs whose amplitudes fit in ``AMPLITUDE_BYTES``.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    divided : Division
        The two groups of axes.
    n : int
        Points of a set.

    Yields
    ------
    first : int
        Position of the run's first frequency.
    group : Group
        The frequencies of the run; the whole group where one run holds it.
    """
    total, most = half_size(divided.leading), most_rows(p, divided, n)
    if total <= most:
        yield 0, Group(divided.leading)
        return
    centre = size(divided.leading) // 2
    for first in range(0, total, most):
        order = np.arange(centre + first, centre + min(first + most, total), dtype=np.uint64)
        yield first, Group(divided.leading, order)


def planned_runs(p: Precision, request: SpectrumRequest) -> list[tuple[int, Slots]]:
    """Give the different runs that a request for a cube takes: all alike but the last.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    request : SpectrumRequest
        A request for a cube, or for shells of one.

    Returns
    -------
    list of (int, Slots)
        Leading frequencies of a run, and how the points are dealt out.
    """
    divided = cheapest_division(request.d, request.largest, tile_rows(p), tile_columns(p))
    a, b = half_size(divided.leading), half_size(divided.trailing)
    columns, most = padded(b, p.runtime.group * p.lanes), most_rows(p, divided, request.n)
    lengths = {min(a, most), a % most or min(a, most)}
    return [
        (rows, choose_slots(p, request.n, request.realizations, padded(rows, tile_rows(p)), columns))
        for rows in sorted(lengths, reverse=True)
    ]


def held_bytes(p: Precision, request: SpectrumRequest) -> int:
    """Count the bytes of the tables and amplitudes of a cube, and of its powers on the device and the host.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    request : SpectrumRequest
        A request for a cube.

    Returns
    -------
    int
    """
    divided = cheapest_division(request.d, request.largest, tile_rows(p), tile_columns(p))
    columns = padded(half_size(divided.trailing), p.runtime.group * p.lanes)
    copies = 2 if p.runtime.device.is_cpu else 3  # a CPU's kernels write the host's memory
    powers = copies * np.dtype(np.float64).itemsize * request.frequencies
    of_runs = []
    for count, slots in planned_runs(p, request):
        rows = padded(count, tile_rows(p))
        tables = 2 * (rows + columns) * slots.pitch * (slots.items or slots.count) * np.dtype(p.real).itemsize
        sums = slots.count * rows * columns * pair_sums(request.n) * np.dtype(p.sum).itemsize
        of_runs.append(tables + sums)
    return powers + sum(of_runs)
