"""Power at low frequencies of the patterns that a dither mask makes, over that of as many random pixels."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.analysis.spectrum.shells import EDGE
from gbnbench.core.errors import InputError
from gbnbench.core.results.radial import ShellSpectrum
from gbnbench.core.sides import as_sides

LEVELS = (1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2, 3 / 4, 7 / 8, 15 / 16, 31 / 32)


@dataclass(frozen=True)
class PatternPower:
    """How little power a pattern has below its principal frequency.

    Attributes
    ----------
    level : float
        Share of ones that was asked for.
    ones : int
        Pixels that are one.
    low, lowest : float
        Mean power up to half and up to a quarter of the principal frequency, over that of as many random
        pixels, which is 1 for white dither; the lowest shell where no frequency lies so low.
    """

    level: float
    ones: int
    low: float
    lowest: float


def pattern_power(ranks: NDArray[np.int64], level: float) -> PatternPower:
    """Measure the pattern of the pixels whose ranks are below a share of all.

    Parameters
    ----------
    ranks : (rows, columns) int64
        Each of 0 to pixels - 1 once, or a frame of a mask: any ranks, of which the least are taken.
    level : float
        Share of ones, above 0 and below 1.

    Returns
    -------
    PatternPower

    Raises
    ------
    InputError
        If that is no pixel, or all of them.

    Notes
    -----
    Ulichney's principal frequency is sqrt(g) cycles a pixel at level g <= 1/2 and sqrt(1 - g) above, the
    mean distance of the minority; no more than 1/2 is taken, since a raster has no more along an axis. Of m
    random ones among N pixels the power is (N - m) / (N - 1) at every frequency but those of the raster.

    Examples
    --------
    >>> ranks = np.random.default_rng(0).permutation(64 * 64).reshape(64, 64)
    >>> round(pattern_power(ranks, 0.25).low, 1)
    1.0
    """
    pixels = ranks.size
    ones = round(level * pixels)
    if not 0 < ones < pixels:
        raise InputError(f"a pattern has ones and zeros; level {level:g} of {pixels} pixels has {ones} ones")
    principal = min(math.sqrt(min(ones, pixels - ones)), math.sqrt(pixels) / 2)  # cycles a side, area 1
    spectrum = pattern_spectrum(ranks, ones, math.ceil(principal / 2) + 1)  # the lowest |k| is 1 or less
    white = (pixels - ones) / (pixels - 1)
    return PatternPower(
        level, ones, *(_mean(spectrum, principal * part) / white for part in (0.5, 0.25))
    )  # fmt: skip


def pattern_spectrum(ranks: NDArray[np.int64], ones: int, fmax: int) -> ShellSpectrum:
    """Find the power of the centres of the pixels with the least ranks.

    Parameters
    ----------
    ranks : (rows, columns) int64
        Ranks.
    ones : int
        Pixels that count.
    fmax : int
        Largest |k| in cycles per side of a square of the mask's area.

    Returns
    -------
    ShellSpectrum
    """
    least = np.argsort(ranks.ravel(), kind="stable")[:ones]
    centres = (np.stack(np.unravel_index(least, ranks.shape), axis=1) + 0.5) / ranks.shape
    return shells(centres, fmax, sides=as_sides(ranks.shape, 2))


def _mean(spectrum: ShellSpectrum, end: float) -> float:
    low = spectrum.frequency <= end * (1 + EDGE)
    if not low.any():
        return float(spectrum.power[0])
    return float(np.average(spectrum.power[low], weights=spectrum.count[low]))
