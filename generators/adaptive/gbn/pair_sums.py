"""Sums of Gaussians over the pairs of an adaptive set, on the device."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from gbnbench.core.neighbour_grid import neighbour_grid
from gbnbench.core.torus import FloatArray
from gbnbench.opencl import Runtime

PACKAGE = "gbnbench.generators"
CHUNK = 16  # points that a work-item of a CPU sums for


class PairSums:
    """Sum over l of G(x_k - x_l; v_k + v_l), l = k included, and its slopes.

    Parameters
    ----------
    runtime : Runtime
        The device.
    n : int
        Points.
    torus : tuple of int or None
        Its sides; None where there is a border.
    defines : mapping
        Of the kernel: DOUBLE, LANES, SUM and AXES.
    reach : float
        Standard deviations after which a Gaussian ends.
    """

    def __init__(
        self,
        runtime: Runtime,
        n: int,
        torus: tuple[int, ...] | None,
        defines: Mapping[str, int | str],
        reach: float,
    ) -> None:
        self._runtime, self._n, self._torus, self._reach = runtime, n, torus, reach
        self._d, self._lanes = int(defines["AXES"]), int(defines["LANES"])
        self._real = np.float64 if defines["DOUBLE"] else np.float32
        files = ("/vector.cl", "/exp2.cl", "adaptive_pairs.cl")
        self._program = runtime.program(PACKAGE, files, defines)
        self._found = runtime.empty((self._d + 2) * n * np.dtype(self._real).itemsize)

    def __call__(self, x: FloatArray, variances: FloatArray) -> FloatArray:
        """Sum.

        Parameters
        ----------
        x : (n, d) float64
            Points, in pixels.
        variances : (n,) float64
            Of their kernels, squared pixels.

        Returns
        -------
        (d + 2, n) float64
            Slopes by each axis, by v_k, and the sum itself.
        """
        rt, n, real = self._runtime, self._n, self._real
        grid = neighbour_grid(x, variances, self._reach, self._torus)
        m = grid.places.shape[1]
        stride = m + self._lanes
        places = np.zeros((self._d, stride), real)
        sources = np.ones(stride, real)
        places[:, :m], sources[:m] = grid.places, grid.variances
        chunk = CHUNK if rt.device.is_cpu else 1
        group = 1 if rt.device.is_cpu else rt.group
        items = -(-n // chunk)
        self._program.run(
            "adaptive_pairs",
            (-(-items // group) * group,),
            (group,),
            np.uint32(n),
            np.uint32(chunk),
            rt.upload(grid.targets),
            np.uint32(stride),
            rt.upload(places),
            rt.upload(sources),
            np.uint32(len(grid.sides)),
            rt.upload(grid.sides.astype(real)),
            rt.upload(grid.widest.astype(real)),
            rt.upload(grid.counts),
            rt.upload(grid.offsets),
            rt.upload(grid.starts),
            real(self._reach),
            self._found,
        )
        found = np.empty((self._d + 2, n))
        out = np.empty((self._d + 2, n), real)
        found[:, grid.points] = rt.download(self._found, out).astype(np.float64)
        return found
