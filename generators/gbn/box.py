"""Gaussian Blue Noise of the bounded box [0, 1)^d, without periods (Ahmed, Ren & Wonka 2022, Sec. 4.6).

The points repel one another, and the domain, a continuum of density 1 a spacing^d, attracts them. In spacings
u = x n^(1/d), with L = n^(1/d) and g(r) = exp(-r^2 / 2 sigma^2),

    n Ex = 1/2 sum over k, l of g(u_k - u_l) - sum over k of V(u_k) + 1/2 W,

V(u) being the integral of g(u - v) over the domain and W that of V: the energy of the points less that of the
uniform density, a positive definite form, so that Ex >= 0.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.special import erf

from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn import operation_counts
from gbnbench.generators.gbn.images import Images
from gbnbench.generators.gbn.protocol import EnergyGradient
from gbnbench.generators.gbn.step_sizes import largest_curvature
from gbnbench.generators.gbn.strips import Strips
from gbnbench.opencl import runtime

LARGEST = 1 - 2.0**-53  # the last double below 1
WIDE = 8.0  # sigmas a side from which the faces do not change the largest curvature


def fold(x: FloatArray) -> FloatArray:
    """Bring coordinates into [0, 1) by reflection at the faces: a path that leaves comes back mirrored.

    Examples
    --------
    >>> fold(np.array([-0.25, 0.25, 1.25, 2.25]))
    array([0.25, 0.25, 0.75, 0.25])
    """
    turn = np.mod(x, 2.0)
    return np.minimum(np.where(turn < 1, turn, 2 - turn), LARGEST)


def domain_pull(u: FloatArray, side: float, sigma: float) -> tuple[FloatArray, FloatArray]:
    """Potential V of the uniform domain and its gradient.

    Parameters
    ----------
    u : (..., d) float64
        Places, in spacings.
    side : float
        Of the box, in spacings.
    sigma : float
        Of the kernel, in spacings.

    Returns
    -------
    potential : (...) float64
        Product over dimensions of sigma sqrt(pi/2) [erf((L - u_a) / s) + erf(u_a / s)], s = sqrt(2) sigma.
    gradient : (..., d) float64
        dV/du, which the points climb.

    Notes
    -----
    Eq. (24-26) with sigma there being 1/sqrt(2) of ours, as in the authors' program; the factor between pairs
    and domain, which Eq. (26) leaves open, is that of n points a domain.
    """
    near, far = u / (math.sqrt(2) * sigma), (side - u) / (math.sqrt(2) * sigma)
    along = sigma * math.sqrt(math.pi / 2) * (erf(near) + erf(far))
    slope = np.exp(-(near**2)) - np.exp(-(far**2))
    d = u.shape[-1]
    before, after = np.ones_like(u), np.ones_like(u)  # products of the others: no division by a small V
    for a in range(1, d):
        before[..., a] = before[..., a - 1] * along[..., a - 1]
        after[..., d - 1 - a] = after[..., d - a] * along[..., d - a]
    return np.prod(along, axis=-1), slope * before * after


def domain_energy(side: float, d: int, sigma: float) -> float:
    """Energy W of the uniform domain with itself.

    Parameters
    ----------
    side : float
        Of the box, in spacings.
    d : int
        Dimension.
    sigma : float
        Kernel width, in spacings.

    Returns
    -------
    float
        (sqrt(2 pi) sigma L erf(t) - 2 sigma^2 (1 - exp(-t^2)))^d, t = L / sqrt(2) sigma.
    """
    reach = side / (math.sqrt(2) * sigma)
    axis = math.sqrt(2 * math.pi) * sigma * side * math.erf(reach) + 2 * sigma**2 * math.expm1(-(reach**2))
    return axis**d


def box_curvature(n: int, d: int, sigma: float) -> float:
    """Largest curvature of the energy at a uniform density, as ``largest_curvature`` is on the torus.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    sigma : float
        Kernel width, in spacings.

    Returns
    -------
    float

    Notes
    -----
    The torus's where the box is at least 8 sigma wide. Else the largest over displacements that are, along
    each of j axes, phi(u_a) times chi(u_b) of every other axis: (A B + (j - 1) C^2) B^(j - 2) B_0^(d - j),
    phi being an eigenfunction of the kernel -g'', A its eigenvalue, chi one of g, B its eigenvalue and B_0
    the largest, and C = <phi, g' chi>. In high dimension the breathing of all axes at once is the stiffest.
    """
    side = n ** (1 / d)
    if side >= WIDE * sigma:
        return largest_curvature(n, d, sigma)
    nodes, weights = np.polynomial.legendre.leggauss(64)
    root = np.sqrt(weights * side / 2)
    apart = (nodes[:, None] - nodes) * side / 2
    kernel = np.exp(-(apart**2) / (2 * sigma**2)) * root[:, None] * root
    density, flat = np.linalg.eigh(kernel)
    stiff, along = np.linalg.eigh((1 - apart**2 / sigma**2) / sigma**2 * kernel)
    A, B = stiff[:-4:-1, None, None], density[None, :-4:-1, None]
    C = (along.T @ (-apart / sigma**2 * kernel) @ flat)[:-4:-1, :-4:-1, None]
    j = np.arange(1, d + 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        curvature = (A + (j - 1) * C**2 / B) * B ** (j - 1) * density[-1] ** (d - j)
    return float(np.nanmax(curvature))


class BoxEnergy:
    """The box's energy for any x: a coordinate beyond a face stands for its mirror image inside.

    So the energy is defined wherever an optimiser's step may lead, as on the torus it is by periods, and
    ``fold`` tells where the points are. The pull alone does not keep points inside: a large step, or a start
    on the border, leads out.

    Attributes
    ----------
    method : str
        The evaluation of the pairs.
    error : float
        Bound on the error of a gradient's component, in units of the largest force of one pair: n pairs
        that all round alike, as those of tight clusters do. Scattered points come to a root of it.
    curvature : float
        Largest, at a uniform density.
    mirrored : int
        Coordinates that the last call met beyond a face: those that crossed one an odd number of times.
    """

    def __init__(self, n: int, d: int, sigma: float, precision: str | None = None) -> None:
        chosen = runtime()
        name = precision or ("double" if chosen.device.has_double else "float")
        self.n, self.d, self.sigma, self.side = n, d, sigma, n ** (1 / d)
        self.curvature = box_curvature(n, d, sigma)
        self.mirrored = 0
        self._least = domain_energy(self.side, d, sigma)
        # On a torus with an empty margin as wide as the cut-off no point meets the image of another; twice
        # as wide as the box, and no nearest image is ever across its border.
        reach = operation_counts.CUTOFF[name] * sigma
        margin = (max(self.side, reach) + reach) * operation_counts.MARGIN
        twice = 2 * max(self.side, reach) * operation_counts.MARGIN
        strips, images = operation_counts.strips, operation_counts.images(n, d, sigma, name, twice)
        self._torus: Strips | Images
        if d <= 3 and strips(n, d, sigma, name, side=margin).effort < images.effort:
            self._torus = Strips(chosen, n, d, sigma, name, side=margin)
        else:
            self._torus = Images(chosen, n, d, sigma, name, twice)
        self.method = f"box, {self._torus.method}"
        self.error = 2 * self._torus.error

    @property
    def anchor(self) -> FloatArray | None:
        """Points as the strips were last sorted; see ``Strips``."""
        return self._torus.anchor if isinstance(self._torus, Strips) else None

    @anchor.setter
    def anchor(self, x: FloatArray) -> None:
        """Go on as if the points had last been sorted at x."""
        if isinstance(self._torus, Strips):
            self._torus.anchor = x

    def __call__(self, x: FloatArray) -> EnergyGradient:
        """Gradient and excess energy at x, (sets, n, d) float64 in box sides; see ``EnergyEvaluation``."""
        mirrored = np.mod(x, 2.0) >= 1
        self.mirrored = int(np.count_nonzero((x < 0) | (x >= 1)))
        inside = fold(x)
        pairs = self._torus(inside * (self.side / self._torus.side))
        potential, pull = domain_pull(inside * self.side, self.side, self.sigma)
        gradient = pairs.gradient - pull
        gradient[mirrored] *= -1
        domain = potential.sum(axis=1) - self._least / 2
        excess = pairs.excess - domain / self.n
        return EnergyGradient(gradient, excess)
