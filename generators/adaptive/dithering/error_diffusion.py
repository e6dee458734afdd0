"""Error diffusion (Floyd & Steinberg 1976)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.dithering.pixel_density import (
    centres,
    dithering_refusal,
    parts_for_dithering,
)
from gbnbench.generators.adaptive.method import AdaptiveMethod
from gbnbench.generators.adaptive.protocol import Told

TRIES = 12  # factors of the density until n pixels turn black
NOISE = 0.05  # added to thresholds, so that sets of different seeds differ


@dataclass(frozen=True)
class FloydSteinberg(AdaptiveMethod):
    """The pixels that error diffusion turns black, row by row and back.

    Notes
    -----
    A pixel turns black where the density and what its neighbours left over reach a half, with 0.05 of noise;
    what is left goes to the next ones by 7, 3, 5 and 1 sixteenths. Ink runs over the image's borders, so that
    the density is multiplied by what makes n pixels black, as nearly as a dozen tries tell; the few that are
    then too many or too few are those whose sums were nearest to the threshold.

    References
    ----------
    Floyd & Steinberg, "An adaptive algorithm for spatial greyscale", Proc. SID 17(2), 1976.

    Examples
    --------
    >>> from gbnbench.generators.adaptive.density import as_density
    >>> ramp = as_density(np.linspace(0, 1, 32)[:, None] * np.ones(32))
    >>> FloydSteinberg()(ramp, 50, np.random.default_rng(0)).shape
    (50, 2)
    """

    name: ClassVar[str] = "floydsteinberg"
    summary: ClassVar[str] = "error diffusion on the pixels (Floyd & Steinberg 1976)"
    reference: ClassVar[str] = "Floyd & Steinberg, An adaptive algorithm for spatial greyscale, 1976"

    def refusal(self, density: Density, n: int) -> str | None:
        """Say why a halftone has no n points, as ``AdaptiveMethod.refusal`` does."""
        return dithering_refusal(density, n)

    def one_set(self, density: Density, n: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one set, as ``AdaptiveMethod.one_set`` describes it."""
        parts = parts_for_dithering(density, n)
        wanted = density.finer(parts).of_points(n)
        threshold = 0.5 + NOISE * (rng.random(wanted.shape) - 0.5)
        factor, best = 1.0, None
        for done in range(TRIES):
            black, excess = diffuse(wanted * factor, threshold)
            count = int(black.sum())
            told(done + 1, TRIES, "tries of floydsteinberg")
            if best is None or abs(count - n) < abs(int(best[0].sum()) - n):
                best = black, excess
            if count == n:
                break
            factor *= 1 + (n - count) / max(n, 1)
        assert best is not None  # noqa: S101 - there is one try at least
        return centres(_exactly(*best, wanted, n), parts)


def diffuse(density: FloatArray, threshold: FloatArray) -> tuple[NDArray[np.bool_], FloatArray]:
    """Diffuse errors over an image, rows from left to right and back in turn.

    Parameters
    ----------
    density : (rows, columns) float64
        Points a pixel.
    threshold : (rows, columns) float64
        From which on a pixel turns black.

    Returns
    -------
    black : (rows, columns) bool
    excess : (rows, columns) float64
        What a pixel had above its threshold.
    """
    rows, columns = density.shape
    black, excess = np.zeros(density.shape, bool), np.empty(density.shape)
    below = [0.0] * (columns + 2)
    for i in range(rows):
        ahead = i % 2 == 0
        step = 1 if ahead else -1
        wanted = (density[i] + np.array(below[1:-1])).tolist()
        limits, below, carried = threshold[i].tolist(), [0.0] * (columns + 2), 0.0
        on, over = [False] * columns, [0.0] * columns
        for j in range(columns) if ahead else range(columns - 1, -1, -1):
            value = wanted[j] + carried
            over[j] = value - limits[j]
            if value >= limits[j]:
                on[j] = True
                value -= 1.0
            carried = value * 0.4375
            below[j + 1 - step] += value * 0.1875
            below[j + 1] += value * 0.3125
            below[j + 1 + step] += value * 0.0625
        black[i], excess[i] = on, over
    return black, excess


def _exactly(black: NDArray[np.bool_], excess: FloatArray, wanted: FloatArray, n: int) -> NDArray[np.bool_]:
    """Turn those pixels that were nearest to their thresholds until n are black."""
    flat, lack = black.ravel().copy(), n - int(black.sum())
    if lack < 0:
        on = np.flatnonzero(flat)
        flat[on[np.argsort(excess.ravel()[on], kind="stable")[:-lack]]] = False
    elif lack > 0:
        off = np.flatnonzero(~flat & (wanted.ravel() > 0))
        flat[off[np.argsort(-excess.ravel()[off], kind="stable")[:lack]]] = True
    return flat.reshape(black.shape)
