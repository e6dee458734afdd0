"""Sweeps of farthest-point moves over point sets whose Delaunay triangulations stay on the device."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import DeviceError
from gbnbench.core.torus import FloatArray, toroidal_distance
from gbnbench.generators.fpo.triangulation import WIDEST, Triangulation, farthest_point, triangulate
from gbnbench.opencl import runtime

MOVES_PER_LAUNCH = 4096  # milliseconds on a CPU, far below a GPU's watchdog; Ctrl-C is heard between launches
EQUAL = 1e-12  # a relative gain in squared distance below this is rounding, not a farther point


class Sweeps:
    """Point sets with their triangulations on the device, moved on a sweep at a time.

    Parameters
    ----------
    x : (sets, n, 2) float64
        Points on the unit torus; copied.
    local : bool
        Look for the largest gap beside the former neighbours of a point alone; moves on the host, where gaps
        are wide, look everywhere.

    Attributes
    ----------
    nearest : (sets,) float64
        Minimum distance of each set after its last sweep.
    fresh_moves : (sets,) int64
        Moves made on the host.
    """

    def __init__(self, x: FloatArray, local: bool = False) -> None:
        self._local = local
        self._runtime = runtime()
        if not self._runtime.device.has_double:
            raise DeviceError(
                f"fpo needs double precision, which {self._runtime.device.label} lacks; "
                "choose another device: gbnbench devices lists them"
            )
        self._program = self._runtime.program(
            "gbnbench.generators", ("fpo_circles.cl", "fpo.cl"), {"EQUAL": EQUAL, "WIDEST": WIDEST}
        )
        self._x = x.copy()
        sets, n, _ = x.shape
        self._leaves = 1 << (2 * n - 1).bit_length()
        self._state = np.zeros((sets, 4), dtype=np.int32)
        self._arrays: list[NDArray[Any]] = [
            self._x,
            np.zeros((sets, 8 * n), dtype=np.int32),
            np.zeros((sets, 8 * n), dtype=np.int32),
            np.zeros((sets, n), dtype=np.int32),
            np.zeros((sets, 2 * n, 2)),
            np.zeros((sets, 2 * self._leaves)),
            np.zeros((sets, 2 * n), dtype=np.int32),
        ]
        self._triangulated = np.zeros(sets, dtype=bool)
        self.nearest = np.zeros(sets)
        self.fresh_moves = np.zeros(sets, dtype=np.int64)
        for s in range(sets):
            self._store(s, triangulate(x[s]))
        self._buffers = [self._runtime.upload(array) for array in self._arrays]
        self._state_buffer = self._runtime.upload(self._state)
        self._nearest_buffer = self._runtime.upload(self.nearest)

    def sweep(self, active: NDArray[np.bool_]) -> NDArray[np.int32]:
        """Move every point of the active sets once; return how many changed place in each set."""
        n = self._x.shape[1]
        self._state[:] = np.where(active[:, None], (0, 0, 0, 0), (n, 0, 0, 0))
        self._state[:, 3] = self._local
        while np.any(self._state[:, 0] < n):
            lost = np.flatnonzero((self._state[:, 0] < n) & ~self._triangulated)
            if lost.size:
                self._move_on_host(lost)
            else:
                self._launch()
        return self._state[:, 2].copy()

    def download(self) -> FloatArray:
        """Read back the points as they stand."""
        self._runtime.download(self._buffers[0], self._x)
        return self._x.copy()

    def _launch(self) -> None:
        """Move at most MOVES_PER_LAUNCH points of each set on the device."""
        rt, (sets, n, _) = self._runtime, self._x.shape
        rt.update(self._state_buffer, self._state)
        groups = -(-sets // rt.group)
        self._program.run(
            "fpo",
            (groups * rt.group,),
            (rt.group,),
            *(np.int32(value) for value in (sets, n, self._leaves, MOVES_PER_LAUNCH)),
            *self._buffers,
            self._state_buffer,
            self._nearest_buffer,
        )
        rt.download(self._state_buffer, self._state)
        rt.download(self._nearest_buffer, self.nearest)
        self._triangulated &= self._state[:, 1] == 0
        self._state[:, 1] = 0

    def _move_on_host(self, sets: NDArray[np.intp]) -> None:
        """Move on sets without a triangulation, by fresh ones, until they have one or the sweep is done.

        The move at which the device gave up is made here, so that every round advances.
        """
        n = self._x.shape[1]
        for buffer, array in zip(self._buffers, self._arrays, strict=True):
            self._runtime.download(buffer, array)
        for s in sets:
            for v in range(self._state[s, 0], n):
                moved, radius = move_afresh(self._x[s], v)
                self._state[s, 0] += 1
                self._state[s, 2] += moved
                self.fresh_moves[s] += 1
                if radius < WIDEST and self._store(s, triangulate(self._x[s])):
                    break
            self.nearest[s] = minimum_distance(self._x[s])
        for buffer, array in zip(self._buffers, self._arrays, strict=True):
            self._runtime.update(buffer, array)
        self._runtime.update(self._nearest_buffer, self.nearest)

    def _store(self, s: int, triangulation: Triangulation | None) -> bool:
        """Lay a triangulation out as the kernel wants it; False where there is none."""
        self._triangulated[s] = triangulation is not None
        if triangulation is None:
            return False
        tree = np.full(2 * self._leaves, -1.0)
        tree[self._leaves : self._leaves + len(triangulation.centre)] = triangulation.squared_radius
        level = self._leaves
        while level > 1:  # each node is the larger of its two children, the root is node 1
            level //= 2
            tree[level : 2 * level] = tree[2 * level : 4 * level].reshape(-1, 2).max(axis=1)
        parts = (
            triangulation.origin,
            triangulation.twin,
            triangulation.leaving,
            triangulation.centre,
            tree,
            0,
        )
        for array, part in zip(self._arrays[1:], parts, strict=True):
            array[s] = part
        return True


def move_afresh(x: FloatArray, v: int) -> tuple[bool, float]:
    """Move one point of a set to the farthest place from all others, where that is farther than its own.

    Parameters
    ----------
    x : (n, 2) float64
        Points; changed in place.
    v : int
        The point that moves.

    Returns
    -------
    moved : bool
        Whether the point was moved.
    radius : float
        Distance of the farthest place from the nearest of the other points.
    """
    rest = np.delete(x, v, axis=0)
    if len(rest) == 0:
        return False, 1.0
    centre, radius = farthest_point(rest)
    moved = radius > toroidal_distance(rest, x[v]).min() * (1 + EQUAL / 2)
    if moved:
        x[v] = centre
    return bool(moved), radius


def minimum_distance(x: FloatArray) -> float:
    """Minimum toroidal distance of a set; that of a single point to its own image is 1."""
    if len(x) == 1:
        return 1.0
    from scipy.spatial import cKDTree

    distance, _ = cKDTree(x, boxsize=np.ones(2)).query(x, k=2)
    return float(np.min(np.asarray(distance)[:, 1]))
