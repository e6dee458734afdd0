"""Void-and-cluster patterns as point sets (Ulichney 1993)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.kernel_based.raster_energy import RasterEnergy, pixel_centres
from gbnbench.generators.kernel_based.raster_kernel import RasterKernel, gaussian
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import check_above, check_range, too_many_axes
from gbnbench.generators.set_by_set import SetBySet, Told

MOST_PIXELS = 2**20
NARROWEST = 0.1  # pixels: at the next pixel a Gaussian is then 2e-22 of its height, and all are alike
TOLD = 16  # moves after which progress is told
LEAST_GAIN = 1e-12  # of a swap, in heights of the Gaussian: above what rounding and ties make


@dataclass(frozen=True)
class VoidAndCluster(SetBySet):
    """The ones of a void-and-cluster dither pattern, at the centres of their pixels.

    Parameters
    ----------
    share : float
        Pixels that become points, 2**-20 <= share < 1: the raster has about n / share pixels.
    pixels : int
        Pixels on a side of the raster instead; 0 takes them from ``share``.
    sigma : float
        Width of the Gaussian in pixels, 0.1 to 20; Ulichney's is 1.5.
    initial : float
        Share of ones in the initial binary pattern, 0 < initial <= 0.5.
    shift : bool
        Move the whole set by a random vector of the torus.
    jitter : bool
        Move each point to a random place in its pixel.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    Random pixels become the initial binary pattern by moving the one in the tightest cluster to the largest
    void for as long as that lowers the sum over pairs of Gaussians. From there ones are taken from the
    tightest cluster (phase I of the rank order) or put into the largest void (phase II) until n are left.
    Phase III, which takes zeros from their tightest cluster once ones are the majority, is the same as phase
    II on a torus: the zeros' sum is a constant less the ones'. Pixels are equal but for 1e-13 at random,
    where Ulichney takes any.

    References
    ----------
    Ulichney, "The void-and-cluster method for dither array generation", Proc. SPIE 1913, 1993.

    Examples
    --------
    >>> VoidAndCluster(shift=False)(16, 2, np.random.default_rng(0)).shape
    (16, 2)
    """

    name: ClassVar[str] = "voidcluster"
    summary: ClassVar[str] = "void-and-cluster dither pattern, d <= 3 (Ulichney 1993)"
    family: ClassVar[Family] = "kernel-based"
    dimensions: ClassVar[tuple[int, int | None]] = (1, 3)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Ulichney, The void-and-cluster method for dither array generation, 1993"
    share: float = 0.0625
    pixels: int = 0
    sigma: float = 1.5
    initial: float = 0.1
    shift: bool = True
    jitter: bool = False

    def __post_init__(self) -> None:
        if not 1 / MOST_PIXELS <= self.share < 1:
            raise InputError(f"share must be 1/2**20 or more, a pixel of all, and below 1; got {self.share}")
        if self.pixels < 0:
            raise InputError(f"pixels must be 0, for as many as share says, or more; got {self.pixels}")
        check_range("sigma", self.sigma, NARROWEST, 20, "pixels")
        check_above("initial", self.initial, 0, 0.5)

    def side(self, n: int, d: int) -> int:
        """Pixels on a side of the raster.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        int
        """
        return self.pixels or max(round((n / self.share) ** (1 / d)), 1)

    def refusal(self, n: int, d: int) -> str | None:
        """Say why the raster cannot hold the points or is too large.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason, with the nearest number that fits.
        """
        if reason := too_many_axes(d, 3, "for void-and-cluster"):
            return reason
        side = self.side(n, d)
        if side**d > MOST_PIXELS:
            most = int(MOST_PIXELS ** (1 / d) + 1e-9)
            if self.pixels:
                return f"pixels must be at most {most} a side in {d}D; got n={n} with pixels={self.pixels}"
            fits = int(self.share * most**d)
            return (
                f"a raster of share={self.share:g} must have at most {MOST_PIXELS} pixels, whose sums are "
                f"searched for each point; got n={n}, nearest is {fits}"
            )
        if n > side**d:
            return f"a raster of {side}**{d} pixels holds no n={n} points; nearest is {side**d}"
        return None

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        side = self.side(n, d)
        shape = (side,) * d
        kernel = gaussian(shape, self.sigma)
        pattern = initial_binary_pattern(shape, kernel, self.initial, rng, lambda share: told(share / 2))
        for k in range(swaps := abs(surplus := pattern.count - n)):
            if surplus > 0:
                pattern.remove(pattern.tightest_cluster())
            else:
                pattern.add(pattern.largest_void())
            if k % TOLD == 0:
                told(0.5 + k / swaps / 2)
        x = pixel_centres(np.flatnonzero(pattern.ones), side, d)
        if self.jitter:
            x += (rng.random((n, d)) - 0.5) / side
        return wrap(x + rng.random(d)) if self.shift else wrap(x)


def initial_binary_pattern(
    shape: Sequence[int],
    kernel: RasterKernel,
    share: float,
    rng: np.random.Generator,
    told: Told = lambda _: None,
) -> RasterEnergy:
    """Random ones, moved from the tightest cluster to the largest void until that lowers the energy no more.

    Parameters
    ----------
    shape : sequence of int
        Pixels on each axis.
    kernel : RasterKernel
        What a one gives to the pixels around it.
    share : float
        Of ones, of which there is at least one.
    rng : numpy.random.Generator
        Chooses the ones and between equal pixels.
    told : callable
        Takes the share that may be done: how many moves there will be is not known.

    Returns
    -------
    RasterEnergy
        Whose every swap of its tightest cluster with the largest void is none or no gain.
    """
    pattern = RasterEnergy(shape, kernel, rng)
    pixels = len(pattern.ones)
    for pixel in rng.choice(pixels, size=max(round(share * pixels), 1), replace=False):
        pattern.add(int(pixel))
    moves = 0
    while True:  # ends: each move lowers the energy, and there are finitely many patterns
        moves += 1
        if moves % TOLD == 0:
            told(moves / (moves + pattern.count))
        cluster = pattern.tightest_cluster()
        pattern.remove(cluster)
        void = pattern.largest_void()
        if pattern.at(void) > pattern.at(cluster) - LEAST_GAIN:
            pattern.add(cluster)
            return pattern
        pattern.add(void)
