"""Toroidal sums of Gaussians at random centres (Ahmed, Ren & Wonka 2022, Section 5.2)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.integration.integrands.kernel_values import (
    NUMPY_POINTS,
    coordinate_rows,
    evaluate,
    run_kernel,
)
from gbnbench.analysis.integration.integrands.limits import beyond_dimensions, check_count, check_share
from gbnbench.analysis.integration.integrands.theta_polynomial import NEAREST, circle, theta_polynomial
from gbnbench.analysis.precision import Precision
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.integer_frequencies import MOST_FREQUENCIES, half_ball, shell_counts
from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class Gaussians:
    """Sums of Gaussians exp(-r^2 / 2 width^2) on the torus, width = points^(-1/d) box sides.

    Attributes
    ----------
    count : int
        Gaussians of a sum, >= 1.
    points : int
        The width is the spacing of a grid of so many points, >= 1.

    Notes
    -----
    Eq. (33) prints sigma' = 512^(-1/d), "the variance of the Gaussians" set "to the nominal grid frequency of
    512 points". It is read as the width sigma' in exp(-r^2 / 2 sigma'^2): the symbol is the one the paper has
    for widths, whose unit is that spacing, and a variance would have to be its square.
    """

    name: ClassVar[str] = "gaussians"
    summary: ClassVar[str] = "toroidal sum of Gaussians at random centres (Ahmed, Ren & Wonka 2022, Eq. 33)"
    periodic: ClassVar[bool] = True
    count: int = 64
    points: int = 512

    def __post_init__(self) -> None:
        if self.count < 1:
            raise InputError(f"count of gaussians must be at least 1; got {self.count}")
        if self.points < 1:
            raise InputError(f"points of gaussians must be at least 1; got {self.points}")

    def refusal(self, d: int) -> str | None:
        """Return the reason why there are no such integrands in d dimensions, or None."""
        return beyond_dimensions("sums of Gaussians", d)

    def width(self, d: int) -> float:
        """Width of a Gaussian, in box sides."""
        return math.pow(self.points, -1 / d)

    def draw(self, d: int, rng: np.random.Generator) -> GaussianSum:
        """Draw a sum by uniform centres.

        Parameters, returns and errors are those of ``Family.draw``.
        """
        if reason := self.refusal(d):
            raise RefusalError(reason)
        return GaussianSum(rng.random((self.count, d)), self.width(d))

    def mean_energy(self, frequencies: NDArray[np.int64]) -> FloatArray:
        """Mean of ``energy`` over random centres at frequencies other than 0: (m, d) -> (m,)."""
        return self.count * gaussian_energy(frequencies, self.width(frequencies.shape[1]))

    def frequencies(self, d: int, share: float, most: int = MOST_FREQUENCIES) -> NDArray[np.int64]:
        """List half a ball of frequencies; those outside it hold less than a share of the mean energy.

        Parameters, returns and errors are those of ``Family.frequencies``.
        """
        check_share(share, self.refusal(d))
        decay = (2 * math.pi * self.width(d)) ** 2
        longest = 4
        while True:  # until what is not counted cannot matter
            squares, counts = shell_counts(d, longest)
            energy = counts * np.exp(-decay * squares)
            if energy[squares > longest // 4].sum() <= 1e-6 * share * energy[1:].sum():
                break
            longest *= 2
        outside = np.cumsum(energy[::-1])[::-1]  # at and beyond each shell
        last = int(np.flatnonzero(outside >= share * outside[1])[-1])
        check_count(
            f"the ball that leaves out {share:g} of the energy", d, counts[1 : last + 1].sum() / 2, most=most
        )
        return half_ball(d, int(squares[last]))


@dataclass(frozen=True, eq=False)
class GaussianSum:
    """One sum of Gaussians.

    Attributes
    ----------
    centres : (count, d) float64
        On the unit torus.
    width : float
        Width of each, in box sides.
    """

    centres: FloatArray
    width: float

    @property
    def integral(self) -> float:
        """The count times (2 pi)^(d/2) width^d: exact, since each is periodised."""
        count, d = self.centres.shape
        return float(count * (math.pow(2 * math.pi, d / 2) * math.pow(self.width, d)))

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values, (..., d) -> (...), to some 1e-15 of ``count`` times the largest of one Gaussian.

        Notes
        -----
        An OpenCL device of double precision computes, else numpy. Coordinates that are multiples of 2^-53
        lose nothing; others are rounded to such where a narrow Gaussian's nearest image lies across an edge.
        """
        return evaluate(self, x)

    def energy(self, frequencies: NDArray[np.int64]) -> FloatArray:
        """|transform|^2 at integer frequencies, (m, d) -> (m,)."""
        energy = gaussian_energy(frequencies, self.width)
        out = np.empty(len(frequencies))
        for begin in range(0, len(frequencies), NUMPY_POINTS):
            part = slice(begin, begin + NUMPY_POINTS)
            turns = np.zeros((len(frequencies[part]), len(self.centres)))
            for f, c in zip(frequencies[part].T, self.centres.T, strict=True):
                each = np.multiply.outer(f.astype(np.float64), c)
                turns += each - np.rint(each)
            phase = 2 * math.pi * turns
            out[part] = np.cos(phase).sum(axis=1) ** 2 + np.sin(phase).sum(axis=1) ** 2
        return out * energy

    def by_numpy(self, points: FloatArray) -> FloatArray:
        """Values at (n, d) points in numpy: the kernel's twin, in the same steps."""
        total = np.zeros(len(points))
        columns = [np.ascontiguousarray(column) for column in points.T]
        if not self.harmonics.size:
            for centre in self.centres:
                square = np.zeros(len(points))
                for column, c in zip(columns, centre, strict=True):
                    u = column - c
                    u -= np.rint(u)
                    square += u * u
                total += np.exp(square * (-1 / (2 * self.width**2)))
            return total
        circles = [circle(column) for column in columns]
        for centre in zip(*circle(self.centres), strict=True):
            product = np.full(len(points), self.scale)
            for (cosine, sine), c, s in zip(circles, *centre, strict=True):
                cosine_apart = cosine * c + sine * s
                theta = np.full(len(points), self.harmonics[-1])
                for coefficient in self.harmonics[-2::-1]:
                    theta *= cosine_apart
                    theta += coefficient
                product *= theta
            total += product
        return total

    def on_device(self, points: FloatArray, device: Precision) -> FloatArray:
        """Values by gaussians.cl.

        Parameters
        ----------
        points : (n, d) float64
            Points of the unit torus.
        device : Precision
            A device in double precision.

        Returns
        -------
        (n,) float64
            The sum at each point.
        """
        degree = max(len(self.harmonics) - 1, 0)
        rows = coordinate_rows(points, device, turns=degree > 0)
        if degree:
            centres, shape = np.stack(circle(self.centres), axis=-1), np.append(self.harmonics, self.scale)
        else:
            centres, shape = self.centres, np.array([-1 / (2 * math.log(2) * self.width**2)])
        count = np.uint32(len(self.centres))
        files = ("/exp2.cl", "gaussians.cl")
        return run_kernel(device, files, rows, len(points), centres, count, shape, DEGREE=degree)

    @cached_property
    def harmonics(self) -> FloatArray:
        """Coefficients of theta over its mean in powers of cos 2 pi u; none where one image is enough."""
        return np.empty(0) if self.width <= NEAREST else theta_polynomial(self.width)

    @property
    def scale(self) -> float:
        """Mean of one Gaussian, apart: values and integral then share its rounding in any dimension."""
        return self.integral / len(self.centres)


def gaussian_energy(frequencies: NDArray[np.int64], width: float) -> FloatArray:
    """Energy of one Gaussian: (2 pi width^2)^d exp(-4 pi^2 width^2 |f|^2).

    Parameters
    ----------
    frequencies : (m, d) int64
        Frequencies, cycles per box side.
    width : float
        Box sides.

    Returns
    -------
    (m,) float64
        |transform|^2.
    """
    square = (frequencies.astype(np.float64) ** 2).sum(axis=1)
    energy: FloatArray = (2 * math.pi * width**2) ** frequencies.shape[1] * np.exp(
        -4 * math.pi**2 * width**2 * square
    )
    return energy
