"""Variance of integration over random toroidal shifts: deep sets beside Gaussian Blue Noise and others.

python -m gbnbench.benchmarks.depth_integration benchmarks/results/deep/depth_integration.csv
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from gbnbench.analysis.periodogram import each_power
from gbnbench.benchmarks.machine import Rows
from gbnbench.generators.registry import find, generate
from gbnbench.torus import FloatArray

SOURCES = (
    "random", "jittered", "sobol", "gbn[gradients=320]", "gbn[gradients=1000]",
    "deep[c=78.9568,gradients=100]", "deep[c=78.9568,edge={lower},gradients=100]",
    "deep[c=78.9568,edge={higher},gradients=100]", "deep[c=39.4784,gradients=100]",
    "deep[c=98.696,gradients=100]", "deep[c=118.4353,gradients=100]",
    "deep[c=118.4353,edge={lower},gradients=100]", "deep[c=78.9568,gradients=200]", "deep",
)  # fmt: skip
# n, d, the edges named above, largest harmonic of the predicted variance.
CASES = ((1024, 2, {"lower": 0.68, "higher": 0.76}, 96), (1000, 3, {"lower": 0.8, "higher": 0.86}, 24))
SETS, SHIFTS = 4, 8
BUMPS, BUMP_POINTS = 64, 512
COLUMNS = ("n", "d", "integrand", "source", "variance", "standard_error", "predicted")


class Integrand(Protocol):
    """A function on the unit box with its integral."""

    @property
    def integral(self) -> float:
        """Exact, or to the rounding stated."""
        ...

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values at points: (..., d) -> (...)."""
        ...


@dataclass(frozen=True, eq=False)
class Bumps:
    """Toroidal sum of Gaussians exp(-r^2 / 2 width^2), width 512^(-1/d) (Ahmed, Ren & Wonka 2022, Sec. 5.2).

    Attributes
    ----------
    centres : (bumps, d) float64
        On the unit torus.
    """

    centres: FloatArray

    @property
    def width(self) -> float:
        """Of a Gaussian, box sides."""
        return float(BUMP_POINTS ** (-1 / self.centres.shape[1]))

    @property
    def integral(self) -> float:
        """Exactly, since each is periodised."""
        bumps, d = self.centres.shape
        return float(bumps * (math.sqrt(2 * math.pi) * self.width) ** d)

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values, three images an axis; the next are below 1e-31 for d <= 3."""
        values = np.ones((*x.shape[:-1], len(self.centres)))
        for axis, centre in enumerate(self.centres.T):
            step = x[..., axis, None] - centre
            step -= np.rint(step)
            each = np.exp(-(step**2) / (2 * self.width**2))
            for image in (-1, 1):
                each += np.exp(-((step + image) ** 2) / (2 * self.width**2))
            values *= each
        total: FloatArray = values.sum(axis=-1)
        return total

    @staticmethod
    def energy(f: FloatArray, bumps: int = BUMPS) -> FloatArray:
        """Mean of |integrand's transform|^2 over random centres, at frequencies f != 0: (m, d) -> (m,)."""
        d = f.shape[1]
        width = BUMP_POINTS ** (-1 / d)
        decay = np.exp(-4 * math.pi**2 * width**2 * np.sum(f**2, axis=1))
        energy: FloatArray = bumps * (2 * math.pi * width**2) ** d * decay
        return energy


@dataclass(frozen=True, eq=False)
class HalfSpace:
    """1 on one side of a plane through the unit box, 0 on the other; not periodic.

    Attributes
    ----------
    point, normal : (d,) float64
        Of the plane; no component of the normal is 0.
    """

    point: FloatArray
    normal: FloatArray

    @property
    def integral(self) -> float:
        """Volume of the box within: inclusion and exclusion over the box's corners (Barrow & Smith 1979).

        Rounding errs by about 1e-16 over the product of the normal's components.
        """
        d = len(self.normal)
        side = np.abs(self.normal)
        reach = float(self.normal @ self.point) - float(np.minimum(self.normal, 0).sum())
        corners = np.array(list(product((0, 1), repeat=d)))
        terms = (-1.0) ** corners.sum(axis=1) * np.maximum(reach - corners @ side, 0) ** d
        return 1 - float(terms.sum() / (math.factorial(d) * np.prod(side)))

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values."""
        values: FloatArray = (((x - self.point) @ self.normal) >= 0).astype(np.float64)
        return values


@dataclass(frozen=True, eq=False)
class Korobov:
    """Product over axes of 1 + sum over h != 0 of h^-4 exp(2 pi i h (x - shift)): smooth, periodic.

    Attributes
    ----------
    shift : (d,) float64
        On the unit torus.
    """

    shift: FloatArray

    @property
    def integral(self) -> float:
        """Of a product of means, each 1."""
        return 1.0

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values, by the fourth Bernoulli polynomial."""
        t = (x - self.shift) % 1.0
        bernoulli = t**4 - 2 * t**3 + t**2 - 1 / 30
        values: FloatArray = np.prod(1 - (2 * math.pi) ** 4 / 24 * bernoulli, axis=-1)
        return values

    @staticmethod
    def energy(f: FloatArray) -> FloatArray:
        """|transform|^2 at frequencies f: (m, d) -> (m,)."""
        energy: FloatArray = np.prod(np.where(f == 0, 1.0, np.maximum(np.abs(f), 1.0) ** -8.0), axis=1)
        return energy


