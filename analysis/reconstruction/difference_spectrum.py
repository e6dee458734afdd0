"""Power of a set less its density: of the whole domain, or of a part of it seen through a taper.

J(f) = sum over points of h(u) exp(-2 pi i f u) less the integral of rho h exp(-2 pi i f u), u being fractions
of the domain's sides and rho the density in points. P(f) = |J(f)|^2 / integral of rho h^2 is 1 in expectation
for independent points of this density; where rho is constant and h = 1 it is the periodogram of the points.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.results.radial import RadialPower
from gbnbench.core.torus import FloatArray

ComplexArray = NDArray[np.complex128]

NU_MAX = 1.5  # frequencies over one over the mean spacing
MOST_PRODUCTS = 2e10  # of points and frequencies: some ten seconds
BATCH = 4096  # points summed at once
# The taper of Blackman and Harris in four terms: beyond 4 cycles its transform is below 3e-5 of its largest
# value (Harris 1978).
TAPER = (0.35875, -0.48829, 0.14128, -0.01168)
RESOLVED = 4  # cycles within which the taper mixes frequencies


def difference_power(
    points: FloatArray, density: FloatArray, *, tapered: bool = False, nu_max: float = NU_MAX
) -> tuple[FloatArray, FloatArray]:
    """Power of the difference at whole frequencies of the domain.

    Parameters
    ----------
    points : (n, 2) float64
        In pixels, within the domain.
    density : (rows, columns) float64
        Points expected in each pixel; they need not add up to n where the domain is part of a larger one.
    tapered : bool
        See the domain through the taper of Blackman and Harris along each axis, so that its borders bring no
        power; frequencies within 4 cycles of each other are mixed then.
    nu_max : float
        Largest frequency, over one over the spacing; less where it would take more than some ten seconds.

    Returns
    -------
    nu : (2 F_0 + 1, 2 F_1 + 1) float64
        Length of each frequency, cycles a pixel, times the mean spacing; 0 in the middle.
    power : float64 of the same shape
        1 in expectation for independent points.
    """
    sides = np.array(density.shape, np.float64)
    total = float(density.sum())
    spacing = math.sqrt(float(sides.prod()) / total)
    affordable = math.sqrt(MOST_PRODUCTS / 2 / max(len(points), 1) / float(sides.prod())) * spacing
    harmonics = np.maximum(1, np.floor(min(nu_max, affordable) * sides / spacing)).astype(int)
    terms = np.array(TAPER)[np.abs(np.arange(-3, 4))] * [0.5, 0.5, 0.5, 1, 0.5, 0.5, 0.5]
    coefficients = terms if tapered else np.ones(1)
    found = _of_points(points / sides, harmonics, coefficients)
    found -= _of_pixels(density, harmonics, coefficients)
    squares = np.convolve(coefficients, coefficients)
    mass = float(_of_pixels(density, np.zeros(2, int), squares)[0, 0].real)
    half = np.abs(found) ** 2 / mass
    power = np.concatenate([half[::-1, :0:-1], half], axis=1)
    down, across = (np.arange(-f, f + 1) * (spacing / side) for f, side in zip(harmonics, sides, strict=True))
    nu: FloatArray = np.hypot(down[:, None], across)
    return nu, power


def annular_power(nu: FloatArray, power: FloatArray, step: float) -> RadialPower:
    """Mean power over annuli, as far as the frequencies reach in every direction.

    Parameters
    ----------
    nu, power : (2 F_0 + 1, 2 F_1 + 1) float64
        As ``difference_power`` gives them.
    step : float
        Width of an annulus in nu; the first begins at half of it.

    Returns
    -------
    RadialPower
        A row an annulus that holds a frequency; ``frequency`` is in annuli.
    """
    reach = min(float(nu[0].min()), float(nu[:, 0].min()))
    number = np.floor(nu / step + 0.5).astype(np.int64)
    kept = (nu > 0) & (nu <= reach) & (number > 0)
    count = np.bincount(number[kept])
    some = np.flatnonzero(count)
    means = [np.bincount(number[kept], values[kept])[some] / count[some] for values in (nu, power)]
    return RadialPower(means[0] / step, means[0], means[1], count[some])


def _of_points(u: FloatArray, harmonics: NDArray[np.int_], coefficients: FloatArray) -> ComplexArray:
    """Sum h(u) exp(-2 pi i f u) over points, for f_0 of both signs and f_1 >= 0."""
    taper = np.arange(len(coefficients)) - len(coefficients) // 2
    total = np.zeros((2 * harmonics[0] + 1, harmonics[1] + 1), np.complex128)
    for first in range(0, len(u), BATCH):
        some = u[first : first + BATCH]
        lines = []
        for a, f in enumerate(_frequencies(harmonics)):
            h = np.cos(2 * np.pi * taper[:, None] * some[:, a]).T @ coefficients
            lines.append(np.exp(-2j * np.pi * f[:, None] * some[:, a]) * h)
        total += lines[0] @ lines[1].T
    return total


def _of_pixels(density: FloatArray, harmonics: NDArray[np.int_], coefficients: FloatArray) -> ComplexArray:
    """Integrate the same over square pixels, each of one density: without error."""
    taper = np.arange(len(coefficients)) - len(coefficients) // 2
    lines = []
    for f, count in zip(_frequencies(harmonics), density.shape, strict=True):
        centres = (np.arange(count) + 0.5) / count
        line = np.zeros((len(f), count), np.complex128)
        for c, j in zip(coefficients, taper, strict=True):
            g = f - j  # h is a sum of c exp(2 pi i j u)
            line += c * np.sinc(g / count)[:, None] * np.exp(-2j * np.pi * g[:, None] * centres)
        lines.append(line)
    return np.asarray(lines[0] @ density @ lines[1].T, np.complex128)


def _frequencies(harmonics: NDArray[np.int_]) -> tuple[FloatArray, FloatArray]:
    return (
        np.arange(-harmonics[0], harmonics[0] + 1, dtype=np.float64),
        np.arange(harmonics[1] + 1, dtype=np.float64),
    )
