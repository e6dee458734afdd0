"""Kaiser-Bessel window that carries points to a grid, as a polynomial in each of its cells.

exp(-2 pi i f x) is the sum over nodes m / M of exp(-2 pi i f m / M) times the values of the window there,
divided by the transform of the window at f (Jackson, Meyer, Nishimura & Macovski 1991). With a support of 16
cells and two and a half times as many nodes as frequencies the error is less than rounding in double. In
float 8 cells are enough.
"""

from __future__ import annotations

import decimal
import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from gbnbench.core.torus import FloatArray

OVERSAMPLING = 2.5  # nodes of the grid for each frequency -fmax .. fmax
DIGITS = 40  # decimal digits of the arithmetic by which polynomials are fitted
TERMS = 140  # terms of the Bessel function's series, for arguments below 45


@dataclass(frozen=True)
class Window:
    """Kaiser-Bessel window on an even number of cells.

    Attributes
    ----------
    width : int
        Cells of the support.
    coefficients : (degree + 1, width) float64
        Column j gives the value at the node that is j - width/2 + 1 cells above that of the point, as a
        polynomial in the point's place in its cell less 1/2, highest power first.
    left_out : float
        Largest relative error of exp(-2 pi i f x), met at 64 places of a cell and all frequencies.
    """

    width: int
    coefficients: FloatArray
    left_out: float

    @property
    def degree(self) -> int:
        """Degree of the polynomials."""
        return len(self.coefficients) - 1

    def values(self, place: FloatArray) -> FloatArray:
        """Evaluate the window at the nodes around points at a place in [0, 1): (k,) -> (k, width)."""
        s = np.asarray(place)[:, None] - 0.5
        total = np.zeros((len(s), self.width))
        for row in self.coefficients:
            total = total * s + row
        return total

    def transform(self, fmax: int, nodes: int) -> FloatArray:
        """Evaluate the transform of the window at f = 0 .. fmax, for a point that lies on a node.

        Parameters
        ----------
        fmax, nodes : int
            Largest frequency, and nodes of the grid.

        Returns
        -------
        (fmax + 1,) float64
        """
        away = np.arange(self.width) - self.width // 2 + 1
        turns = np.outer(np.arange(fmax + 1), away) % nodes / nodes
        found: FloatArray = np.cos(2 * np.pi * turns) @ self.values(np.zeros(1))[0]
        return found

    def amplification(self, fmax: int, nodes: int) -> float:
        """Give the ratio of the transform at 0 to its smallest value, by which rounding is magnified there.

        Parameters
        ----------
        fmax, nodes : int
            Largest frequency, and nodes of the grid.

        Returns
        -------
        float
        """
        transform = self.transform(fmax, nodes)
        return float(transform[0] / transform.min())


def nodes_for(fmax: int, step: int) -> int:
    """Count the nodes of the grid for frequencies |f| <= fmax.

    Parameters
    ----------
    fmax, step : int
        Largest frequency, and a number of which the count shall be a multiple.

    Returns
    -------
    int
    """
    return -(-math.ceil(OVERSAMPLING * (2 * fmax + 1)) // step) * step


@lru_cache(maxsize=4)
def window(width: int, degree: int, oversampling: float = OVERSAMPLING) -> Window:
    """Fit the polynomials: exact at the Chebyshev nodes of each cell, in 40 digits, then rounded.

    Parameters
    ----------
    width : int
        Cells of the support, even.
    degree : int
        Degree of the polynomials.
    oversampling : float
        Nodes of the grid for each frequency -fmax .. fmax.

    Returns
    -------
    Window
    """
    beta = decimal.Decimal(math.pi * width * (1 - 0.5 / oversampling) * 0.99)
    places = [decimal.Decimal(0.5 * math.cos(math.pi * (k + 0.5) / (degree + 1))) for k in range(degree + 1)]
    with decimal.localcontext() as context:
        context.prec = DIGITS
        scale = 1 / _bessel(beta)
        cells = []
        for j in range(width):
            away = j - width // 2 + 1
            values = []
            for s in places:
                z = (decimal.Decimal(away) - s - decimal.Decimal("0.5")) / (decimal.Decimal(width) / 2)
                values.append(_bessel(beta * (1 - z * z).sqrt()) * scale)
            cells.append([float(c) for c in reversed(_monomials(places, values))])
    coefficients = np.ascontiguousarray(np.array(cells).T)
    unchecked = Window(width, coefficients, 0.0)
    return Window(width, coefficients, _left_out(unchecked, oversampling))


def _bessel(x: decimal.Decimal) -> decimal.Decimal:
    """Evaluate the modified Bessel function I_0 by its series."""
    square, term, total = x * x / 4, decimal.Decimal(1), decimal.Decimal(1)
    for k in range(1, TERMS):
        term = term * square / (k * k)
        total += term
    return total


def _monomials(places: list[decimal.Decimal], values: list[decimal.Decimal]) -> list[decimal.Decimal]:
    """Interpolate by Newton's differences: coefficients of the polynomial, lowest power first."""
    differences = list(values)
    for order in range(1, len(places)):
        for k in range(len(places) - 1, order - 1, -1):
            differences[k] = (differences[k] - differences[k - 1]) / (places[k] - places[k - order])
    found = [differences[-1]]
    for k in range(len(places) - 2, -1, -1):
        found = [differences[k] - places[k] * found[0]] + [
            a - places[k] * b for a, b in zip(found, [*found[1:], decimal.Decimal(0)], strict=True)
        ]
    return found


def _left_out(fitted: Window, oversampling: float) -> float:
    fmax = 64
    nodes = math.ceil(oversampling * (2 * fmax + 1))
    place = np.arange(64) / 64
    away = np.arange(fitted.width) - fitted.width // 2 + 1
    f = np.arange(fmax + 1)
    phase = (away[None, :] - place[:, None])[:, :, None] * f / nodes
    sums = (fitted.values(place)[:, :, None] * np.exp(-2j * np.pi * phase)).sum(axis=1)
    return float(np.abs(sums / fitted.transform(fmax, nodes) - 1).max())
