"""Spectral sampling with Gaussian kernels on the uniform torus (Öztireli, Alexa & Gross 2010)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.kernel_based.steady_inverse import steady_inverse
from gbnbench.generators.protocol import MOST_ITERATIONS, Family
from gbnbench.generators.ranges import check_above, check_range, too_many, too_many_axes
from gbnbench.generators.set_by_set import SetBySet, Told

CANDIDATES = 4  # uniform points from which one is chosen
REACH = 8.5  # sigmas, beyond which a Gaussian is rounding
LONGEST = 0.5  # spacings a step
MOST = 4096


@dataclass(frozen=True)
class SpectralSampling(SetBySet):
    """Points that each add most to the span of the Gaussians on all: chosen among many, then moved uphill.

    Parameters
    ----------
    iterations : int
        Steps of gradient ascent, >= 0; the publication takes about ten.
    sigma : float
        Width of the Gaussians in spacings, 0.5 to 1.5; the publication's is about 1.
    step : float
        Displacement over gradient, in squared spacings, above 0 and at most 2.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    A point adds s = k(x, x) - k' inv(K) k to what the others span, k its kernels with them and K theirs among
    themselves: how much it changes the spectrum of the manifold's Laplacian. Out of 4 n uniform points, in
    place of the publication's dense input, n are chosen one after another where s is largest (a pivoted
    Cholesky decomposition; the publication accepts in random order above a threshold, which makes no given
    n). Then all move along the gradient of their own s; the step's length is ours. The publication keeps near
    neighbours alone; here all kernels and their images count, and the cost
    grows as n**3.

    References
    ----------
    Öztireli, Alexa & Gross, "Spectral sampling of manifolds", ACM Trans. Graphics 29(6), 2010.

    Examples
    --------
    >>> SpectralSampling(iterations=2)(16, 2, np.random.default_rng(0)).shape
    (16, 2)
    """

    name: ClassVar[str] = "oztireli"
    summary: ClassVar[str] = "spectral sampling with Gaussian kernels, d <= 3 (Öztireli, Alexa & Gross 2010)"
    family: ClassVar[Family] = "kernel-based"
    dimensions: ClassVar[tuple[int, int | None]] = (1, 3)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Öztireli, Alexa & Gross, Spectral sampling of manifolds, 2010"
    iterations: int = 10
    sigma: float = 1.0
    step: float = 0.5

    def __post_init__(self) -> None:
        check_range("iterations", self.iterations, 0, MOST_ITERATIONS)
        check_range("sigma", self.sigma, 0.5, 1.5, "spacings")
        check_above("step", self.step, 0, 2, "squared spacings")

    def refusal(self, n: int, d: int) -> str | None:
        """Say why the kernels' matrix cannot be had.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason; None for d <= 3 and n whose matrix is inverted in minutes.
        """
        return too_many_axes(d, 3, "for spectral sampling") or too_many(
            n, MOST, "for spectral sampling, which inverts n**2 kernels"
        )

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        side = n ** (1 / d)
        width = self.sigma / side
        x = most_independent(rng.random((CANDIDATES * n, d)), n, width)
        for done in range(self.iterations):
            told((done + 1) / (self.iterations + 1))
            step = self.step / side**2 * span_gradient(x, width)[1]
            length = np.linalg.norm(step, axis=1, keepdims=True) * side
            x = wrap(x + step / np.maximum(length / LONGEST, 1.0))
        return x


def kernels(x: FloatArray, y: FloatArray, width: float) -> tuple[FloatArray, FloatArray]:
    """Gaussians of points on points, with all images, and their slopes on each axis.

    Parameters
    ----------
    x : (n, d) float64
        In box sides.
    y : (m, d) float64
        In box sides.
    width : float
        In box sides.

    Returns
    -------
    value : (n, m) float64
    slope : (d, n, m) float64
        By the coordinates of x.
    """
    most = max(math.ceil(REACH * width - 0.5), 0)
    axes, slopes = [], []
    for axis in range(x.shape[1]):
        apart = x[:, None, axis] - y[None, :, axis]
        apart -= np.round(apart)
        value, slope = np.zeros(apart.shape), np.zeros(apart.shape)
        for turn in range(-most, most + 1):
            image = (apart + turn) / width
            gaussian = np.exp(-(image**2) / 2)
            value += gaussian
            slope -= image / width * gaussian
        axes.append(value)
        slopes.append(slope)
    product = np.prod(axes, axis=0)
    gradient = [
        slopes[axis] * np.prod([axes[other] for other in range(len(axes)) if other != axis], axis=0)
        for axis in range(len(axes))
    ]
    return product, np.stack(gradient)


def span_gradient(x: FloatArray, width: float) -> tuple[FloatArray, FloatArray]:
    """Find what each point adds to the span of the others, and its gradient by the point.

    Parameters
    ----------
    x : (n, d) float64
        In box sides.
    width : float
        Of the Gaussians, in box sides.

    Returns
    -------
    added : (n,) float64
        s, 1 over the diagonal of the inverse of the kernels' matrix.
    gradient : (n, d) float64
        In box sides.
    """
    value, slope = kernels(x, x, width)
    inverse = steady_inverse(value)
    added = 1 / np.diagonal(inverse)
    return added, 2 * np.einsum("nm,anm->na", inverse * added[:, None], slope)


def most_independent(x: FloatArray, n: int, width: float) -> FloatArray:
    """Choose points one after another, each where it adds most to the span of those before.

    Parameters
    ----------
    x : (candidates, d) float64
        In box sides.
    n : int
        How many.
    width : float
        Of the Gaussians, in box sides.

    Returns
    -------
    (n, d) float64
        In the order of choice.
    """
    left = np.full(len(x), kernels(x[:1], x[:1], width)[0][0, 0])
    factor = np.zeros((n, len(x)))
    chosen: list[int] = []
    for k in range(n):
        best = int(left.argmax())
        row = kernels(x[best, None], x, width)[0][0] - np.einsum("k,kc->c", factor[:k, best], factor[:k])
        factor[k] = row / math.sqrt(max(left[best], 1e-30))
        left -= factor[k] ** 2
        chosen.append(best)
        left[chosen] = -math.inf
    return np.asarray(x[chosen])
