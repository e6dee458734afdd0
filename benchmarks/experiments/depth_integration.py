"""Variance of integration over random toroidal shifts: deep sets beside Gaussian Blue Noise and others.

python -m gbnbench.benchmarks.experiments.depth_integration benchmarks/results/deep/depth_integration.csv
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.integration.integrands.gaussians import Gaussians
from gbnbench.analysis.integration.integrands.half_space import HalfSpaces
from gbnbench.analysis.integration.integrands.korobov import Korobov
from gbnbench.analysis.integration.integrands.protocol import Family, Integrand
from gbnbench.analysis.spectrum.power_of_each import each_power
from gbnbench.benchmarks.timing.machine import Rows
from gbnbench.core.torus import FloatArray
from gbnbench.generators.registry import find, generate

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
COLUMNS = ("n", "d", "integrand", "source", "variance", "standard_error", "predicted")


@dataclass(frozen=True)
class FamilySample:
    """Integrands of one family.

    Attributes
    ----------
    family : Family
        What draws them.
    count : int
        How many are drawn.
    energy : callable or None
        Mean of |transform|^2 over the family, (m, d) frequencies -> (m,); None where it is not periodic.
    """

    family: Family
    count: int
    energy: Callable[[NDArray[np.int64]], FloatArray] | None = None


FAMILIES = {
    "64 Gaussians": FamilySample(Gaussians(), 12, Gaussians().mean_energy),
    "half space": FamilySample(HalfSpaces(), 200),
    "Korobov": FamilySample(Korobov(), 100, Korobov().mean_energy),
}


def measured(
    integrands: Sequence[Integrand], x: FloatArray, shifts: int, rng: np.random.Generator
) -> tuple[float, float]:
    """Mean squared error of the mean over shifted points.

    Parameters
    ----------
    integrands : sequence
        Functions on the unit box.
    x : (sets, n, d) float64
        Points.
    shifts : int
        Random toroidal shifts of each set for each integrand.
    rng : numpy.random.Generator
        Source of the shifts.

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


def predicted(energy: Callable[[NDArray[np.int64]], FloatArray], x: FloatArray, fmax: int) -> float:
    """Compute the variance that the power spectra predict.

    Parameters
    ----------
    energy : callable
        Mean over the family of |transform|^2, (m, d) frequencies -> (m,).
    x : (sets, n, d) float64
        Points.
    fmax : int
        Largest harmonic on each axis.

    Returns
    -------
    float
        Sum over f != 0, |f_a| <= fmax, of |transform|^2 P / n.

    Notes
    -----
    Exact over all shifts where the spectrum of the integrand ends within the cube (Durand 2011; Pilleboue
    et al. 2015).
    """
    _, n, d = x.shape
    power = each_power(x, fmax)[1].power.ravel()
    f = np.indices((2 * fmax + 1,) * d).reshape(d, -1).T - fmax
    away = f.any(axis=1)
    return float(np.sum(energy(f[away]) * power[away]) / n)


def rows(
    cases: tuple[tuple[int, int, dict[str, float], int], ...] = CASES,
    sets: int = SETS,
    shifts: int = SHIFTS,
) -> Iterator[dict[str, Any]]:
    """Yield one row for each case, source and family of integrands.

    Parameters
    ----------
    cases : tuple
        n, d, the edges named in ``SOURCES``, and the largest harmonic of the predicted variance.
    sets, shifts : int
        Number of sets, and of random shifts of each.

    Returns
    -------
    iterator of dict
    """
    for n, d, edges, fmax in cases:
        for pattern in SOURCES:
            source = pattern.format(**edges)
            if find(source).refusal(n, d) is not None:
                continue
            x = generate(source, n=n, d=d, realizations=sets).reshape(sets, n, d)
            for name, plan in FAMILIES.items():
                rng = np.random.default_rng([n, d])  # the same integrands and shifts for every source
                drawn = [plan.family.draw(d, rng) for _ in range(plan.count)]
                variance, error = measured(drawn, x, shifts, rng)
                told = predicted(plan.energy, x, fmax) if plan.energy else math.nan
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
