"""Genz' six families of integrands on the unit box, not periodic, with their integrals (Genz 1984, 1987)."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.integration.integrands.integer_frequencies import beyond_dimensions
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import FloatArray

# Sums of a by default, the same in every d: our choice, of the size customary for these families.
DIFFICULTY = {
    "oscillatory": 9.0,
    "product-peak": 7.25,
    "corner-peak": 1.85,
    "gaussian": 7.03,
    "continuous": 20.4,
    "discontinuous": 4.3,
}
# Sums of a within which no value, nor its square, leaves the range of doubles, d = 1 to 20.
RANGES = {
    "oscillatory": (1e-6, 1e6),
    "product-peak": (0.1, 1e6),
    "corner-peak": (1e-6, 1e6),
    "gaussian": (1e-6, 1e6),
    "continuous": (1e-6, 1e6),
    "discontinuous": (1e-6, 300.0),
}
STEP = 1 / 16  # of the corner peak's rule, in ln t


@dataclass(frozen=True)
class Genz:
    """Integrands of one of Genz' kinds, with random a >= 0 of a given sum and random u.

    Attributes
    ----------
    kind : str
        oscillatory: cos(2 pi u_1 + sum a_i x_i);
        product-peak: prod 1 / (a_i^-2 + (x_i - u_i)^2);
        corner-peak: (1 + sum a_i x_i)^-(d + 1);
        gaussian: exp(-sum a_i^2 (x_i - u_i)^2);
        continuous: exp(-sum a_i |x_i - u_i|);
        discontinuous: exp(sum a_i x_i) where x_1 <= u_1 and x_2 <= u_2, else 0.
    difficulty : float or None
        Sum of the a_i, > 0; None for the kind's default: 9, 7.25, 1.85, 7.03, 20.4 and 4.3 in this order.

    References
    ----------
    Genz, "Testing multidimensional integration routines", 1984; "A package for testing multiple integration
    subroutines", 1987.
    """

    name: ClassVar[str] = "genz"
    summary: ClassVar[str] = "Genz' six test families on the box, kind=oscillatory and so on (Genz 1984)"
    periodic: ClassVar[bool] = False
    kind: Literal["oscillatory", "product-peak", "corner-peak", "gaussian", "continuous", "discontinuous"] = (
        "oscillatory"
    )
    difficulty: float | None = None

    def __post_init__(self) -> None:
        if self.kind not in DIFFICULTY:
            raise InputError(f"kind of genz must be one of {', '.join(DIFFICULTY)}; got {self.kind!r}")
        low, high = RANGES[self.kind]
        if self.difficulty is not None and not low <= self.difficulty <= high:
            raise InputError(
                f"difficulty of genz[kind={self.kind}] must be from {low:g} to {high:g}, where doubles hold "
                f"its values; got {self.difficulty}"
            )

    def refusal(self, d: int) -> str | None:
        """Say why there are none in d dimensions, else None."""
        return beyond_dimensions("Genz' families", d)

    def draw(self, d: int, rng: np.random.Generator) -> GenzIntegrand:
        """Draw a and u, uniform before a is scaled; RefusalError where ``refusal`` has a reason."""
        if reason := self.refusal(d):
            raise RefusalError(reason)
        a = 1 - rng.random(d)  # never 0
        total = DIFFICULTY[self.kind] if self.difficulty is None else self.difficulty
        return KINDS[self.kind](a * (total / a.sum()), rng.random(d))

    def frequencies(self, d: int, share: float, most: int = 0) -> NDArray[np.int64]:  # noqa: ARG002
        """None: it is not periodic."""
        return np.empty((0, d), dtype=np.int64)


@dataclass(frozen=True, eq=False)
class GenzIntegrand(ABC):
    """One of them; each kind has its values and its integral.

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
