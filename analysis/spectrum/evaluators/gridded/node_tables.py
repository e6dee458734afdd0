"""Tables of the first axis at the nodes of a grid, which take the place of tables at points."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.precision import Precision, padded
from gbnbench.analysis.spectrum.coordinate_rounding import BITS
from gbnbench.analysis.spectrum.digits import whole_axes
from gbnbench.analysis.spectrum.evaluators.device_points import DevicePoints
from gbnbench.analysis.spectrum.evaluators.frequency_tables import whole_group_tables
from gbnbench.analysis.spectrum.evaluators.point_slots import Slots


@lru_cache(maxsize=8)
def node_turns(nodes: int, bits: int) -> NDArray[np.uint64]:
    """Give the multiples of 1/nodes as fixed-point turns.

    Parameters
    ----------
    nodes, bits : int
        Nodes of the grid, and bits of a turn.

    Returns
    -------
    (nodes,) uint64
        Units of 2^-bits.
    """
    return np.array([((m << (bits + 1)) // nodes + 1) >> 1 for m in range(nodes)], np.uint64)


@lru_cache(maxsize=4)
def node_table(p: Precision, d: int, fmax: int, nodes: int) -> Any:
    """Tabulate the first axis at the nodes, kept from call to call as a transform keeps its twiddle factors.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    d, fmax : int
        Dimension, and largest harmonic on each axis.
    nodes : int
        Nodes of the grid.

    Returns
    -------
    buffer
        The leading table.
    """
    axes = whole_axes(d, fmax)
    f = whole_group_tables(p, d, axes[:1], axes[1:])
    folded = padded(nodes // 2 + 1, p.lanes)
    at_nodes = np.zeros((1, d, folded), p.turn)
    at_nodes[0, 0] = node_turns(nodes, BITS[p.name])[:folded]
    ones = p.runtime.upload(np.ones(folded, p.real))
    points = DevicePoints(p.runtime.upload(at_nodes), ones, folded, 0)
    table = p.runtime.empty(f.table_sizes(folded)[0] * np.dtype(p.real).itemsize)
    f.tabulate(f.program(folded=True), (0, 1), points, (table, table), Slots(1, 1, folded, folded), (0, 0), 1)
    return table
