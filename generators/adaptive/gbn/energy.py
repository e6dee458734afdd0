"""The energy of an adaptive set, and its gradient: E = 1/2 integral of (A - T)^2, up to a constant.

A(x) sums a Gaussian of unit mass and variance s(x_k)^2 for each point, s being a field (kernel_widths.py); T
is what the density spreads (attraction.py). With G of unit mass,

    E = 1/2 sum over k, l of G(x_k - x_l; s_k^2 + s_l^2) - sum over k of (G_{s_k^2} * T)(x_k),

k = l included. These are Eq. 28 to 32 of Ahmed, Ren & Wonka (2022) with a_k = sigma^2 / (2 s_k^2), but for
the factor of a kernel's mass; their variance, Eq. 29 and 47, is 2 E.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError
from gbnbench.core.neighbour_grid import neighbour_grid
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.domain import pixels_of
from gbnbench.generators.adaptive.gbn.attraction import attraction_levels
from gbnbench.generators.adaptive.gbn.gradient import AdaptiveGradient
from gbnbench.generators.adaptive.gbn.kernel_widths import BORDER, kernel_widths
from gbnbench.opencl import Runtime

PACKAGE = "gbnbench.generators"
# Standard deviations after which a Gaussian ends, exp(-reach^2 / 2), and widths of a kernel over its level's
# cells, exp(-pi^2 resolution^2 / 2): 3e-7 in float, 1e-15 in double.
REACH = {"float": 5.5, "double": 8.3}
RESOLUTION = {"float": 1.75, "double": 2.65}
CHUNK = 16  # points that a work-item of a CPU sums for
WIDEST_LINE = 512  # weights along an axis
WIDER = 2.0  # factor of a kernel's width beyond which a move is refused


class AdaptiveEnergy:
    """The energy of n points for a density.

    Parameters
    ----------
    runtime : Runtime
        The device.
    density : Density
        The density, whose pixels are finer than the kernels by ``RESOLUTION``.
    n : int
        Points.
    sigma : float
        Kernel width of the uniform method, in spacings.
    smoothing : float
        c: width of the average that gives the kernels their width, over that width.
    spread : float
        t: width over which a pixel's share is spread, over that of the kernels there.
    precision : {"double", "float"}
        Of the sums.

    Attributes
    ----------
    density : Density
        As given.
    sigma : float
        As given.
    """

    def __init__(
        self,
        runtime: Runtime,
        density: Density,
        n: int,
        *,
        sigma: float,
        smoothing: float,
        spread: float,
        precision: str,
    ) -> None:
        self.density, self.sigma, self.n = density, sigma, n
        self._runtime, self._precision = runtime, precision
        self._real = np.float64 if precision == "double" else np.float32
        d = density.d
        found = kernel_widths(density, n, sigma, smoothing)
        levels = attraction_levels(density, n, found, spread, RESOLUTION[precision], REACH[precision])
        self._spline = runtime.upload(found.coefficients.astype(self._real))
        self._spline_counts = runtime.upload(np.array(found.coefficients.shape, np.int32))
        lanes = runtime.lanes(precision)
        wide = -(-(2 * max(level.reached for level in levels) + 1) // lanes) * lanes
        if wide > WIDEST_LINE:
            raise InputError(f"kernels reach over {wide} cells, {WIDEST_LINE} at most: one axis is too short")
        offsets = np.cumsum([0, *(level.values.size for level in levels)])
        flat = np.zeros(int(offsets[-1]) + lanes, self._real)
        for begin, level in zip(offsets, levels, strict=False):
            flat[begin : begin + level.values.size] = level.values.ravel()
        self._levels = (
            np.uint32(len(levels)),
            runtime.upload(np.array([level.cell for level in levels], self._real)),
            runtime.upload(np.array([level.variance for level in levels], self._real)),
            runtime.upload(np.array([level.first for level in levels], self._real)),
            runtime.upload(np.array([level.values.shape for level in levels], np.int32)),
            runtime.upload(offsets[:-1].astype(np.uint64)),
            runtime.upload(flat),
            self._real(RESOLUTION[precision]),
            self._real(REACH[precision]),
        )
        defines = {
            "DOUBLE": int(precision == "double"),
            "LANES": lanes,
            "SUM": "double" if runtime.device.has_double else "float",
            "AXES": d,
        }
        files = ("/vector.cl", "/exp2.cl")
        self._program_of_widths = runtime.program(PACKAGE, ("/vector.cl", "adaptive_widths.cl"), defines)
        self._program_of_pairs = runtime.program(PACKAGE, (*files, "adaptive_pairs.cl"), defines)
        self._program_of_pull = runtime.program(
            PACKAGE, (*files, "adaptive_pull.cl"), {**defines, "WIDE": wide}
        )
        self._found = runtime.empty((d + 2) * n * np.dtype(self._real).itemsize)

    def widths(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Look up the width of kernels.

        Parameters
        ----------
        x : (n, d) float64
            Positions within the density, in pixels.

        Returns
        -------
        widths : (n,) float64
            In pixels.
        slopes : (n, d) float64
            Of their logarithm, a pixel.
        """
        return self._widths(self._runtime.upload(x.T.astype(self._real)), len(x))

    def _widths(self, at: Any, n: int) -> tuple[FloatArray, FloatArray]:
        d = self.density.d
        self._program_of_widths.run(
            "adaptive_widths", self._global(n), (self._runtime.group,),
            np.uint32(n), np.uint32(n), at, self._spline_counts, np.int32(BORDER), self._spline, self._found,
        )  # fmt: skip
        found = self._runtime.download(self._found, np.empty((d + 1, n), self._real)).astype(np.float64)
        return np.exp(found[0]), found[1:].T

    def __call__(self, x: FloatArray) -> AdaptiveGradient:
        """Evaluate the energy and its gradient.

        Parameters
        ----------
        x : (n, d) float64
            Points within the density, in pixels.

        Returns
        -------
        AdaptiveGradient
        """
        at = self._runtime.upload(x.T.astype(self._real))
        widths, slopes = self._widths(at, self.n)
        variances = widths**2
        pulled = self._pull(at, variances)
        pushed = self._push(x, variances)
        d = self.density.d
        by_place, by_variance = pushed[:d] - pulled[:d], pushed[d] - pulled[d]
        gradient = by_place.T + (2 * variances * by_variance)[:, None] * slopes
        energy = 0.5 * pushed[d + 1].sum() - pulled[d + 1].sum()
        # E sums Gaussians of unit mass; a density's unit of E is rho (4 pi s^2)^(-d/2) of the uniform kernel.
        spacings = math.sqrt(2) / self.sigma * widths
        stiffness = (4 * math.pi * variances) ** (-d / 2) / spacings**2
        return AdaptiveGradient(float(energy), gradient, widths, spacings, stiffness)

    def pull(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Look up what the density draws kernels with at any number of places.

        Parameters
        ----------
        x : (m, d) float64
            Places within the density, in pixels.

        Returns
        -------
        widths : (m,) float64
            Of kernels there, in pixels.
        pulls : (m,) float64
            G_{s^2} * T there.
        """
        widths, pulls = np.empty(len(x)), np.empty(len(x))
        for first in range(0, len(x), self.n):
            some = x[first : first + self.n]
            filled = np.concatenate([some, np.broadcast_to(x[0], (self.n - len(some), x.shape[1]))])
            at = self._runtime.upload(filled.T.astype(self._real))
            found = self._widths(at, self.n)[0]
            widths[first : first + self.n] = found[: len(some)]
            pulls[first : first + self.n] = self._pull(at, found**2)[self.density.d + 1, : len(some)]
        return widths, pulls

    def allowed(self, x: FloatArray, widths: FloatArray) -> NDArray[np.bool_]:
        """Tell which places have ink, and kernels not much wider than before.

        Parameters
        ----------
        x : (n, d) float64
            Places within the density, in pixels.
        widths : (n,) float64
            Of the kernels before.

        Returns
        -------
        (n,) bool
        """
        inked = self.density.values[pixels_of(self.density, x)] > 0
        allowed: NDArray[np.bool_] = inked & (self.widths(x)[0] < WIDER * widths)
        return allowed

    def _pull(self, at: Any, variances: FloatArray) -> FloatArray:
        rt, n = self._runtime, self.n
        self._program_of_pull.run(
            "adaptive_pull", self._global(n), (rt.group,),
            np.uint32(n), np.uint32(n), at, rt.upload(variances.astype(self._real)), *self._levels,
            self._found,
        )  # fmt: skip
        return self._download()

    def _push(self, x: FloatArray, variances: FloatArray) -> FloatArray:
        rt, n = self._runtime, self.n
        torus = self.density.shape if self.density.toroidal else None
        reach = REACH[self._precision]
        grid = neighbour_grid(x, variances, reach, torus)
        lanes = rt.lanes(self._precision)
        stride = grid.places.shape[1] + lanes
        places = np.zeros((self.density.d, stride), self._real)
        places[:, : stride - lanes] = grid.places
        sources = np.ones(stride, self._real)
        sources[: stride - lanes] = grid.variances
        chunk = CHUNK if rt.device.is_cpu else 1
        group = 1 if rt.device.is_cpu else rt.group
        items = -(-n // chunk)
        self._program_of_pairs.run(
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
            rt.upload(grid.sides.astype(self._real)),
            rt.upload(grid.widest.astype(self._real)),
            rt.upload(grid.counts),
            rt.upload(grid.offsets),
            rt.upload(grid.starts),
            self._real(reach),
            self._found,
        )
        found = np.empty((self.density.d + 2, n))
        found[:, grid.points] = self._download()
        return found

    def _download(self) -> FloatArray:
        out = np.empty((self.density.d + 2, self.n), self._real)
        return self._runtime.download(self._found, out).astype(np.float64)

    def _global(self, n: int) -> tuple[int]:
        return (-(-n // self._runtime.group) * self._runtime.group,)
