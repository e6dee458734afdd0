"""The pull of a density on kernels, summed over the cells of its levels (attraction.py) on the device."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.gbn.attraction import Level
from gbnbench.opencl import Runtime

PACKAGE = "gbnbench.generators"
WIDEST_LINE = 512  # weights along an axis


class PullSums:
    """G_v * T at n points of variance v, and its slopes.

    Parameters
    ----------
    runtime : Runtime
        The device.
    levels : sequence of Level
        T at its resolutions.
    n : int
        Points.
    defines : mapping
        Of the kernel: DOUBLE, LANES, SUM and AXES.
    resolution : float
        Width of a kernel over the cells of its level, at least.
    reach : float
        Standard deviations after which a Gaussian ends.

    Raises
    ------
    InputError
        If kernels reach over too many cells.
    """

    def __init__(
        self,
        runtime: Runtime,
        levels: Sequence[Level],
        n: int,
        defines: Mapping[str, int | str],
        resolution: float,
        reach: float,
    ) -> None:
        self._runtime, self._n, self._d = runtime, n, len(levels[0].cell)
        self._real = real = np.float64 if defines["DOUBLE"] else np.float32
        lanes = int(defines["LANES"])
        wide = -(-(2 * max(level.reached for level in levels) + 1) // lanes) * lanes
        if wide > WIDEST_LINE:
            raise InputError(f"kernels reach over {wide} cells, {WIDEST_LINE} at most: one axis is too short")
        offsets = np.cumsum([0, *(level.values.size for level in levels)])
        flat = np.zeros(int(offsets[-1]) + lanes, real)
        for begin, level in zip(offsets, levels, strict=False):
            flat[begin : begin + level.values.size] = level.values.ravel()
        self._levels = (
            np.uint32(len(levels)),
            runtime.upload(np.array([level.cell for level in levels], real)),
            runtime.upload(np.array([level.variance for level in levels], real)),
            runtime.upload(np.array([level.first for level in levels], real)),
            runtime.upload(np.array([level.values.shape for level in levels], np.int32)),
            runtime.upload(offsets[:-1].astype(np.uint64)),
            runtime.upload(flat),
            real(resolution),
            real(reach),
        )
        files = ("/vector.cl", "/exp2.cl", "adaptive_pull.cl")
        self._program = runtime.program(PACKAGE, files, {**defines, "WIDE": wide})
        self._found = runtime.empty((self._d + 2) * n * np.dtype(real).itemsize)

    def __call__(self, at: Any, variances: FloatArray) -> FloatArray:
        """Sum.

        Parameters
        ----------
        at : buffer of (d, n)
            Positions, in pixels.
        variances : (n,) float64
            Of the kernels, squared pixels.

        Returns
        -------
        (d + 2, n) float64
            Slopes by each axis, by the variance, and the pull itself.
        """
        rt, n = self._runtime, np.uint32(self._n)
        self._program.run(
            "adaptive_pull", (-(-self._n // rt.group) * rt.group,), (rt.group,),
            n, n, at, rt.upload(variances.astype(self._real)), *self._levels, self._found,
        )  # fmt: skip
        out = np.empty((self._d + 2, self._n), self._real)
        return rt.download(self._found, out).astype(np.float64)