def bumps(d: int, rng: np.random.Generator) -> Bumps:
    """Draw 64 centres."""
    return Bumps(rng.random((BUMPS, d)))


def half_space(d: int, rng: np.random.Generator) -> HalfSpace:
    """Draw a point of the box and a direction."""
    return HalfSpace(rng.random(d), rng.standard_normal(d))


def korobov(d: int, rng: np.random.Generator) -> Korobov:
    """Draw a shift."""
    return Korobov(rng.random(d))


@dataclass(frozen=True)
class Family:
    """Integrands of one kind.

    Attributes
    ----------
    draw : callable
        (d, rng) -> one of them.
    count : int
        How many are drawn.
    energy : callable or None
        Mean of |transform|^2 over the family, (m, d) frequencies -> (m,); None where it is not used.
    """

    draw: Callable[[int, np.random.Generator], Integrand]
    count: int
    energy: Callable[[FloatArray], FloatArray] | None = None


FAMILIES = {
    "64 Gaussians": Family(bumps, 12, Bumps.energy),
    "half space": Family(half_space, 200),
    "Korobov": Family(korobov, 100, Korobov.energy),
}


def measured(
    integrands: list[Integrand], x: FloatArray, shifts: int, rng: np.random.Generator
) -> tuple[float, float]:
    """Mean squared error of the mean over shifted points.

    Parameters
    ----------
    integrands : list
        Functions on the unit box.
    x : (sets, n, d) float64
        Points.
    shifts : int
        Random toroidal shifts of each set for each integrand.

    Returns
    -------
    variance, standard_error : float
        The latter over integrands, whose own variances differ most.
    """
    squares = np.empty((len(integrands), len(x), shifts))
    for k, integrand in enumerate(integrands):
        for s, points in enumerate(x):
            for t in range(shifts):
                values = integrand((points + rng.random(x.shape[2])) % 1.0)
                # Taken from a middle value first: a sum of 1000 values near one another then rounds less.
                squares[k, s, t] = (np.mean(values - integrand.integral)) ** 2
    each = squares.mean(axis=(1, 2))
    return float(each.mean()), float(each.std(ddof=1) / math.sqrt(len(each)))


def predicted(energy: Callable[[FloatArray], FloatArray], x: FloatArray, fmax: int) -> float:
    """Variance that the power spectra foretell: sum over f != 0, |f_a| <= fmax, of |transform|^2 P / n.

    Exact over all shifts where the integrand's spectrum ends within the cube (Durand 2011; Pilleboue et al.
    2015).
    """
    _, n, d = x.shape
    power = each_power(x, fmax)[1].power.ravel()
    f = np.indices((2 * fmax + 1,) * d).reshape(d, -1).T - fmax
    away = f.any(axis=1)
    return float(np.sum(energy(f[away].astype(np.float64)) * power[away]) / n)


def rows(
    cases: tuple[tuple[int, int, dict[str, float], int], ...] = CASES,
    sets: int = SETS,
    shifts: int = SHIFTS,
) -> Iterator[dict[str, Any]]:
    """One row a case, source and family of integrands."""
    for n, d, edges, fmax in cases:
        for pattern in SOURCES:
            source = pattern.format(**edges)
            if find(source).refusal(n, d) is not None:
                continue
            x = generate(source, n=n, d=d, realizations=sets).reshape(sets, n, d)
            for name, family in FAMILIES.items():
                rng = np.random.default_rng([n, d])  # the same integrands and shifts for every source
                drawn = [family.draw(d, rng) for _ in range(family.count)]
                variance, error = measured(drawn, x, shifts, rng)
                told = predicted(family.energy, x, fmax) if family.energy else math.nan
                yield dict(zip(COLUMNS, (n, d, name, source, variance, error, told), strict=True))


def main(arguments: list[str]) -> None:
    """Print the table, and write it to the file named."""
    with Rows(Path(arguments[0]), COLUMNS) as table:
        for row in rows():
            table.add(row)
            cells = [f"{cell:.3g}" if isinstance(cell, float) else str(cell) for cell in row.values()]
            print("  ".join(f"{cell:>12}" for cell in cells), flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
