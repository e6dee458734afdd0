"""The six kinds of Genz' integrands with their values and exact integrals (Genz 1984, 1987)."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gbnbench.core.torus import FloatArray

STEP = 1 / 16  # of the trapezoidal rule for the corner peak, in ln t


@dataclass(frozen=True, eq=False)
class GenzIntegrand(ABC):
    """One integrand; each kind has its own values and integral.

    Attributes
    ----------
    a : (d,) float64
        How fast it varies along each axis, > 0.
    u : (d,) float64
        Where, in [0, 1).
    """

    a: FloatArray
    u: FloatArray

    @property
    @abstractmethod
    def integral(self) -> float:
        """Over the unit box, to some roundings of itself."""

    @abstractmethod
    def __call__(self, x: FloatArray) -> FloatArray:
        """Values: (..., d) -> (...)."""

    def _dot(self, x: FloatArray) -> FloatArray:
        total = np.zeros(x.shape[:-1])
        for axis, a in enumerate(self.a):  # not by BLAS, whose order depends on how many points there are
            total += a * x[..., axis]
        return total


class Oscillatory(GenzIntegrand):
    """cos(2 pi u_1 + sum a_i x_i)."""

    @property
    def integral(self) -> float:
        """cos(2 pi u_1 + sum a_i / 2) times the product of sin(a_i / 2) / (a_i / 2)."""
        phase = 2 * math.pi * float(self.u[0]) + math.fsum(self.a) / 2
        return math.cos(phase) * float(np.prod(np.sinc(self.a / (2 * math.pi))))

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values."""
        values: FloatArray = np.cos(self._dot(x) + 2 * math.pi * self.u[0])
        return values


class ProductPeak(GenzIntegrand):
    """Product of 1 / (a_i^-2 + (x_i - u_i)^2)."""

    @property
    def integral(self) -> float:
        """Product of a_i [atan(a_i (1 - u_i)) + atan(a_i u_i)]."""
        return float(np.prod(self.a * (np.arctan(self.a * (1 - self.u)) + np.arctan(self.a * self.u))))

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values."""
        values = np.ones(x.shape[:-1])
        for axis, (a, u) in enumerate(zip(self.a, self.u, strict=True)):
            values /= a**-2.0 + (x[..., axis] - u) ** 2
        return values


class CornerPeak(GenzIntegrand):
    """(1 + sum a_i x_i)^-(d + 1)."""

    @cached_property
    def integral(self) -> float:
        """By one positive integral over t > 0.

        Notes
        -----
        The closed form, 1 / (d! prod a_i) times the sum over corners v of (-1)^|v| / (1 + a . v), cancels.
        From (1 + s)^-(d + 1) = integral of t^d exp(-t (1 + s)) / d! the axes part: the integral is 1/d! times
        that of t^d exp(-t) prod (1 - exp(-a_i t)) / (a_i t). Nothing in it is negative, and in y = ln t the
        trapezoidal rule of step 1/16 errs by some exp(-16 pi^2), the integrand being analytic for
        |Im y| < pi/2.
        """
        d = len(self.a)
        y = np.arange(
            -40.0, 6.0, STEP
        )  # t^(d + 1) is below 1e-17 of its share before, exp(-t) below 1e-170 after
        t = np.exp(y)
        terms = np.exp((d + 1) * y - t - math.lgamma(d + 1))
        for a in self.a:
            terms *= -np.expm1(-a * t) / (a * t)
        return STEP * math.fsum(terms)

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values."""
        values: FloatArray = (1 + self._dot(x)) ** -(len(self.a) + 1.0)
        return values


class GaussianPeak(GenzIntegrand):
    """exp(-sum a_i^2 (x_i - u_i)^2)."""

    @property
    def integral(self) -> float:
        """Product of sqrt(pi) / (2 a_i) [erf(a_i (1 - u_i)) + erf(a_i u_i)]."""
        from scipy.special import erf

        both = erf(self.a * (1 - self.u)) + erf(self.a * self.u)
        return float(np.prod(math.sqrt(math.pi) / 2 / self.a * both))

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values."""
        total = np.zeros(x.shape[:-1])
        for axis, (a, u) in enumerate(zip(self.a, self.u, strict=True)):
            total += (a * (x[..., axis] - u)) ** 2
        values: FloatArray = np.exp(-total)
        return values


class Continuous(GenzIntegrand):
    """exp(-sum a_i |x_i - u_i|): a kink along each axis."""

    @property
    def integral(self) -> float:
        """Product of (2 - exp(-a_i u_i) - exp(-a_i (1 - u_i))) / a_i."""
        return float(np.prod(-(np.expm1(-self.a * self.u) + np.expm1(-self.a * (1 - self.u))) / self.a))

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values."""
        total = np.zeros(x.shape[:-1])
        for axis, (a, u) in enumerate(zip(self.a, self.u, strict=True)):
            total += a * np.abs(x[..., axis] - u)
        values: FloatArray = np.exp(-total)
        return values


class Discontinuous(GenzIntegrand):
    """exp(sum a_i x_i) where x_1 <= u_1 and x_2 <= u_2, else 0; in 1D x_1 alone counts."""

    @property
    def integral(self) -> float:
        """Product of (exp(a_i e_i) - 1) / a_i, e = u on the first two axes and 1 on others."""
        end = np.concatenate([self.u[:2], np.ones(max(len(self.a) - 2, 0))])
        return float(np.prod(np.expm1(self.a * end) / self.a))

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values."""
        inside = np.ones(x.shape[:-1], dtype=bool)
        for axis, u in enumerate(self.u[:2]):
            inside &= x[..., axis] <= u
        values: FloatArray = np.where(inside, np.exp(self._dot(x)), 0.0)
        return values


KINDS: dict[str, type[GenzIntegrand]] = {
    "oscillatory": Oscillatory,
    "product-peak": ProductPeak,
    "corner-peak": CornerPeak,
    "gaussian": GaussianPeak,
    "continuous": Continuous,
    "discontinuous": Discontinuous,
}
