"""Adaptive Gaussian Blue Noise as a generator (Ahmed, Ren & Wonka 2022, Sections 4.10 and 5.3)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.gbn.descent import descend
from gbnbench.generators.adaptive.gbn.energy import RESOLUTION, AdaptiveEnergy
from gbnbench.generators.adaptive.hilbert_start import hilbert_start
from gbnbench.generators.adaptive.method import AdaptiveMethod, too_fine
from gbnbench.generators.adaptive.protocol import Told
from gbnbench.opencl import runtime


@dataclass(frozen=True)
class AdaptiveGaussianBlueNoise(AdaptiveMethod):
    """Gaussian blue noise whose kernels are as wide as the density wants them.

    Parameters
    ----------
    sigma : float
        Kernel width in local spacings, 0.5 to 1.5. Below 1 pictures are sharper and their grain rougher.
    smoothing : float
        c: the density is averaged over c times the kernels' width to give them their width, 0.1 to 2.
    spread : float
        t: pixels attract as if spread over t times the kernels' width there, 0 to 1. At 1 the set has the
        density and the uniform method's spectrum; below, edges are sharpened, and at 0 points gather in
        clumps.
    gradients : int
        How many, at least 0.
    precision : {"float", "double"}
        Of the sums over neighbours and pixels.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    What differs from the publication: kernel widths are a field of the density in place of shaping factors
    that each step makes anew (``kernel_widths``), pixels are squares, spread by a part of the kernels' width
    (``attraction``), points start along a Hilbert curve, and Nesterov's method takes the place of 300 to
    1,000 steps of descent. The energy is the paper's variance, Eq. 29 and 47.

    References
    ----------
    Ahmed, Ren & Wonka, "Gaussian blue noise", ACM Trans. Graph. 41(6), 2022.

    Examples
    --------
    >>> from gbnbench.generators.adaptive.density import as_density
    >>> ramp = as_density(np.linspace(0, 1, 32)[:, None] * np.ones(32))
    >>> AdaptiveGaussianBlueNoise(gradients=5)(ramp, 50, np.random.default_rng(0)).shape
    (50, 2)
    """

    name: ClassVar[str] = "gbn"
    summary: ClassVar[str] = "adaptive Gaussian blue noise (Ahmed, Ren & Wonka 2022)"
    reference: ClassVar[str] = "Ahmed, Ren & Wonka, Gaussian blue noise, 2022"
    sigma: float = 0.8
    smoothing: float = 0.5
    spread: float = 0.3
    gradients: int = 100
    precision: Literal["float", "double"] = "float"

    def __post_init__(self) -> None:
        for name, least, most in (("sigma", 0.5, 1.5), ("smoothing", 0.1, 2), ("spread", 0, 1)):
            if not least <= getattr(self, name) <= most:
                raise InputError(f"{name} must be from {least} to {most}; got {getattr(self, name)}")
        if self.gradients < 0:
            raise InputError(f"gradients must be >= 0; got {self.gradients}")

    def refusal(self, density: Density, n: int) -> str | None:
        """Say why pixels cannot be cut finely enough, as ``AdaptiveMethod.refusal`` does."""
        return too_fine(density, n, density.values.size * self._parts(density, n) ** density.d)

    def _parts(self, density: Density, n: int) -> int:
        """Parts of a pixel's side that make pixels finer than the narrowest kernel."""
        narrowest = self.sigma / math.sqrt(2) / float(density.of_points(n).max()) ** (1 / density.d)
        parts: int = math.ceil(RESOLUTION[self.precision] / narrowest)
        return parts

    def one_set(self, density: Density, n: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one set, as ``AdaptiveMethod.one_set`` describes it."""
        parts = self._parts(density, n)
        fine = density.finer(parts)
        x = hilbert_start(density, n, rng) * parts
        if self.gradients:
            energy = AdaptiveEnergy(
                runtime(),
                fine,
                n,
                sigma=self.sigma,
                smoothing=self.smoothing,
                spread=self.spread,
                precision=self.precision,
            )
            steps = self.gradients
            x = descend(energy, x, steps, lambda done, _: told(done, steps, "gradients of gbn"))
        return x / parts
