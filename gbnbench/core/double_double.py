"""Double-double numbers by error-free transformations (Dekker 1971; Knuth, TAOCP vol. 2, 4.2.2)."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

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


def running_sum(values: FloatArray) -> FloatArray:
    """Add up along the last axis, each running sum good to 2^-52 of the sum of sizes so far.

    Parameters
    ----------
    values : (..., m) float64
        What is added up.

    Returns
    -------
    (..., m) float64
    """
    coarse, fine = _running_parts(values)
    return coarse + fine


def exact_sum(values: DoubleDouble) -> Fraction:
    """Sum of all numbers, good to some 2^-80 of the sum of their sizes.

    Parameters
    ----------
    values : DoubleDouble
        Any shape.

    Returns
    -------
    Fraction
    """
    coarse = _coarse(values.high)
    fine = (values.high - coarse) + values.low
    return Fraction(float(np.sum(coarse))) + Fraction(float(np.sum(fine)))


def _coarse(values: FloatArray) -> FloatArray:
    """Round values to so few digits that any sum of them is exact in double."""
    digits = 51 - values.shape[-1].bit_length()
    exponent = int(np.frexp(np.max(np.abs(values), initial=0.0))[1]) - digits
    rounded: FloatArray = np.ldexp(np.rint(np.ldexp(values, -exponent)), exponent)
    return rounded


def _running_parts(values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Add up the leading digits, which is exact, and the rest, whose rounding is negligible."""
    coarse = _coarse(values)
    return np.cumsum(coarse, axis=-1), np.cumsum(values - coarse, axis=-1)


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

    def __getitem__(self, index: NDArray[np.intp]) -> DoubleDouble:
        return DoubleDouble(self.high[index], self.low[index])

    def __neg__(self) -> DoubleDouble:
        return DoubleDouble(-self.high, -self.low)

    def below_less_above(self) -> DoubleDouble:
        """Sum up to each entry, itself included, less the sum of those after it, of (m,) numbers."""
        coarse, fine = _running_parts(self.high)
        fine = fine + np.cumsum(self.low)
        return DoubleDouble(*two_sum(2 * coarse - coarse[-1], 2 * fine - fine[-1]))

    def __abs__(self) -> DoubleDouble:
        sign = np.where(self.high < 0, -1.0, 1.0)
        return DoubleDouble(self.high * sign, self.low * sign)
