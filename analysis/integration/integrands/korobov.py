"""Smooth periodic products of Bernoulli polynomials: Fourier coefficients fall as a power (Korobov 1963)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from decimal import Decimal, localcontext
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.integration.integrands.hyperbolic_cross import half_cross, product_classes
from gbnbench.analysis.integration.integrands.limits import beyond_dimensions, check_count, check_share
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.integer_frequencies import MOST_FREQUENCIES
from gbnbench.core.torus import FloatArray

# B_alpha(t), its sign that of a positive cos 2 pi t, in powers of s = t (1 - t): it is even about 1/2.
BERNOULLI = {2: (1 / 6, -1.0), 4: (1 / 30, 0.0, -1.0), 6: (1 / 42, 0.0, -0.5, -1.0)}
DIGITS = 60  # in which energies are summed
PI = Decimal("3.14159265358979323846264338327950288419716939937510582097494459")
ZETA = {4: (1, 90), 8: (1, 9450), 12: (691, 638512875)}  # over pi^4, pi^8 and pi^12


@dataclass(frozen=True)
class Korobov:
    """Products over axes of 1 + weight * sum over h != 0 of |h|^-smoothness exp(2 pi i h (x - shift)).

    Attributes
    ----------
    smoothness : {2, 4, 6}
        Decay of the Fourier coefficients.
    weight : float
        Weight of the part of each factor that varies, > 0. At 1 the variance is
        (1 + 2 zeta(2 smoothness))^d - 1, about 3^d.

    References
    ----------
    Korobov, "Number-theoretic methods in approximate analysis", 1963; Sloan & Joe, "Lattice methods for
    multiple integration", 1994, Section 2.
    """

    name: ClassVar[str] = "korobov"
    summary: ClassVar[str] = (
        "smooth periodic product of Bernoulli polynomials, shifted at random (Korobov 1963)"
    )
    periodic: ClassVar[bool] = True
    smoothness: Literal[2, 4, 6] = 4
    weight: float = 1.0

    def __post_init__(self) -> None:
        if self.smoothness not in BERNOULLI:
            raise InputError(f"smoothness of korobov must be 2, 4 or 6; got {self.smoothness}")
        if not (math.isfinite(self.weight) and self.weight > 0):
            raise InputError(f"weight of korobov must be positive; got {self.weight}")

    def refusal(self, d: int) -> str | None:
        """Return the reason why there are no such integrands in d dimensions, or None."""
        return beyond_dimensions("Korobov's functions", d)

    def draw(self, d: int, rng: np.random.Generator) -> KorobovProduct:
        """Draw a product by a uniform shift.

        Parameters, returns and errors are those of ``Family.draw``.
        """
        if reason := self.refusal(d):
            raise RefusalError(reason)
        return KorobovProduct(rng.random(d), self.smoothness, self.weight)

    def mean_energy(self, frequencies: NDArray[np.int64]) -> FloatArray:
        """Energy of every product, which does not depend on its shift: (m, d) -> (m,)."""
        return korobov_energy(frequencies, self.smoothness, self.weight)

    def frequencies(self, d: int, share: float, most: int = MOST_FREQUENCIES) -> NDArray[np.int64]:
        """List half a hyperbolic cross of frequencies; those outside hold less than a share of the energy.

        Parameters, returns and errors are those of ``Family.frequencies``.

        Notes
        -----
        Frequencies are ranked by energy, weight^(2 j) N^(-2 smoothness) for j components that are not 0 and
        the product N of their sizes; a recursion over axes counts them, and the total is a closed form. Both
        are summed in 60 digits, so that shares far below the rounding of doubles are told apart.
        """
        check_share(share, self.refusal(d))
        with localcontext() as context:
            context.prec = DIGITS
            total = (1 + 2 * Decimal(self.weight) ** 2 * _zeta(2 * self.smoothness)) ** d - 1
            limit = Decimal(share) * total
            largest = 1
            while True:
                classes = product_classes(d, largest)
                ranked = sorted(classes, key=self._class_energy, reverse=True)
                ranked.remove((0, 1))
                left, number = total, 0
                for key in ranked:
                    left -= classes[key] * self._exact_energy(key)
                    number += 1
                    if left < limit:
                        break
                if left < limit:
                    break
                check_count(
                    f"even a hyperbolic cross that leaves out more than {share:g} of the energy",
                    d,
                    sum(classes.values()) / 2,
                    most=most,
                )
                largest *= 2
        chosen = ranked[:number]
        check_count(
            f"the hyperbolic cross that leaves out {share:g} of the energy",
            d,
            sum(classes[k] for k in chosen) / 2,
            most=most,
        )
        return half_cross(d, chosen)

    def _exact_energy(self, key: tuple[int, int]) -> Decimal:
        return Decimal(self.weight) ** (2 * key[0]) / Decimal(key[1]) ** (2 * self.smoothness)

    def _class_energy(self, key: tuple[int, int]) -> float:
        return float(self.weight ** (2 * key[0]) * float(key[1]) ** (-2 * self.smoothness))


@dataclass(frozen=True, eq=False)
class KorobovProduct:
    """One product of Bernoulli polynomials.

    Attributes
    ----------
    shift : (d,) float64
        On the unit torus.
    smoothness : {2, 4, 6}
        Decay of the Fourier coefficients.
    weight : float
        Weight of the part of each factor that varies.
    """

    shift: FloatArray
    smoothness: int
    weight: float

    @property
    def integral(self) -> float:
        """Exactly 1, a product of means."""
        return 1.0

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values, (..., d) -> (...), to some roundings of the product of largest factors."""
        factor = self.weight * (2 * math.pi) ** self.smoothness / math.factorial(self.smoothness)
        values = np.ones(x.shape[:-1])
        for axis, shift in enumerate(self.shift):
            t = x[..., axis] - shift
            t -= np.floor(t)
            s = t * (1 - t)
            bernoulli = np.zeros(t.shape)
            for coefficient in BERNOULLI[self.smoothness][::-1]:
                bernoulli = bernoulli * s + coefficient
            values *= 1 + factor * bernoulli
        return values

    def energy(self, frequencies: NDArray[np.int64]) -> FloatArray:
        """|transform|^2 at integer frequencies, (m, d) -> (m,)."""
        return korobov_energy(frequencies, self.smoothness, self.weight)


def korobov_energy(frequencies: NDArray[np.int64], smoothness: int, weight: float) -> FloatArray:
    """Energy of a product: the product over axes of weight^2 |h|^(-2 smoothness), 1 where h = 0.

    Parameters
    ----------
    frequencies : (m, d) int64
        Frequencies, cycles per box side.
    smoothness : {2, 4, 6}
        Decay of the Fourier coefficients.
    weight : float
        Weight of each axis, > 0.

    Returns
    -------
    (m,) float64
        |transform|^2.
    """
    energy = np.ones(len(frequencies))
    for h in np.abs(frequencies.T).astype(np.float64):
        energy *= np.where(h == 0, 1.0, weight**2 * np.maximum(h, 1.0) ** (-2 * smoothness))
    return energy


def _zeta(s: int) -> Decimal:
    """Riemann's zeta at 4, 8 and 12, in the digits of the context."""
    over, under = ZETA[s]
    return over * PI**s / under
