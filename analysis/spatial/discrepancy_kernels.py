"""The kernels whose worst-case errors are the L2 discrepancies (Hickernell 1998; Zhou, Fang & Ning 2013)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import IntEnum
from fractions import Fraction
from typing import Literal

from gbnbench.core.double_double import DoubleDouble
from gbnbench.core.torus import FloatArray

Discrepancy = Literal["CD", "WD", "MD", "L2-star", "L2-periodic", "diaphony"]
MOST_EXPONENT = 290  # decades; products of d factors stay far within the range of double


class Form(IntEnum):
    """How a factor f(u, v) = p(u) + p(v) - t (slope - curve t), t = |u - v|, is evaluated."""

    CORNER = 0  # 1 - max(u, v); p(u) = level + tilt u
    TORUS = 1  # 2 level - slope t (1 - t); curve = slope, p is constant
    BOX = 2  # as it stands; p(u) = level + tilt |u - 1/2|


@dataclass(frozen=True)
class ProductKernel:
    """K(x, y), the product over axes of a factor f(x_a, y_a), with its means.

    Attributes
    ----------
    form : Form
        Shape of the factor.
    level, tilt, slope, curve : float
        Its constants.
    mean : tuple of three Fraction
        h(u), the integral of f over v, is mean[0] + mean[1] w + mean[2] w^2, w being u for a corner's factor
        and |u - 1/2| otherwise.
    grand_mean : Fraction
        c, the integral of h.
    largest : float
        Largest factor.
    factor_units : float
        Error of a factor as it is evaluated in double, in units of 2^-53 of itself, rounded up.
    signed : bool
        Whether factors may be negative; ``factor_units`` then counts units of 2^-53 alone.
    rooted : bool
        Whether the discrepancy is the square root of the norm, not the norm's square.

    Notes
    -----
    The square of a discrepancy is the mean over all pairs of points of the centred kernel,
    K(x, y) - H(x) - H(y) + C, with H the product of h and C = c^d.
    """

    form: Form
    level: float
    tilt: float
    slope: float
    curve: float
    mean: tuple[Fraction, Fraction, Fraction]
    grand_mean: Fraction
    largest: float
    factor_units: float
    signed: bool = False
    rooted: bool = False

    def means(self, x: FloatArray) -> DoubleDouble:
        """H at each point of (n, d): (n,)."""
        constants = [DoubleDouble.of(c) for c in self.mean]
        product = DoubleDouble.of(Fraction(1))
        for axis in range(x.shape[1]):
            w = self._place(DoubleDouble.of(x[:, axis]))
            product = product * (constants[0] + w * (constants[1] + w * constants[2]))
        return product

    def offsets(self, u: DoubleDouble) -> DoubleDouble:
        """Give p at coordinates u."""
        return DoubleDouble.of(Fraction(self.level)) + DoubleDouble.of(Fraction(self.tilt)) * self._place(u)

    def _place(self, u: DoubleDouble) -> DoubleDouble:
        """Give u for a corner's factor, |u - 1/2| otherwise."""
        return u if self.form is Form.CORNER else abs(u + DoubleDouble.of(Fraction(-1, 2)))

    def fault(self, d: int) -> str | None:
        """Say why d axes cannot be evaluated in double; None if they can."""
        low = d * math.log10(min(float(self.grand_mean), 1.0))
        high = d * math.log10(max(self.largest, 1.0))
        if -low < MOST_EXPONENT and high < MOST_EXPONENT:
            return None
        exponent = low if -low >= MOST_EXPONENT else high
        return f"in d={d} its kernel reaches 1e{exponent:+.0f}, beyond the range of double precision"


_HALF, _ZERO = Fraction(1, 2), Fraction(0)
_DIAPHONY_SLOPE = 2 * math.pi**2
_DIAPHONY_TOP = 1 + math.pi**2 / 3

KERNELS: dict[Discrepancy, ProductKernel] = {
    "CD": ProductKernel(
        Form.BOX, 0.5, 0.5, 0.5, 0.0, (Fraction(1), _HALF, -_HALF), Fraction(13, 12), 1.5, 16
    ),
    "WD": ProductKernel(
        Form.TORUS, 0.75, 0.0, 1.0, 1.0, (Fraction(4, 3), _ZERO, _ZERO), Fraction(4, 3), 1.5, 16
    ),
    "MD": ProductKernel(
        Form.BOX,
        15 / 16,
        -0.25,
        0.75,
        0.5,
        (Fraction(5, 3), -Fraction(1, 4), -Fraction(1, 4)),
        Fraction(19, 12),
        1.875,
        16,
    ),
    "L2-star": ProductKernel(
        Form.CORNER, 0.5, -0.5, 0.5, 0.0, (_HALF, _ZERO, -_HALF), Fraction(1, 3), 1.0, 1, rooted=True
    ),
    "L2-periodic": ProductKernel(
        Form.TORUS, 0.25, 0.0, 1.0, 1.0, (Fraction(1, 3), _ZERO, _ZERO), Fraction(1, 3), 0.5, 16, rooted=True
    ),
    # Its mean is exactly that of the rounded constants, whose rounding then meets no small difference.
    "diaphony": ProductKernel(
        Form.TORUS,
        _DIAPHONY_TOP / 2,
        0.0,
        _DIAPHONY_SLOPE,
        _DIAPHONY_SLOPE,
        (Fraction(_DIAPHONY_TOP) - Fraction(_DIAPHONY_SLOPE) / 6, _ZERO, _ZERO),
        Fraction(_DIAPHONY_TOP) - Fraction(_DIAPHONY_SLOPE) / 6,
        _DIAPHONY_TOP,
        80,
        signed=True,
        rooted=True,
    ),
}
