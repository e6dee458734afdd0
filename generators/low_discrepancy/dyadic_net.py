"""Random (0, m, 2)-nets in base 2, and the exchanges that keep a net (Ahmed & Wonka 2021)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray

REACH = 4.0  # of a Gaussian, in standard deviations


def random_net(m: int, rng: np.random.Generator) -> NDArray[np.int64]:
    """Draw a (0, m, 2)-net by the paper's constructive algorithm, Netshuffle.

    Parameters
    ----------
    m : int
        log2 of the number of points.
    rng : Generator
        Of m 2**(m - 1) coins; different coins give different nets.

    Returns
    -------
    (2**m,) int64
        Stratum of y, of 2**m, by that of x.

    Notes
    -----
    The y-strata are dealt out to the halves of x: of every two neighbours one goes left and one right, by a
    coin for each two; then those of each half in the same way to its halves, until each column has one.
    """
    strata = np.arange(2**m).reshape(1, -1)
    for _ in range(m):
        pairs = strata.reshape(len(strata), -1, 2)
        coin = rng.integers(0, 2, size=pairs.shape[:2])[..., None]
        halves = np.where(coin == 1, pairs[..., ::-1], pairs)
        strata = np.moveaxis(halves, 2, 1).reshape(2 * len(strata), -1)
    return strata.reshape(-1)


def exchangeable_pairs(y: NDArray[np.int64], level: int) -> NDArray[np.intp]:
    """Pair the points that may exchange their y: those that share an elementary interval of area 2/n.

    Parameters
    ----------
    y : (2**m,) int64
        A (0, m, 2)-net, stratum of y by that of x.
    level : int
        Binary digits of x that the interval fixes, from 0 to m - 1; it fixes m - 1 - level of y.

    Returns
    -------
    (2**(m - 1), 2) intp
        Every point once.

    Notes
    -----
    Elementary intervals that fix no more of x do not see which of the two has which x, those that fix no more
    of y do not see which has which y, and there are no others of area 1/n.
    """
    m = len(y).bit_length() - 1
    x = np.arange(len(y))
    interval = ((x >> (m - level)) << (m - 1 - level)) | (y >> (level + 1))
    return np.argsort(interval, kind="stable").reshape(-1, 2)


class GaussianEnergy:
    """The energy of a net: the sum over pairs of a periodic Gaussian, and what an exchange adds to it.

    Parameters
    ----------
    m : int
        log2 of the number of points, >= 1.
    sigma : float
        Standard deviation of the Gaussian, in spacings.
    """

    def __init__(self, m: int, sigma: float) -> None:
        n = 2**m
        offset = np.arange(n)[:, None] + n * np.arange(-3, 4)
        self.gaussian: FloatArray = np.exp(-(offset**2) / (2 * sigma**2 * n)).sum(axis=1)
        self.n, self.x_bits = n, (m + 1) // 2
        self.y_bits = m - self.x_bits
        # in cells of the grid that holds a point each; one more, for exchanges move points as far as that
        self.x_reach, self.y_reach = (
            int(np.ceil(REACH * sigma * 2**bits / np.sqrt(n))) + 1 for bits in (self.x_bits, self.y_bits)
        )
        steps = [
            np.arange(2**bits) if 2 * reach + 1 >= 2**bits else np.arange(-reach, reach + 1)
            for bits, reach in ((self.x_bits, self.x_reach), (self.y_bits, self.y_reach))
        ]
        self.x_step, self.y_step = (part.reshape(-1) for part in np.meshgrid(*steps, indexing="ij"))

    def cell(self, x: NDArray[np.int64], y: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the number of a point's cell in a grid whose cells hold a point each.

        Parameters
        ----------
        x, y : (k,) int64
            Strata.

        Returns
        -------
        (k,) int64
        """
        return np.asarray(((x >> self.y_bits) << self.y_bits) | (y >> self.x_bits))

    def around(self, cell: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the cells within reach of others.

        Parameters
        ----------
        cell : (k,) int64
            Numbers of cells.

        Returns
        -------
        (k, cells within reach) int64
        """
        x_cell = ((cell >> self.y_bits)[:, None] + self.x_step) & (2**self.x_bits - 1)
        y_cell = ((cell & (2**self.y_bits - 1))[:, None] + self.y_step) & (2**self.y_bits - 1)
        return np.asarray((x_cell << self.y_bits) | y_cell)

    def change(self, y: NDArray[np.int64], pairs: NDArray[np.intp]) -> FloatArray:
        """Compute what the energy gains if a pair exchanges its y, for each pair alone.

        Parameters
        ----------
        y : (n,) int64
            The net.
        pairs : (k, 2) intp
            Points, by their stratum of x.

        Returns
        -------
        (k,) float64
            Points farther than the reach from both are left out: 4 standard deviations.

        Notes
        -----
        With g the Gaussian of an axis, the sum over the other points of
        (g(x_i - x) - g(x_j - x)) (g(y_j - y) - g(y_i - y)): the two differ in nothing else.
        """
        mask = self.n - 1
        owner = np.empty(self.n, dtype=np.int64)
        owner[self.cell(np.arange(self.n), y)] = np.arange(self.n)
        total = np.zeros(len(pairs))
        i, j = pairs.T
        column, row = np.divmod(self.cell(np.arange(self.n), y), 2**self.y_bits)
        for here, other in ((i, j), (j, i)):
            around = self.around(self.cell(here, y[here]))
            x_cell, y_cell = around >> self.y_bits, around & (2**self.y_bits - 1)
            near = owner[around]
            counted = (near != i[:, None]) & (near != j[:, None])
            if here is j:  # those in reach of both are counted once
                counted &= ~(
                    _in_reach(x_cell, column[other], self.x_bits, self.x_reach)
                    & _in_reach(y_cell, row[other], self.y_bits, self.y_reach)
                )
            g = self.gaussian
            by_x = g[(i[:, None] - near) & mask] - g[(j[:, None] - near) & mask]
            by_y = g[(y[j][:, None] - y[near]) & mask] - g[(y[i][:, None] - y[near]) & mask]
            total += np.einsum("kp,kp,kp->k", by_x, by_y, counted)
        return total


def _in_reach(cell: NDArray[np.int64], of: NDArray[np.int64], bits: int, reach: int) -> NDArray[np.bool_]:
    """Tell which cells of an axis a stencil round others holds."""
    return np.asarray(((cell - of[:, None] + reach) & (2**bits - 1)) <= 2 * reach)
