"""Structure factor averaged over directions, in bins of the wave number, with errors from a single set."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from scipy import stats

from gbnbench.analysis.window.bin_covariance import relative_covariance
from gbnbench.analysis.window.structure_factor import TaperedPoints
from gbnbench.analysis.window.tapered_sums import GriddedSums, direct_sums, griddable
from gbnbench.analysis.window.tapers import ComplexArray, IntArray, SineTapers
from gbnbench.analysis.window.wave_vectors import (
    Bin,
    bin_edges,
    enumerable,
    every_wave_vector,
    half_count,
    some_wave_vectors,
)
from gbnbench.core.torus import FloatArray
from gbnbench.execution.progress import Progress

if TYPE_CHECKING:
    import pandas as pd

NU_MAX = 2.0  # largest k / (2 pi) over intensity^(1/d)
GRID_DIMENSIONS = 3  # beyond, a point reaches too many nodes
PHASES = 1e8  # sines and cosines that sampled wave vectors may take
LEAST_SAMPLE = 32  # wave vectors of a sampled bin
CONFIDENCE = 0.95
RISE = 0.5  # S from which power leaks to a lower band


def radial_structure_factor(
    seen: TaperedPoints, kmax: float, rng: np.random.Generator, progress: Progress
) -> tuple[pd.DataFrame, FloatArray]:
    """Average the tapered powers over the allowed wave vectors in bins of the wave number.

    Parameters
    ----------
    seen : TaperedPoints
        Points and tapers.
    kmax : float
        Largest wave number, in radians a length.
    rng : numpy.random.Generator
        Draws wave vectors where there are too many for all.
    progress : Progress
        Advances as sums are found.

    Returns
    -------
    table : pandas.DataFrame
        A row a bin: ``k``, effective wave number, at which S is unbiased where it is linear in k^2 over the
        bin and the bandwidth; ``nu``, k / (2 pi) over intensity^(1/d); ``S``; ``standard_error``; ``low`` and
        ``high``, a 95% confidence interval; ``count``, wave vectors of half the space; ``degrees``, how many
        independent exponential powers the mean is worth; ``leakage``, power that side lobes of the tapers
        bring from where S >= 1/2; ``resolved``, whether k is at least the bandwidth and S above twice the
        leakage.
    covariance : (bins, bins) float64
        Of the estimates of S, over the product of their expectations.

    Notes
    -----
    S = sum of |J_p(k)|^2 over the bin and the tapers, over ``weight`` times the sum of the integrals of
    |g|^2. ``degrees`` is 1 over the relative variance of ``relative_covariance``, and 2 degrees S_estimate
    / S is taken to be chi-squared with 2 degrees.
    """
    import pandas as pd

    sides, n = seen.window.sides, seen.u.shape[0]
    bins = _bins(bin_edges(kmax, sides), sides, n, rng)
    tapers = seen.tapers
    totals = np.zeros((len(bins), 3))
    whole, sampled = [[b for b in bins if (b.share == 1) == full] for full in (True, False)]
    progress.start(
        len(tapers.orders) * bool(whole) + sum(len(b.multiples) for b in sampled), 0, "structure factor"
    )
    for group, sums_of in [(whole, _gridded)] * bool(whole) + [(sampled, _direct)] * bool(sampled):
        multiples = np.concatenate([b.multiples for b in group])
        label = np.repeat(np.arange(len(group)), [len(b.multiples) for b in group])
        place = [i for i, b in enumerate(bins) if (b.share == 1) == (group is whole)]
        for rows, sums in sums_of(seen, multiples, progress):
            parts = seen.powers(sums, 2 * math.pi * multiples / sides, rows)
            for column, part in enumerate(parts):
                totals[place, column] += np.bincount(label, part.sum(axis=0), len(group))
    with np.errstate(invalid="ignore", divide="ignore"):
        s, k = totals[:, 0] / (seen.weight * totals[:, 1]), np.sqrt(totals[:, 2] / totals[:, 1])
    covariance = relative_covariance(bins, k, s, tapers)
    degrees = 1 / np.diag(covariance)
    low, high = (
        2 * degrees / stats.chi2.ppf(q, 2 * degrees) for q in ((1 + CONFIDENCE) / 2, (1 - CONFIDENCE) / 2)
    )
    middle = np.array([(b.low + b.high) / 2 for b in bins])
    leaked = leakage(np.array([bins[0].low] + [b.high for b in bins]), s, tapers)
    table = pd.DataFrame(
        {
            "k": k,
            "nu": k / (2 * math.pi) * (seen.window.volume / n) ** (1 / seen.window.d),
            "S": s,
            "standard_error": s / np.sqrt(degrees),
            "low": s * low,
            "high": s * high,
            "count": [len(b.multiples) for b in bins],
            "degrees": degrees,
            "leakage": leaked,
            "resolved": (middle >= tapers.bandwidth) & (s > 2 * leaked),
        }
    )
    return table, covariance


def _bins(edges: FloatArray, sides: FloatArray, n: int, rng: np.random.Generator) -> list[Bin]:
    """Fill bins with all their wave vectors as far as a grid goes, beyond with as many as are affordable."""
    d = len(sides)
    reached = [
        d <= GRID_DIMENSIONS and griddable(np.floor(high * sides / (2 * math.pi)).astype(np.int64))
        for high in edges[1:]
    ]
    on_grid = sum(reached)
    found: list[Bin] = []
    if on_grid:
        every = every_wave_vector(float(edges[on_grid]), sides)
        length = np.linalg.norm(2 * math.pi / sides * every, axis=1)
        order = np.argsort(length, kind="stable")
        cuts = np.searchsorted(length[order], edges[: on_grid + 1])
        found = [
            Bin(edges[i], edges[i + 1], every[order[cuts[i] : cuts[i + 1]]], 1.0) for i in range(on_grid)
        ]
    most = max(LEAST_SAMPLE, int(PHASES / n / max(1, len(reached) - on_grid)))
    for low, high in zip(edges[on_grid:-1], edges[on_grid + 1 :], strict=True):
        drawn = _drawn(low, high, sides, most, rng)
        expected = half_count(low, high, sides)
        found.append(Bin(low, high, drawn, min(len(drawn) / expected, 1 - 1e-12)))
    return [b for b in found if len(b.multiples)]


def _drawn(low: float, high: float, sides: FloatArray, most: int, rng: np.random.Generator) -> IntArray:
    if enumerable(high, sides):
        every = every_wave_vector(high, sides)
        inside: IntArray = every[np.linalg.norm(2 * math.pi / sides * every, axis=1) >= low]
        if len(inside) > most:
            inside = inside[np.sort(rng.choice(len(inside), most, replace=False))]
        return inside
    return some_wave_vectors(low, high, sides, most, rng)


def _gridded(
    seen: TaperedPoints, multiples: IntArray, progress: Progress
) -> Iterator[tuple[slice, ComplexArray]]:
    """Sum one taper after another on the grid."""
    grid = GriddedSums(seen.u, np.abs(multiples).max(axis=0))
    for row, sums in enumerate(grid.of(seen.values, multiples)):
        yield slice(row, row + 1), sums[None]
        progress.advance("structure factor")


def _direct(
    seen: TaperedPoints, multiples: IntArray, progress: Progress
) -> Iterator[tuple[slice, ComplexArray]]:
    """Sum all tapers at once, wave vector by wave vector."""
    yield slice(None), direct_sums(seen.u, seen.values, multiples.astype(np.float64), progress, "float")


def leakage(edges: FloatArray, s: FloatArray, tapers: SineTapers) -> FloatArray:
    """Estimate what side lobes of the tapers bring to low wave numbers from where S first reaches 1/2.

    Parameters
    ----------
    edges : (bins + 1,) float64
        Edges of the bins, in radians a length.
    s : (bins,) float64
        The structure factor of each.
    tapers : SineTapers
        Tapers.

    Returns
    -------
    (bins,) float64
        0 from there on. S times the energy of the tapers at the distance of each higher bin, over all axes,
        along which nearly all of it lies; S is 1 beyond the last bin. What lies within the main lobe does not
        count. Points that repeat along an axis of the window, as those of a lattice, bring more.
    """
    risen = np.flatnonzero(s >= RISE)
    found = np.zeros(len(s))
    if len(risen) == 0:
        return found
    first = int(risen[0])
    middle = (edges[1:] + edges[:-1]) / 2
    lobes = math.pi * (np.array(tapers.counts) + 2) / tapers.sides  # nearer lies the main lobe of each axis
    for i in range(first):
        away = edges[first:] - middle[i]
        beyond = np.sum(
            [tapers.energy_beyond(axis, np.maximum(away, lobe)) for axis, lobe in enumerate(lobes)], axis=0
        )
        found[i] = float(s[first:] @ (beyond[:-1] - beyond[1:])) + float(beyond[-1])
    return found
