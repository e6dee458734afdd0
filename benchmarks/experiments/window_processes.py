"""Point processes whose structure factor is known in closed form, drawn in a window that is no torus."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from gbnbench.core.torus import FloatArray

Draw = Callable[[np.random.Generator], FloatArray]
Curve = Callable[[FloatArray], FloatArray]
BEYOND = 6  # cells of a lattice around the window, from which shifts bring points in
SHIFT = 0.3  # standard deviation of Gaussian shifts, in cells
ANGLES = 256


@dataclass(frozen=True)
class Process:
    """A stationary point process seen in a box from 0 to ``sides``.

    Attributes
    ----------
    name : str
        What it is.
    sides : tuple of float
        Of the window.
    draw : callable
        One set from a generator.
    structure_factor : callable
        S over directions, at wave numbers in radians a length.
    intensity : float or None
        Points a unit of volume; None where the number of points is fixed.
    s_zero : float
        S at k -> 0.
    exponent : float or None
        alpha in S ~ k^alpha; None where S is not one power law and a smooth factor.
    pair_correlation : callable or None
        g at distances.
    mean_distance : float or None
        Mean distance to the nearest neighbour.
    """

    name: str
    sides: tuple[float, ...]
    draw: Draw
    structure_factor: Curve
    intensity: float | None
    s_zero: float
    exponent: float | None = None
    pair_correlation: Curve | None = None
    mean_distance: float | None = None


def poisson(sides: tuple[float, ...], n: float, *, fixed: bool = False) -> Process:
    """Return independent uniform points: a Poisson process, or just n of them (binomial).

    Parameters
    ----------
    sides : tuple of float
        Of the window.
    n : float
        Points expected.
    fixed : bool
        Whether each set has just n points.

    Returns
    -------
    Process
    """
    d = len(sides)
    intensity = n / math.prod(sides)
    ball = math.pi ** (d / 2) / math.gamma(d / 2 + 1)

    def draw(rng: np.random.Generator) -> FloatArray:
        return rng.random((int(n) if fixed else rng.poisson(n), d)) * sides

    mean = math.gamma(1 + 1 / d) / (ball * intensity) ** (1 / d)
    name = f"{'binomial' if fixed else 'Poisson'}, {d}D"
    return Process(
        name, sides, draw, np.ones_like, None if fixed else intensity, 1.0, 0.0, np.ones_like, mean
    )


def ginibre(side: float, kept: float = 1.0) -> Process:
    """Return eigenvalues of complex Gaussian matrices in a square about 0 (Ginibre 1965), or a thinned part.

    The intensity is 1/pi, S = 1 - exp(-k^2 / 4) and g = 1 - exp(-r^2); of points kept at random with
    probability p, S = 1 - p + p S and the same g.

    Parameters
    ----------
    side : float
        Of the square.
    kept : float
        Probability with which a point is kept.

    Returns
    -------
    Process
    """
    # Of matrices whose disc holds the square, its edge apart.
    size = math.ceil((side / math.sqrt(2) + 4) ** 2)

    def draw(rng: np.random.Generator) -> FloatArray:
        matrix = rng.normal(size=(size, size)) + 1j * rng.normal(size=(size, size))
        values = np.linalg.eigvals(matrix / math.sqrt(2))
        x = np.stack([values.real, values.imag], axis=1) + side / 2
        seen = ((x >= 0) & (x <= side)).all(axis=1) & (rng.random(size) < kept)
        return np.asarray(x[seen], np.float64)

    def s(k: FloatArray) -> FloatArray:
        return 1 - kept * np.exp(-(k**2) / 4)

    name = "Ginibre" if kept == 1 else f"Ginibre, {kept:g} kept"
    exponent = 2.0 if kept == 1 else None
    return Process(
        name, (side, side), draw, s, kept / math.pi, 1 - kept, exponent, lambda r: 1 - np.exp(-(r**2))
    )


def perturbed_lattice(sides: tuple[float, ...], shifts: str) -> Process:
    """Return the cubic lattice of cell 1 at a random place, each point moved on its own.

    S = 1 - |phi(k)|^2 away from Bragg peaks, phi being the characteristic function of the shifts. Uniform
    shifts over a whole cell leave no Bragg peaks (Klatt, Kim & Torquato 2020); Gaussian ones of 0.3 leave
    them from k = 2 pi on.

    Parameters
    ----------
    sides : tuple of float
        Of the window.
    shifts : {"uniform", "Gaussian"}
        How points are moved.

    Returns
    -------
    Process
    """
    d = len(sides)
    axes = [np.arange(-BEYOND, math.ceil(side) + BEYOND + 1.0) for side in sides]
    nodes = np.stack([axis.ravel() for axis in np.meshgrid(*axes, indexing="ij")], axis=1)

    def draw(rng: np.random.Generator) -> FloatArray:
        moved = rng.random(nodes.shape) if shifts == "uniform" else SHIFT * rng.normal(size=nodes.shape)
        x = nodes + rng.random(d) + moved
        return x[((x >= 0) & (x <= sides)).all(axis=1)]

    def s(k: FloatArray) -> FloatArray:
        if shifts != "uniform":
            return 1 - np.exp(-((SHIFT * k) ** 2))
        rng = np.random.default_rng(0)
        directions = rng.normal(size=(4096, d)) if d > 2 else _circle(d)
        directions /= np.linalg.norm(directions, axis=1, keepdims=True)
        phi = np.sinc(k[:, None, None] * directions / (2 * math.pi)).prod(axis=2)
        found: FloatArray = 1 - (phi**2).mean(axis=1)
        return found

    return Process(f"lattice, {shifts} shifts, {d}D", sides, draw, s, 1.0, 0.0, 2.0)


def _circle(d: int) -> FloatArray:
    if d == 1:
        return np.ones((1, 1))
    angle = 2 * math.pi * (np.arange(ANGLES) + 0.5) / ANGLES
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


PROCESSES = (
    poisson((400.0,), 400),
    poisson((30.0, 20.0), 600),
    poisson((10.0, 10.0, 10.0), 1000, fixed=True),
    ginibre(36.0),
    ginibre(36.0, 0.5),
    perturbed_lattice((400.0,), "uniform"),
    perturbed_lattice((40.0, 20.0), "uniform"),
    perturbed_lattice((30.0, 30.0), "Gaussian"),
    perturbed_lattice((12.0, 12.0, 12.0), "uniform"),
)
