"""Energies of kernels with a power-law transform on the torus, by Ewald's sum (Ewald 1921; Crandall 1998)."""

from __future__ import annotations

import math

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.mesh_sums import MeshEnergy

EXPONENT = 20.0  # both sums stop where their Gaussians fall below exp(-EXPONENT) = 2e-9
CUT = 3.0  # spacings that the sum over pairs reaches


class EwaldEnergy:
    """Sum over pairs of the kernel whose transform is k**(-d - t), periodised, less the uniform density.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    t : float
        -d < t <= 2: 0 is the logarithm -log r, 1 the distance -r, -s the power r**-s, but for a factor; t =
        2 - d is electrostatics in d dimensions.

    Attributes
    ----------
    side : float
        Of the box, in spacings.

    Notes
    -----
    k**-a, a = d + t, is an integral over Gaussians exp(-u k**2) of all widths u. Those wider than u0 are
    summed over frequencies, with weights k**-a Q(a/2, u0 k**2), Q the regularised upper incomplete gamma
    function; narrower ones over pairs, where s = -t and
    phi(r) = (4 pi)**(-d/2) / Gamma(a/2) (r/2)**-s Gamma(s/2, r**2 / 4 u0). Errors of the
    gradient are some 1e-7 of its largest component.
    """

    def __init__(self, n: int, d: int, t: float) -> None:
        from scipy.special import gammaincc

        self.n, self.d, self.power = n, d, -t
        self.side = n ** (1 / d)
        self.cut = min(CUT, 0.499 * self.side)
        self._width = self.cut**2 / (4 * EXPONENT)
        self._scale = (4 * math.pi) ** (-d / 2) / math.gamma((d + t) / 2) * 2**-t
        fmax = math.ceil(math.sqrt(EXPONENT / self._width) * self.side / (2 * math.pi))
        square = sum(np.ix_(*[np.arange(fmax + 1.0) ** 2] * d)) * (2 * math.pi / self.side) ** 2
        square[(0,) * d] = 1.0  # which the mesh leaves out
        weights = square ** (-(d + t) / 2) * gammaincc((d + t) / 2, self._width * square)
        self._far = MeshEnergy(weights, n)

    def __call__(self, x: FloatArray) -> tuple[float, FloatArray]:
        """Evaluate.

        Parameters
        ----------
        x : (n, d) float64
            Points in [0, 1).

        Returns
        -------
        energy : float
            But for a constant: what each point has with itself.
        gradient : (n, d) float64
            By the coordinates in spacings.
        """
        from scipy.spatial import cKDTree

        energy, gradient = self._far(x)
        pairs = cKDTree(x, boxsize=np.ones(self.d)).query_pairs(self.cut / self.side, output_type="ndarray")
        i, j = pairs[:, 0], pairs[:, 1]
        apart = x[i] - x[j]
        apart = (apart - np.round(apart)) * self.side
        square = np.maximum(np.einsum("pa,pa->p", apart, apart), 1e-24)
        value, slope = self._near(square)
        pull = (slope / np.sqrt(square))[:, None] * apart
        for axis in range(self.d):
            gradient[:, axis] += np.bincount(i, pull[:, axis], self.n) - np.bincount(j, pull[:, axis], self.n)
        return energy + float(value.sum()), gradient

    def _near(self, square: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Kernel of pairs and its derivative at squared distances."""
        from scipy.special import exp1, gammaincc

        s, z, r = self.power, square / (4 * self._width), np.sqrt(square)
        following = math.gamma(s / 2 + 1) * gammaincc(s / 2 + 1, z)  # Gamma(s/2 + 1, z)
        incomplete = exp1(z) if s == 0 else (following - z ** (s / 2) * np.exp(-z)) / (s / 2)
        value = self._scale * r**-s * incomplete
        return np.asarray(value), np.asarray(-2 * self._scale * following * r ** (-s - 1))
