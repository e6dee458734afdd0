"""Runs of leading frequencies in which the product of a large cube is evaluated, and their memory."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

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


@dataclass(frozen=True)
class PlannedRuns:
    """Runs that are alike.

    Attributes
    ----------
    rows, columns : int
        Frequencies of the two groups, padded to whole tiles.
    times : int
        How many runs.
    slots : Slots
        How the points are dealt out.
    """

    rows: int
    columns: int
    times: int
    slots: Slots


def planned_runs(p: Precision, request: SpectrumRequest) -> list[PlannedRuns]:
    """Give the runs that a request for a cube takes: all alike but a shorter last one.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    request : SpectrumRequest
        A request for a cube.

    Returns
    -------
    list of PlannedRuns
        One, or two where the last run is shorter.
    """
    divided, rows, columns = _padded_groups(p, request)
    most = min(rows, most_rows(p, divided, request.n))
    whole, left = divmod(rows, most)
    lengths = [(most, whole), *([(left, 1)] if left else [])]
    return [PlannedRuns(run, columns, times, _slots(p, request, run, columns)) for run, times in lengths]


def slots_of_all_rows(p: Precision, request: SpectrumRequest) -> Slots:
    """Deal the points of a request out to work-items, as if one run took all rows.

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
    _, rows, columns = _padded_groups(p, request)
    return _slots(p, request, rows, columns)


def held_bytes(p: Precision, request: SpectrumRequest, planned: list[PlannedRuns]) -> int:
    """Count the bytes of the tables and amplitudes of a cube, and of its powers on the device and the host.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    request : SpectrumRequest
        A request for a cube.
    planned : list of PlannedRuns
        Its runs; while one gives way to a shorter one, both are held.

    Returns
    -------
    int
    """
    copies = 2 if p.runtime.device.is_cpu else 3  # a CPU's kernels write the host's memory
    held = copies * np.dtype(np.float64).itemsize * request.frequencies
    for run in planned:
        tables = 2 * (run.rows + run.columns) * run.slots.pitch * (run.slots.items or run.slots.count)
        sums = run.slots.count * run.rows * run.columns * pair_sums(request.n)
        held += tables * np.dtype(p.real).itemsize + sums * np.dtype(p.sum).itemsize
    return held


def _padded_groups(p: Precision, request: SpectrumRequest) -> tuple[Division, int, int]:
    divided = cheapest_division(request.d, request.largest, tile_rows(p), tile_columns(p))
    rows = padded(half_size(divided.leading), tile_rows(p))
    return divided, rows, padded(half_size(divided.trailing), p.runtime.group * p.lanes)


def _slots(p: Precision, request: SpectrumRequest, rows: int, columns: int) -> Slots:
    return choose_slots(p, request.n, request.realizations, rows, columns)
