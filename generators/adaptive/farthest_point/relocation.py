"""Sweeps of farthest-point moves for a density, on the OpenCL device."""

from __future__ import annotations

from typing import Any

import numpy as np

from gbnbench.core.errors import DeviceError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.domain import interpolation_mode
from gbnbench.generators.adaptive.farthest_point.places import Places
from gbnbench.opencl import runtime

MOVES_PER_LAUNCH = 1024  # some ten milliseconds on a CPU, so that Ctrl-C is heard between launches
PACKAGE = "gbnbench.generators"


class AdaptiveSweeps:
    """A set with the voids that it leaves, moved on a sweep at a time.

    Parameters
    ----------
    density : Density
        The density, of an image.
    places : Places
        Its local spacing, and places on its ink.
    x : (n, 2) float64
        Points on the ink, in pixels.

    Raises
    ------
    DeviceError
        If the device does not compute in double precision.
    """

    def __init__(self, density: Density, places: Places, x: FloatArray) -> None:
        from scipy import ndimage

        self._runtime = rt = runtime()
        if not rt.device.has_double:
            raise DeviceError(
                f"fpo needs double precision, which {rt.device.label} lacks; "
                "choose another device: gbnbench devices lists them"
            )
        self._program = rt.program(PACKAGE, ("adaptive_voids.cl", "adaptive_fpo.cl"), {})
        self._n, (rows, columns) = len(x), places.cells
        mode = interpolation_mode(toroidal=density.toroidal)
        spacing = places.spacing.astype(np.float64)
        of_point = ndimage.map_coordinates(spacing, x.T - 0.5, order=1, mode=mode)
        head, following = _lists(density.shape, places.cells, x)
        self._points = rt.upload(np.ascontiguousarray(x))
        counts = np.array([*density.shape, rows, columns], np.int32)
        self._domain: tuple[Any, ...] = (
            np.float64(density.shape[0]),
            np.float64(density.shape[1]),
            rt.upload(counts),
            np.int32(density.toroidal),
            np.float64(places.widest.max()),
            rt.upload(places.spacing),
            rt.upload((density.values > 0).astype(np.uint8)),
            rt.upload(places.widest),
            self._points,
            rt.upload(of_point),
            rt.upload(head),
            rt.upload(following),
        )
        self._many = many = len(places.places)
        self._leaves = 1 << max(1, (many - 1).bit_length())
        self._places = (rt.upload(places.places), rt.upload(places.of_place))
        self._start = rt.upload(places.start)
        tree = np.full(2 * self._leaves, -1, np.float32)
        self._tree = rt.upload(tree)
        self._moved = rt.upload(np.zeros(1, np.int32))
        self._run(
            "adaptive_fpo_places", many, np.int32(many), np.int32(self._leaves), *self._places, self._tree
        )
        rt.download(self._tree, tree)
        level = self._leaves
        while level > 1:  # each node is the larger of its two children, the root is node 1
            level //= 2
            tree[level : 2 * level] = tree[2 * level : 4 * level].reshape(-1, 2).max(axis=1)
        rt.update(self._tree, tree)

    def sweep(self) -> int:
        """Move every point once; return how many changed place."""
        self._runtime.update(self._moved, np.zeros(1, np.int32))
        for first in range(0, self._n, MOVES_PER_LAUNCH):
            last = min(self._n, first + MOVES_PER_LAUNCH)
            self._run(
                "adaptive_fpo", 1, np.int32(first), np.int32(last), np.int32(self._leaves), *self._places,
                self._start, self._tree, self._moved,
            )  # fmt: skip
            self._runtime.finish()
        return int(self._runtime.download(self._moved, np.zeros(1, np.int32))[0])

    def nearest(self) -> FloatArray:
        """Give each point's distance to the nearest other one, or to its mirror image, in local spacings."""
        values = self._runtime.empty(8 * self._n)
        self._run("adaptive_fpo_points", self._n, np.int32(self._n), values)
        return self._runtime.download(values, np.empty(self._n))

    def voids(self) -> FloatArray:
        """Give the void at each place: its distance to the nearest point, at most as far as its image."""
        tree = self._runtime.download(self._tree, np.empty(2 * self._leaves, np.float32))
        return tree[self._leaves : self._leaves + self._many].astype(np.float64)

    def points(self) -> FloatArray:
        """Read back the points as they stand."""
        return self._runtime.download(self._points, np.empty((self._n, 2)))

    def _run(self, kernel: str, items: int, *arguments: Any) -> None:
        group = 1 if items == 1 else self._runtime.group
        self._program.run(kernel, (-(-items // group) * group,), (group,), *self._domain, *arguments)


def _lists(
    shape: tuple[int, ...], cells: tuple[int, int], x: FloatArray
) -> tuple[np.ndarray[Any, Any], np.ndarray[Any, Any]]:
    """Chain the points of each cell: the first of each, and the one after each point; -1 ends a chain."""
    side = np.array(shape) / cells
    cell = np.minimum((x / side).astype(np.intp), np.array(cells) - 1) @ (cells[1], 1)
    order = np.argsort(cell, kind="stable")
    first = np.append(True, cell[order][1:] != cell[order][:-1])
    head = np.full(cells[0] * cells[1], -1, np.int32)
    head[np.asarray(cell[order][first], np.intp)] = order[first]
    following = np.full(len(x), -1, np.int32)
    following[order[:-1][~first[1:]]] = order[1:][~first[1:]]
    return head, following
