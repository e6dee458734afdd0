"""Double-double numbers by error-free transformations (Dekker 1971; Knuth, TAOCP vol. 2, 4.2.2)."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from gbnbench.core.torus import FloatArray

SPLITTER = 2.0**27 + 1  # cuts a double in two halves whose products are exact


def two_sum(a: FloatArray | float, b: FloatArray | float) -> tuple[FloatArray, FloatArray]:
    """Add with the rounding: a + b = total + rest exactly (Knuth).

    Parameters
    ----------
    a, b : (...) float64
        Shapes broadcast.

    Returns
    -------
    total, rest : (...) float64
        ``total`` is fl(a + b).
    """
    total = np.add(a, b)
    part = total - a
    return total, (a - (total - part)) + (b - part)


def two_product(a: FloatArray | float, b: FloatArray | float) -> tuple[FloatArray, FloatArray]:
    """Multiply with the rounding: a b = product + rest exactly, barring under- and overflow (Dekker).

    Parameters
    ----------
    a, b : (...) float64
        At most 1e299 in size; shapes broadcast.

    Returns
    -------
    product, rest : (...) float64
        ``product`` is fl(a b).
    """
    product = np.multiply(a, b)
    a_high, a_low = _halves(a)
    b_high, b_low = _halves(b)
    rest = a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low)
    return product, rest


def _halves(a: FloatArray | float) -> tuple[FloatArray, FloatArray]:
    scaled = np.multiply(a, SPLITTER)
    high = scaled - (scaled - a)
    return high, a - high


@dataclass(frozen=True)
class DoubleDouble:
    """Numbers of some 106 bits, each the sum of two doubles.

    Attributes
    ----------
    high, low : (...) float64
        ``high`` is the number rounded to double, ``low`` the rest.
    """

    high: FloatArray
    low: FloatArray

    @classmethod
    def of(cls, value: FloatArray | Fraction) -> DoubleDouble:
        """Doubles as they are, or a fraction rounded to 2^-106 of itself."""
        if isinstance(value, Fraction):
            high = float(value)
            return cls(np.asarray(high), np.asarray(float(value - Fraction(high))))
        return cls(value, np.zeros_like(value))

    def __add__(self, other: DoubleDouble) -> DoubleDouble:
        total, rest = two_sum(self.high, other.high)
        tail, last = two_sum(self.low, other.low)
        total, rest = two_sum(total, rest + tail)
        return DoubleDouble(*two_sum(total, rest + last))

    def __mul__(self, other: DoubleDouble) -> DoubleDouble:
        product, rest = two_product(self.high, other.high)
        rest = rest + (self.high * other.low + self.low * other.high)
        return DoubleDouble(*two_sum(product, rest))

    def __abs__(self) -> DoubleDouble:
        sign = np.where(self.high < 0, -1.0, 1.0)
        return DoubleDouble(self.high * sign, self.low * sign)
