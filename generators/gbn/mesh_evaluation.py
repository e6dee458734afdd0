"""The energy of any kernel of ``pair_kernels`` by sums over a mesh, as an evaluation of the optimisers."""

from __future__ import annotations

import numpy as np

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.gbn.ewald import EwaldEnergy
from gbnbench.generators.gbn.mesh_sums import MeshEnergy
from gbnbench.generators.gbn.pair_kernels import SINGULAR, exponent, smooth_weights
from gbnbench.generators.gbn.protocol import EnergyGradient

MOST = {1: 100_000, 2: 20_000, 3: 20_000}  # points, minutes of sums


class MeshEvaluation:
    """Energies of sets of n points under a kernel, in n log n; double precision, on the host.

    Parameters
    ----------
    kernel : str
        One of ``pair_kernels.KERNELS``.
    n, d : int
        Points and dimension, 1 to 3.
    sigma : float
        Of the kernels that have a width, in spacings.
    power : float
        Of "riesz".

    Attributes
    ----------
    method : str
        What is summed, as plans name it.
    error : float
        Of a gradient's component, over the largest.

    Notes
    -----
    Smooth kernels are sums over frequencies alone, singular ones are split by Ewald. The excess energy of a
    singular kernel lacks what each point has with itself, so that it may be negative, and is in units in
    which the transform is k**(-d - t).
    """

    def __init__(self, kernel: str, n: int, d: int, sigma: float, power: float) -> None:
        self._energy: MeshEnergy | EwaldEnergy
        if kernel in SINGULAR:
            self._energy = EwaldEnergy(n, d, exponent(kernel, power))
            self.method, self.error = f"Ewald's sum of {kernel}", 1e-7
        else:
            self._energy = MeshEnergy(smooth_weights(kernel, n, d, sigma), n)
            self.method, self.error = f"mesh sum of {kernel}", 1e-5 if kernel == "matern" else 1e-9

    def __call__(self, x: FloatArray) -> EnergyGradient:
        """Gradient and excess energy at x, (sets, n, d) float64 in box sides; see ``EnergyEvaluation``."""
        found = [self._energy(wrap(points)) for points in x]
        excess = np.array([energy for energy, _ in found]) / x.shape[1]
        return EnergyGradient(np.stack([gradient for _, gradient in found]), excess)
