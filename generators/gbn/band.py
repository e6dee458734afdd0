"""The Gaussian energy truncated to the frequencies below an edge (Ahmed, Ren & Wonka 2022, Eq. 23, Supplement B).

Without the harmonics from the edge on, the least energy is no longer a lattice's alone: every set whose power is 0
below the edge has it, and there are disordered ones while the edge binds fewer numbers than there are coordinates.
"""

from __future__ import annotations

import math

import numpy as np

from gbnbench.generators.gbn.field import Gradient
from gbnbench.generators.newton.modes import modes
from gbnbench.generators.newton.waves import Waves
from gbnbench.torus import FloatArray


class BandField:
    """Energy of the frequencies with 0 < nu < edge alone: Ex = (1 / 2n) sum over both halves of w_f P(f).

    Attributes
    ----------
    method : str
        The evaluation.
    error : float
        Bound on the error of a gradient's component; see ``Field``.
    curvature : float
        Largest below the edge, at a uniform density; 0 where there is no frequency.
    weight : (m,) float64
        (2 pi)^(d/2) sigma^d exp(-2 pi^2 sigma^2 nu^2) of each pair f, -f.
    """

    def __init__(self, n: int, d: int, sigma: float, edge: float) -> None:
        self.method = "harmonics below the edge"
        self.error = 1e-14
        self._side = math.pow(n, 1 / d)
        self._modes = modes(n, d, edge)
        scale = (math.sqrt(2 * math.pi) * sigma) ** d
        self.weight = scale * np.exp(-((sigma * self._modes.length) ** 2) / 2)
        self.curvature = float((self._modes.length**2 * self.weight).max(initial=0.0))

    def __call__(self, x: FloatArray) -> Gradient:
        """Gradient and excess energy at x, (sets, n, d) float64 in box sides; see ``Field``."""
        gradient, excess = np.zeros_like(x), np.zeros(len(x))
        if not len(self._modes):
            return Gradient(gradient, excess)
        n = x.shape[1]
        for s, each in enumerate(x):
            waves = Waves(each - np.floor(each), self._modes.f)
            amplitudes = waves.amplitudes()
            # E = (1/n) sum over the half space of w |F|^2, so dE/du_k = (2/n) Re(conj(F) dF/du_k) summed
            gradient[s] = waves.gradient(2 * self.weight * amplitudes / n, self._side)
            excess[s] = np.sum(self.weight * np.abs(amplitudes) ** 2) / n**2
        return Gradient(gradient, excess)
