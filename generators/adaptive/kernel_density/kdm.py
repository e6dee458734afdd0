"""The kernel density model for a density, sampled by multi-scale Langevin steps (Fattal 2011)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.domain import pixels_of, to_ink, within
from gbnbench.generators.adaptive.kernel_density.kernel_raster import KernelRaster
from gbnbench.generators.adaptive.method import AdaptiveMethod, too_fine
from gbnbench.generators.adaptive.protocol import Told
from gbnbench.generators.kernel_based.density_raster import RESOLUTION
from gbnbench.generators.kernel_based.kernel_density import DRIFT, HOTTEST, MOST, NOISE, SCATTER
from gbnbench.generators.protocol import MOST_ITERATIONS
from gbnbench.generators.ranges import check_range, too_many

COARSEST = 2.0  # cells that the least spacing has, at least
MOST_CELLS = 1 << 22


@dataclass(frozen=True)
class AdaptiveKernelDensity(AdaptiveMethod):
    """Points as interacting particles whose kernels are to add up to the density, at a temperature.

    Parameters
    ----------
    iterations : int
        Langevin steps of every point on each level, >= 1.
    temperature : float
        Of the particles, 0 to 1000: 0 descends, higher keeps more randomness.
    levels : int
        Scales, from coarse to fine, 1 to 12; each has four times the points of the one before.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    The energy is the sum over cells of abs(rho - A), A the sum of kernels rho(x) exp(-pi rho(x) r**2) on the
    points x, which have unit mass and are cut off at 1.19 spacings rho**(-1/2), or at 32 cells; in a box what
    would lie beyond its borders is mirrored at them. On the coarsest level cells are tried in random order
    and become points where that lowers the energy. Then, one after another, points move down the energy's
    slope and by a normal step, as the uniform method does, in units of the local spacing; how a kernel's
    width changes with its place is left out, as in the author's program. Between levels each point splits
    into four. The raster's cells are pixels, unless the least spacing has less than two of them or more than
    four: then they are cut, or put together.

    Settings are those of the author's program. What differs: steps are as long as the local spacing asks, so
    that light and dark regions are treated alike (in the program their variance grows as the spacing, not as
    its square); exactly n points are had as in the uniform method; every point splits, also where spacings
    are many cells; moves out of a box or onto pixels without ink are not made, and kernels are mirrored at
    borders, where they would otherwise cost nothing beyond: the two pixels along each held two to three times
    their points. Points whose kernels do not overlap are moved together, which is the same as one after
    another.

    Cost: 40 CPU s for 10,000 points on 512 x 512 pixels.

    References
    ----------
    Fattal, "Blue-noise point sampling using kernel density model", ACM Trans. Graphics 30(4), 2011.

    Examples
    --------
    >>> from gbnbench.generators.adaptive.density import as_density
    >>> ramp = as_density(np.linspace(0, 1, 32)[:, None] * np.ones(32))
    >>> AdaptiveKernelDensity(iterations=2)(ramp, 50, np.random.default_rng(0)).shape
    (50, 2)
    """

    name: ClassVar[str] = "kdm"
    summary: ClassVar[str] = "kernel density model, sampled by Langevin steps (Fattal 2011)"
    reference: ClassVar[str] = "Fattal, Blue-noise point sampling using kernel density model, 2011"
    iterations: int = 100
    temperature: float = 0.5
    levels: int = 2

    def __post_init__(self) -> None:
        check_range("iterations", self.iterations, 1, MOST_ITERATIONS)
        check_range("temperature", self.temperature, 0, HOTTEST)
        check_range("levels", self.levels, 1, 12)

    def refusal(self, density: Density, n: int) -> str | None:
        """Say why the model is not sampled, as ``AdaptiveMethod.refusal`` does."""
        if density.d != 2:
            return f"kernels lie on a raster in the plane; got {density.d} axes, not 2"
        if reason := too_many(n, MOST, "for steps point by point"):
            return reason
        return too_fine(
            density, n, math.ceil(density.values.size / cell_side(density, n) ** 2), most=MOST_CELLS
        )

    def one_set(self, density: Density, n: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one set, as ``AdaptiveMethod.one_set`` describes it."""
        sizes = [n]
        for _ in range(self.levels - 1):
            sizes.insert(0, -(-sizes[0] // 4))
        finest, steps = cell_side(density, n), self.iterations * self.levels
        raster = KernelRaster(density, sizes[0], finest * 2 ** (self.levels - 1))
        x = to_ink(density, initial_points(raster, sizes[0], rng))
        raster = KernelRaster(density, sizes[0], finest * 2 ** (self.levels - 1))
        raster.add(x)
        for level, size in enumerate(sizes):
            if level:
                raster = KernelRaster(density, size, finest * 2 ** (self.levels - 1 - level))
                x = split_points(density, x, size, raster, rng)
            for left in reversed(range(self.iterations)):
                noise = NOISE * math.sqrt(self.temperature) if left else 0.0
                langevin_step(density, raster, x, noise * rng.standard_normal(x.shape))
                told((level + 1) * self.iterations - left, steps, "steps of kdm")
        return x


def cell_side(density: Density, n: int) -> float:
    """Choose the side of the finest raster's cells: a pixel, if the least spacing has two to four of them.

    Parameters
    ----------
    density : Density
        Of an image.
    n : int
        Points.

    Returns
    -------
    float
        In pixels.
    """
    least = 1 / math.sqrt(float(density.of_points(n).max()))
    return min(max(1.0, least / RESOLUTION), least / COARSEST)


def langevin_step(density: Density, raster: KernelRaster, x: FloatArray, noise: FloatArray) -> None:
    """Move each point down the slope of the energy and by its noise, one after another, in place.

    Parameters
    ----------
    density : Density
        Of the image.
    raster : KernelRaster
        With the points' kernels; kept up to date.
    x : (n, 2) float64
        Points, in pixels.
    noise : (n, 2) float64
        What is added to them, in local spacings.
    """
    spacing = raster.spacings(x)
    for group, reach in raster.apart(x, raster.reaches(spacing)):
        own = spacing[group, None]
        cells, heights, away = raster.kernels(x[group], spacing[group], reach)
        signed = np.where(raster.lack[cells] <= 0, heights, -heights)
        np.add.at(raster.lack, cells, heights / own**2)
        slope = np.einsum("mw,amw->ma", signed, away) * raster.area / own**2
        moved = x[group] + own * (noise[group] - DRIFT * slope)
        if raster.toroidal:
            moved = within(density, moved)
        staying = ~((moved >= 0) & (moved < raster.shape)).all(axis=1)
        moved[staying] = x[group][staying]
        staying = density.values[pixels_of(density, moved)] == 0
        moved[staying] = x[group][staying]
        x[group] = moved
        raster.add(moved)


def initial_points(raster: KernelRaster, n: int, rng: np.random.Generator) -> FloatArray:
    """Put points on cells where they lower the energy, tried in a random order that favours dense ones.

    Parameters
    ----------
    raster : KernelRaster
        Without points; receives their kernels.
    n : int
        Points.
    rng : numpy.random.Generator
        Orders the cells.

    Returns
    -------
    (n, 2) float64
        In pixels. Where too few lower the energy, the rest are where most of the density is left.

    Notes
    -----
    The next cell is drawn in proportion to its density, so that each spacing is tried equally often: in an
    even order light regions, where a spacing has many cells, would be full before dark ones.
    """
    wanted = raster.lack.copy()
    inked = np.flatnonzero(wanted > 0)
    places = raster.centres(inked)
    spacing = 1 / np.sqrt(wanted[inked])
    reach = raster.reaches(spacing)
    chosen: list[int] = []
    for k in np.argsort(rng.exponential(size=len(inked)) / wanted[inked], kind="stable").tolist():
        if len(chosen) == n:
            break
        cells, heights, _ = raster.kernels(places[k, None], spacing[k, None], int(reach[k]))
        before = raster.lack[cells]
        after = before - heights / spacing[k] ** 2
        if np.abs(after).sum() < np.abs(before).sum():
            np.subtract.at(raster.lack, cells, heights / spacing[k] ** 2)
            chosen.append(k)
    left = raster.lack[inked] / wanted[inked]
    while len(chosen) < n:
        chosen.append(int(left.argmax()))
        raster.add(places[chosen[-1:]])
        left = raster.lack[inked] / wanted[inked]
    return places[chosen]


def split_points(
    density: Density, x: FloatArray, n: int, raster: KernelRaster, rng: np.random.Generator
) -> FloatArray:
    """Split each point into four, scattered about it, and keep as many as are wanted.

    Parameters
    ----------
    density : Density
        Of the image.
    x : (m, 2) float64
        In pixels.
    n : int
        Points that are wanted, at most 4 m.
    raster : KernelRaster
        Without points; receives their kernels.
    rng : numpy.random.Generator
        Scatters, and drops what is too many.

    Returns
    -------
    (n, 2) float64
        In pixels.
    """
    parts = np.repeat(x, 4, axis=0)
    parts = parts[np.sort(rng.permutation(len(parts))[:n])]
    scatter = SCATTER * raster.spacings(parts)[:, None] * rng.standard_normal(parts.shape)
    scattered = to_ink(density, within(density, parts + scatter))
    raster.add(scattered)
    return scattered
