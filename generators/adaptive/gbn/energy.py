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

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.domain import pixels_of
from gbnbench.generators.adaptive.gbn.attraction import attraction_levels
from gbnbench.generators.adaptive.gbn.gradient import AdaptiveGradient
from gbnbench.generators.adaptive.gbn.kernel_widths import kernel_widths
from gbnbench.generators.adaptive.gbn.pair_sums import PairSums
from gbnbench.generators.adaptive.gbn.pixel_blocks import in_blocks
from gbnbench.generators.adaptive.gbn.pull_sums import PullSums
from gbnbench.generators.adaptive.gbn.spline_field import SplineField
from gbnbench.opencl import Runtime

# Standard deviations after which a Gaussian ends, exp(-reach^2 / 2), and widths of a kernel over its level's
# cells, exp(-pi^2 resolution^2 / 2): 3e-7 in float, 1e-15 in double.
REACH = {"float": 5.5, "double": 8.3}
RESOLUTION = {"float": 1.75, "double": 2.65}
BLOCK_RESOLUTION = 2.5  # width of the narrowest kernel over the side of blocks of pixels, at least
BLOCK_AVERAGE = 1.2  # that of the average which gives it its width
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
    blocks : int
        Pixels along the sides of blocks in which they are summed first (``pixel_blocks``). Kernels are to be
        ``BLOCK_RESOLUTION`` blocks wide, and averages of ``smoothing`` times their width ``BLOCK_AVERAGE``.

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
        blocks: int = 1,
    ) -> None:
        self.density, self.sigma, self.n, self._block = density, sigma, n, blocks
        cells = in_blocks(density, blocks)
        self._runtime, self._precision = runtime, precision
        self._real = np.float64 if precision == "double" else np.float32
        d = density.d
        found = kernel_widths(density, n, sigma, smoothing, block=blocks)
        defines = {
            "DOUBLE": int(precision == "double"),
            "LANES": runtime.lanes(precision),
            "SUM": "double" if runtime.device.has_double else "float",
            "AXES": d,
        }
        self._log_width = SplineField(runtime, found.coefficients, n, defines)
        reach, resolution = REACH[precision], RESOLUTION[precision]
        levels = attraction_levels(density, n, found, spread, resolution, reach, blocks)
        self._pull = PullSums(runtime, levels, n, defines, resolution, reach)
        self._push = PairSums(runtime, n, cells.shape if density.toroidal else None, defines, reach)

    def widths(self, x: FloatArray) -> FloatArray:
        """Look up the width of kernels.

        Parameters
        ----------
        x : (m, d) float64
            At most n positions within the density, in pixels.

        Returns
        -------
        (m,) float64
            In pixels.
        """
        return np.asarray(np.exp(self._log_width(self._upload(x), len(x))[0]) * self._block)

    def _upload(self, x: FloatArray) -> Any:
        return self._runtime.upload((x.T / self._block).astype(self._real))

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
        at, n, d = self._upload(x), self.n, self.density.d
        log_widths, slopes = self._log_width(at, n)
        widths, variances = np.exp(log_widths), np.exp(2 * log_widths)
        pushed, pulled = self._push(x / self._block, variances), self._pull(at, variances)
        excess = pushed - pulled  # of A over T, as the kernel sees it
        gradient = (excess[:d].T + (2 * variances * excess[d])[:, None] * slopes) / self._block ** (d + 1)
        energy = (0.5 * pushed[d + 1] - pulled[d + 1]).sum() / self._block**d
        widths, variances = widths * self._block, variances * self._block**2
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
            at = self._upload(filled)
            found = np.exp(self._log_width(at, self.n)[0])
            widths[first : first + self.n] = found[: len(some)] * self._block
            pulls[first : first + self.n] = self._pull(at, found**2)[self.density.d + 1, : len(some)]
        pulls /= self._block**self.density.d
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
        allowed: NDArray[np.bool_] = inked & (self.widths(x) < WIDER * widths)
        return allowed
