"""Points drawn from a kernel density model by multi-scale Langevin steps (Fattal 2011)."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.kernel_based.density_raster import DensityRaster
from gbnbench.generators.protocol import MOST_ITERATIONS, Family
from gbnbench.generators.ranges import check_range, too_many, too_many_axes
from gbnbench.generators.set_by_set import SetBySet, Told

# The author's program at its density of 0.43 a pixel, where a spacing is 4.06 pixels, in spacings.
DRIFT = 0.695  # times the integral of sign(sum of kernels - 1) exp(-pi u**2) u, u in spacings
NOISE = 0.0833  # standard deviation of a step at temperature 1
HOTTEST = 1000.0  # where a step scatters points by 2.6 spacings: uniform ones
SCATTER = 0.3  # of the points that one splits into, about it
MOST = 100_000


@dataclass(frozen=True)
class KernelDensityModel(SetBySet):
    """Points as interacting particles whose kernels are to add up to the density, at a temperature.

    Parameters
    ----------
    iterations : int
        Langevin steps of every point on each level, >= 1.
    temperature : float
        Of the particles, 0 to 1000: 0 descends, higher keeps more randomness.
    levels : int
        Scales, from coarse to fine, 1 to 12; each has 2**d times the points of the one before.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    The energy is the sum over pixels of abs(1 - A), A the sum of Gaussians exp(-pi r**2) on the points, r in
    spacings n**(-1/d), cut off at 1.19 as in the author's program; a spacing has four pixels. On the coarsest
    level pixels are tried in random order and become points where that lowers the energy. Then, one point
    after another, x moves down the energy's slope and by a normal step whose variance is as the temperature;
    the last step of a level is without noise. Between levels each point splits into 2**d.

    Settings are those of the author's program, which has 100 steps and two levels for a set of this kind; the
    text speaks of 15 steps a scale, whose noise floor is nearly double. It is two-dimensional: step lengths
    in d = 1 and 3 are ours, the same in spacings. Where the author takes as many points as the density
    makes, exactly n are had: the coarsest level stops at ceil(n / 2**d), or fills the emptiest pixels if too
    few were accepted, and surplus points of a split are dropped at random. Points whose kernels do not
    overlap are moved together, which is the same as one after another.

    References
    ----------
    Fattal, "Blue-noise point sampling using kernel density model", ACM Trans. Graphics 30(4), 2011.

    Examples
    --------
    >>> KernelDensityModel(iterations=2)(16, 2, np.random.default_rng(0)).shape
    (16, 2)
    """

    name: ClassVar[str] = "kdm"
    summary: ClassVar[str] = "kernel density model, sampled by Langevin steps, d <= 3 (Fattal 2011)"
    family: ClassVar[Family] = "kernel-based"
    dimensions: ClassVar[tuple[int, int | None]] = (1, 3)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Fattal, Blue-noise point sampling using kernel density model, 2011"
    iterations: int = 100
    temperature: float = 0.5
    levels: int = 2

    def __post_init__(self) -> None:
        check_range("iterations", self.iterations, 1, MOST_ITERATIONS)
        check_range("temperature", self.temperature, 0, HOTTEST)
        check_range("levels", self.levels, 1, 12)

    def refusal(self, n: int, d: int) -> str | None:
        """Say why the model is not sampled.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason; None for d <= 3 and n that take minutes at most.
        """
        return too_many_axes(d, 3, "for a raster of densities") or too_many(
            n, MOST, "for steps point by point"
        )

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        sizes = [n]
        for _ in range(self.levels - 1):
            sizes.insert(0, -(-sizes[0] // 2**d))
        raster = DensityRaster(sizes[0], d)
        x = initial_points(raster, rng)
        before, work = 0, sum(sizes)
        self._relax(raster, x, rng, functools.partial(_part, told, 0.0, sizes[0] / work))
        for size, coarser in zip(sizes[1:], sizes, strict=False):
            before += coarser
            finer = DensityRaster(size, d)
            x = split_points(x * (finer.side / raster.side), finer, rng)
            raster = finer
            self._relax(raster, x, rng, functools.partial(_part, told, before / work, size / work))
        return wrap(x / raster.side)

    def _relax(self, raster: DensityRaster, x: FloatArray, rng: np.random.Generator, told: Told) -> None:
        noise = NOISE * math.sqrt(self.temperature) * raster.spacing
        for left in reversed(range(self.iterations)):
            langevin_step(raster, x, noise * rng.standard_normal(x.shape) if left else np.zeros_like(x))
            told(1 - left / self.iterations)


def _part(told: Told, start: float, length: float, share: float) -> None:
    """Tell the share of a part as one of the whole."""
    told(start + length * share)


def langevin_step(raster: DensityRaster, x: FloatArray, noise: FloatArray) -> None:
    """Move each point down the slope of the energy and by its noise, one after another, in place.

    Parameters
    ----------
    raster : DensityRaster
        With the points' kernels; kept up to date.
    x, noise : (n, d) float64
        Points and what is added to them, in pixels.
    """
    length = DRIFT * raster.spacing ** (1 - raster.d)
    for group in raster.apart(x):
        pixels, heights, away = raster.kernels(x[group])
        signed = np.where(raster.lack[pixels] <= 0, heights, -heights)
        np.add.at(raster.lack, pixels.ravel(), heights.ravel())
        moved = x[group] - length * np.sum(signed * away, axis=2).T + noise[group]
        x[group] = moved = moved % raster.side
        raster.add(moved)


def initial_points(raster: DensityRaster, rng: np.random.Generator) -> FloatArray:
    """Put as many points as the raster is for on pixels where they lower the energy, tried in random order.

    Parameters
    ----------
    raster : DensityRaster
        Without points; receives their kernels.
    rng : numpy.random.Generator
        Orders the pixels.

    Returns
    -------
    (n, d) float64
        In pixels. Where too few lower the energy, the rest are where density lacks most.
    """
    places = np.stack(np.unravel_index(np.arange(raster.side**raster.d), (raster.side,) * raster.d), axis=1)
    chosen: list[int] = []
    for pixel in rng.permutation(len(places)):
        pixels, heights, _ = raster.kernels(places[pixel, None].astype(np.float64))
        lack = raster.lack[pixels]
        if np.abs(lack - heights).sum() < np.abs(lack).sum():
            raster.add(places[pixel, None].astype(np.float64))
            chosen.append(int(pixel))
            if len(chosen) == raster.n:
                break
    while len(chosen) < raster.n:
        chosen.append(int(raster.lack.argmax()))
        raster.add(places[chosen[-1:]].astype(np.float64))
    return np.asarray(places[chosen], np.float64)


def split_points(x: FloatArray, raster: DensityRaster, rng: np.random.Generator) -> FloatArray:
    """Split each point into 2**d, scattered about it, and keep as many as the finer raster is for.

    Parameters
    ----------
    x : (m, d) float64
        In pixels of the finer raster.
    raster : DensityRaster
        Without points; receives their kernels.
    rng : numpy.random.Generator
        Scatters, and drops what is too many.

    Returns
    -------
    (n, d) float64
        In pixels.
    """
    parts = np.repeat(x, 2**raster.d, axis=0)
    parts = parts[np.sort(rng.permutation(len(parts))[: raster.n])]
    scattered: FloatArray = parts + SCATTER * raster.spacing * rng.standard_normal(parts.shape)
    scattered %= raster.side
    raster.add(scattered)
    return scattered
