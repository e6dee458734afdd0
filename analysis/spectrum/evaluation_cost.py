"""What an evaluation will cost and how far off it may be, before there are any points."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gbnbench.analysis.precision import Precision, padded
from gbnbench.analysis.spectrum.digits import cheapest_division, half_size, whole_axes
from gbnbench.analysis.spectrum.error_model import Errors, rounded_at_worst
from gbnbench.analysis.spectrum.evaluators.direct_sum import listed_errors, run_length
from gbnbench.analysis.spectrum.evaluators.gridded_product import DEGREE, WIDTH, griddable, gridded_errors
from gbnbench.analysis.spectrum.evaluators.kaiser_bessel import nodes_for
from gbnbench.analysis.spectrum.evaluators.shell_product import BLOCK_COLUMNS, BLOCK_ROWS, pairs, two_groups
from gbnbench.analysis.spectrum.evaluators.two_group_product import (
    TABLE_BYTES,
    Slots,
    deal,
    product_errors,
    rows_of,
)
from gbnbench.analysis.spectrum.limits import BYTES, MEMORY_SHARE, memory
from gbnbench.analysis.spectrum.request import Request
from gbnbench.opencl.peak_rate import launch_seconds, peak

# Multiply-adds, measured on CPUs: of a pair of frequencies and a point (four, and what a tile wastes), an
# entry of a table, a cosine and sine, a power written, and a pair reduced to its shell; of a frequency
# carried from a point to a node, and folded there.
TILE, ENTRY, COSINE, WRITTEN, SHELL = 5.0, 40.0, 200.0, 20.0, 550.0
SPREAD, CARRIED = 7.0, 60.0
LAUNCHES_MORE = 2e7  # of a gridded product's further launches and its sort
CALL_SECONDS = 4e-4  # of a request, whatever it asks
NUMPY_RATE = 4e9  # multiply-adds a second of one core


@dataclass(frozen=True)
class Cost:
    """What an evaluation takes.

    Attributes
    ----------
    flops : float
        Additions and multiplications of all it does.
    bytes : int
        Memory at its largest.
    seconds : float
        Expected, on all cores of the device.
    """

    flops: float
    bytes: int
    seconds: float


def cube_work(p: Precision, request: Request, gridded: bool) -> float:
    """Count multiply-adds of a cube, with what goes with them: comparable between the two products."""
    n, d, f = request.n, request.d, request.fmax
    if gridded:
        trailing = half_size(whole_axes(d, f)[1:])
        nodes = nodes_for(f, p.lanes)
        reached = WIDTH[p.name] + p.lanes
        carried = n * (ENTRY * trailing + reached * (SPREAD * trailing + 2 * DEGREE[p.name]))
        each = carried + trailing * nodes * (CARRIED + 0.8 * TILE * (f + 1))
    else:
        divided = cheapest_division(d, f, rows_of(p))
        a, b = half_size(divided.leading), half_size(divided.trailing)
        each = (TILE * padded(a, rows_of(p)) * b + ENTRY * (a + b)) * n
    return request.realizations * float(each + WRITTEN * (2 * f + 1) ** d / 2)


def can_be_gridded(request: Request, precision: str) -> bool:
    """Whether the gridded product can serve a request."""
    return request.what in ("cube", "half cube") and griddable(request.d, request.fmax, precision)


def grid_bytes(p: Precision, request: Request) -> int:
    """Size of the grid of one set; folded it is as large again."""
    trailing = padded(half_size(whole_axes(request.d, request.fmax)[1:]), p.runtime.group)
    return nodes_for(request.fmax, p.lanes) * trailing * 2 * np.dtype(p.real).itemsize


def grid_fits(p: Precision, request: Request) -> bool:
    """Whether the grid is a buffer that the device gives, and fits in memory beside the cube."""
    grid, cube = grid_bytes(p, request), BYTES * (2 * request.fmax + 1) ** request.d
    return grid <= p.runtime.largest_buffer and 2 * grid + cube <= MEMORY_SHARE * memory()


def gridded_is_cheaper(p: Precision, request: Request) -> bool:
    """Whether the gridded product of a cube beats the plain one by more than its launches cost."""
    if not can_be_gridded(request, p.name) or not grid_fits(p, request):
        return False
    return cube_work(p, request, gridded=True) + LAUNCHES_MORE < cube_work(p, request, gridded=False)


def device_cost(p: Precision, request: Request, gridded: bool = False) -> Cost:
    """Cost on an OpenCL device, from its measured multiply-add peak."""
    n, sets = request.n, request.realizations
    itemsize = np.dtype(p.real).itemsize
    points = sets * n * request.d * 2 * itemsize
    launches = 2.0
    if request.what == "listed":
        work = request.frequencies * (COSINE + 2 * request.d) * n * sets
        held = request.frequencies * 64
    elif request.what == "shells":
        a, b = two_groups(request.d, request.fmax, request.high)
        count = pairs(a, b, request.low, request.high)
        blocks = max(1.0, count / (BLOCK_ROWS * BLOCK_COLUMNS))
        entries = blocks * min(BLOCK_ROWS + BLOCK_COLUMNS, len(a.order) + len(b.order))
        work = (TILE * count + ENTRY * entries) * n * sets + SHELL * count
        launches = 3 * blocks * max(1.0, n * sets / 1024)
        held = 3 * (8 << 20) + TABLE_BYTES + (64 << 20)
    else:
        work = cube_work(p, request, gridded)
        slots = _slots(p, request)
        launches = 8.0 if gridded else 3.0 * slots.launches(n) * -(-sets // slots.sets)
        held = 3 * 8 * (2 * request.fmax + 1) ** request.d + 2 * TABLE_BYTES
        held += 2 * grid_bytes(p, request) if gridded else 0
    device = p.runtime.device
    cores = device.compute_units if device.is_cpu else 1
    seconds = CALL_SECONDS + launches * launch_seconds() + 2 * work / peak(p.name) / cores
    return Cost(2 * work, int(held + points), seconds)


def device_errors(p: Precision, request: Request, gridded: bool = False) -> Errors:
    """Errors before the points are known: coordinates exact in double, rounded in float."""
    n, d, f = request.n, request.d, request.fmax
    at = rounded_at_worst(n, d, p.name)
    if request.what == "listed":
        return listed_errors(p, n, f, run_length(p, request.frequencies, n), at)
    if gridded:
        return gridded_errors(p, f, min(n, 2 * n * WIDTH[p.name] // nodes_for(f, p.lanes) + 1), at)
    return product_errors(p, n, _slots(p, request), f, at)


def _slots(p: Precision, request: Request) -> Slots:
    """Deal out the points as for a cube."""
    divided = cheapest_division(request.d, request.fmax, rows_of(p))
    a, b = half_size(divided.leading), half_size(divided.trailing)
    return deal(p, request.n, request.realizations, padded(a, rows_of(p)), padded(b, p.runtime.group))


def numpy_cost(request: Request, precision: str) -> Cost:
    """Cost of plain numpy."""
    n, d, f, sets = request.n, request.d, request.fmax, request.realizations
    each = 60.0 if request.what == "listed" else 1.0
    work = each * request.frequencies * n * sets
    held = 16 * request.frequencies if request.what == "listed" else 24 * (2 * f + 1) ** d
    seconds = CALL_SECONDS + work / NUMPY_RATE / (2 if precision == "float" else 1)
    return Cost(2 * work, int(held + n * d * 64), seconds)
