"""Gaussian Blue Noise of the bounded box [0, 1)^d, without periods (Ahmed, Ren & Wonka 2022, Sec. 4.6).

The points repel one another, and the domain, a continuum of density 1 a spacing^d, attracts them. In spacings
u = x n^(1/d), with L = n^(1/d) and g(r) = exp(-r^2 / 2 sigma^2),

    n Ex = 1/2 sum over k, l of g(u_k - u_l) - sum over k of V(u_k) + 1/2 W,

V(u) being the integral of g(u - v) over the domain and W that of V: the energy of the points less that of the
uniform density, a positive definite form, so that Ex >= 0.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import erf

from gbnbench.generators.gbn.field import Gradient
from gbnbench.generators.gbn.optimiser import largest_curvature
from gbnbench.generators.gbn.pencils import Runs, all_pairs, pair_share, pencils
from gbnbench.opencl import runtime
from gbnbench.torus import FloatArray

PACKAGE = "gbnbench.generators"
CUTOFF = {"double": 9.0, "float": 6.0}  # sigmas beyond which a pair adds less than the precision
WORTH = 0.5  # share of all pairs below which sorting pays
FIXED = 2.0**31  # units of a box side, of positions in float
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
    """W = (sqrt(2 pi) sigma L erf(t) - 2 sigma^2 (1 - exp(-t^2)))^d, t = L / sqrt(2) sigma."""
    reach = side / (math.sqrt(2) * sigma)
    axis = math.sqrt(2 * math.pi) * sigma * side * math.erf(reach) + 2 * sigma**2 * math.expm1(-(reach**2))
    return axis**d


def box_curvature(n: int, d: int, sigma: float) -> float:
    """Largest curvature of the energy at a uniform density, as ``largest_curvature`` is on the torus.

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


class BoxField:
    """The box's energy for any x: a coordinate beyond a face stands for its mirror image inside.

    So the energy is defined wherever an optimiser's step may lead, as on the torus it is by periods, and
    ``place`` tells where the points are. The pull alone does not keep points inside: a large step, or a start
    on the border, leads out.

    Attributes
    ----------
    method : str
        The evaluation of the pairs.
    error : float
        Bound on the error of a gradient's component, in units of the largest force of one pair, times
        n^(1/2).
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
        self.error = 2e-15 if name == "double" else 2e-6
        self.mirrored = 0
        self._runtime, self._double, self._lanes = chosen, name == "double", chosen.lanes(name)
        self._real: type[np.floating[Any]] = np.float64 if self._double else np.float32
        self._reach = CUTOFF[name] * sigma / self.side
        self._sorted = pair_share(d, self._reach) < WORTH
        self.method = "box, cut off" if self._sorted else "box, all pairs"
        defines = {"DOUBLE": int(self._double), "LANES": self._lanes, "DIM": d}
        self._kernels = chosen.program(PACKAGE, ("/vector.cl", "/exp.cl", "gbn_box.cl"), defines)
        self._least = domain_energy(self.side, d, sigma)

    def place(self, x: FloatArray) -> FloatArray:
        """Where the points are, in [0, 1): what an optimiser's result must be passed through."""
        return fold(x)

    def __call__(self, x: FloatArray) -> Gradient:
        """Gradient and excess energy at x, (sets, n, d) float64 in box sides; see ``Field``."""
        mirrored = np.mod(x, 2.0) >= 1
        self.mirrored = int(np.count_nonzero((x < 0) | (x >= 1)))
        inside = fold(x)
        force, pairs = self._pairs(inside)
        potential, pull = domain_pull(inside * self.side, self.side, self.sigma)
        gradient = force - pull
        gradient[mirrored] *= -1
        excess = (pairs / 2 - potential.sum(axis=1) + self._least / 2) / self.n
        return Gradient(gradient, excess)

    def _pairs(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Gradient (sets, n, d) and sum over k and l of the pairs (sets,)."""
        sets, n, d = x.shape
        lanes = self._lanes
        found = [pencils(each, self._reach, lanes) if self._sorted else all_pairs(n, lanes) for each in x]
        stride = sets * n + lanes  # the last group reads beyond its set
        rows = np.zeros((d, stride), np.float64)
        for s, (each, runs) in enumerate(zip(x, found, strict=True)):
            rows[:, s * n : (s + 1) * n] = each[runs.order].T
        places: NDArray[Any] = rows if self._double else np.floor(rows * FIXED).astype(np.uint32)
        first = np.concatenate([runs.first + s * n for s, runs in enumerate(found)]).astype(np.uint32)
        ranges = np.concatenate([runs.runs + s * n for s, runs in enumerate(found)]).astype(np.uint32)
        groups, each_row = ranges.shape[:2]
        chosen, itemsize = self._runtime, np.dtype(self._real).itemsize
        gradient, energy = (
            chosen.empty(d * groups * lanes * itemsize),
            chosen.empty(groups * lanes * itemsize),
        )
        held = chosen.upload(places), chosen.upload(first), chosen.upload(ranges)
        unit = self.side / self.sigma / (1.0 if self._double else FIXED)
        local = chosen.group
        self._kernels.run(
            "gbn_box",
            (-(-groups // local) * local,),
            (local,),
            held[0],
            np.uint32(stride),
            held[1],
            held[2],
            np.uint32(each_row),
            np.uint32(groups),
            self._real(unit),
            gradient,
            energy,
        )
        force = chosen.download(gradient, np.empty((d, groups * lanes), self._real)).astype(np.float64)
        total = chosen.download(energy, np.empty(groups * lanes, self._real)).astype(np.float64)
        return self._back(found, force / self.sigma, total)

    def _back(self, found: list[Runs], force: FloatArray, total: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Slots to points."""
        gradient = np.empty((len(found), self.n, self.d))
        pairs, begin = np.empty(len(found)), 0
        for s, runs in enumerate(found):
            slot = runs.slot + begin
            gradient[s, runs.order] = force[:, slot].T
            pairs[s] = np.sum(total[slot])
            begin += len(runs.first) * self._lanes
        return gradient, pairs
