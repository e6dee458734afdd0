"""Quality and cost of the bundled generators' sets over fresh seeds.

python -m gbnbench.benchmarks.experiments.quality benchmarks/results/gbn/quality.csv [NAME...]
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from gbnbench.analysis.measures import measures
from gbnbench.analysis.radial.anisotropy import shell_variance
from gbnbench.analysis.radial.radial_power import shells_from_cube
from gbnbench.analysis.spectrum.limits import default_fmax
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.shell_spectrum import shells as shells_alone
from gbnbench.benchmarks.timing.machine import Rows, describe
from gbnbench.core.results.radial import ShellSpectrum
from gbnbench.generators.registry import generate

SEED = 2022
WIDE = 0.65  # the profile is fitted over 0.05 <= nu <= 0.65
LARGE = 20_000  # points above which only the lowest shells are found


@dataclass(frozen=True)
class QualityCase:
    """Sets of one generator.

    Attributes
    ----------
    name : str
        What the case is called.
    generator : str
        With its settings.
    n, d, sets : int
        How many points, dimensions, realizations.
    """

    name: str
    generator: str
    n: int
    d: int
    sets: int


CASES = (
    QualityCase("plane", "gbn", 1024, 2, 10),
    QualityCase("isotropy", "gbn", 1024, 2, 32),
    QualityCase("plane-4096", "gbn", 4096, 2, 2),
    QualityCase("plane-100000", "gbn[gradients=300]", 100_000, 2, 1),
    QualityCase("space-4096", "gbn[gradients=300]", 4096, 3, 1),
    QualityCase("eight-4096", "gbn[gradients=300]", 4096, 8, 1),
    QualityCase("deep", "deep", 1024, 2, 10),
    QualityCase("deep-16384", "deep", 16_384, 2, 1),
    QualityCase("deep-100000", "deep", 100_000, 2, 1),
    QualityCase("deep-space", "deep", 4096, 3, 1),
    QualityCase("deep-five", "deep", 2048, 5, 1),
)
COLUMNS = (
    "case", "generator", "n", "d", "sets", "CPU s a set", "noise floor", "P(1)", "evacuated energy", "peak",
    "v6", "psi6", "c", "residual dB", "anisotropy over reference dB", "farthest ring, standard deviations",
)  # fmt: skip


def profile_fit(shells: ShellSpectrum) -> tuple[float, float]:
    """Slope c of ln P over nu^2 on 0.05 <= nu <= 0.65, and the rms residual in dB."""
    band = (shells.nu >= 0.05) & (shells.nu <= WIDE)
    if band.sum() < 3:
        return math.nan, math.nan
    square, log = shells.nu[band] ** 2, np.log(shells.power[band])
    fit = np.polyfit(square, log, 1)
    residual = math.sqrt(float(np.mean((log - np.polyval(fit, square)) ** 2)))
    return float(fit[0]), residual * 10 / math.log(10)


def farthest_ring(shells: ShellSpectrum) -> float:
    """Largest distance of a ring's anisotropy from -10 log10 M, in standard deviations, 0.1 <= nu <= 2.

    Notes
    -----
    With k degrees of freedom a mean of exponential variates' relative variances is known to sqrt(2 / k), that
    is 4.34 sqrt(2 / k) dB. Rings of fewer than 20 are left out: their distribution is not near a normal one.
    """
    relative, freedom = shell_variance(shells.power, shells.deviation, shells.count / 2, shells.realizations)
    ring = np.rint(shells.frequency).astype(np.int64)
    total, degrees = np.bincount(ring, relative), np.bincount(ring, freedom)
    nu = np.arange(len(total)) * shells.spacing
    usable = (degrees >= 20) & (nu >= 0.1) & (nu <= 2)
    if not usable.any():
        return math.nan
    away = 10 * np.log10(total[usable] / degrees[usable] * shells.realizations)
    return float(np.abs(away / (10 / math.log(10) * np.sqrt(2 / degrees[usable]))).max())


def measure(case: QualityCase) -> dict[str, Any]:
    """Draw a case's sets and measure them, in double."""
    generate(case.generator, n=min(case.n, 64), d=case.d)  # builds some kernels, imports the rest
    began = time.process_time()
    x = generate(case.generator, n=case.n, d=case.d, seed=SEED, realizations=case.sets)
    seconds = (time.process_time() - began) / case.sets
    sets = x.reshape(-1, case.n, case.d)
    row: dict[str, Any] = dict.fromkeys(COLUMNS, math.nan)
    row |= {"case": case.name, "generator": case.generator, "n": case.n, "d": case.d, "sets": case.sets}
    row["CPU s a set"] = seconds
    if case.n > LARGE:
        found = shells_alone(x, math.ceil(0.7 * case.n ** (1 / case.d)))
    else:
        found = shells_from_cube(periodogram(x, default_fmax(case.n, case.d, case.sets)))
        told = measures(x)
        for column, name in (
            ("evacuated energy", "evacuated_energy"), ("peak", "peak"), ("v6", "valence6"), ("psi6", "psi6"),
        ):  # fmt: skip
            row[column] = told[name]
        row["anisotropy over reference dB"] = told["anisotropy_db"] + 10 * math.log10(len(sets))
        row["farthest ring, standard deviations"] = farthest_ring(found)
    low = (found.nu <= 0.25) | (found.frequency == found.frequency.min())
    row["noise floor"] = float(np.average(found.power[low], weights=found.count[low]))
    row["P(1)"] = float(found.power[0])
    row["c"], row["residual dB"] = profile_fit(found)
    return row


def run(names: Sequence[str]) -> Iterator[dict[str, Any]]:
    """One row a case; of those named, or of all."""
    for case in CASES:
        if not names or case.name in names:
            yield measure(case)


def main(arguments: list[str]) -> None:
    """Print the rows, and write them to the file named."""
    machine = describe()
    print(f"# {machine['processor']}, {machine['cores']} cores; {machine['device']}")
    with ExitStack() as stack:
        kept = [stack.enter_context(Rows(Path(path), COLUMNS)) for path in arguments[:1]]
        for row in run(arguments[1:]):
            print(
                *(f"{k} {v:.3g}" if isinstance(v, float) else f"{v}" for k, v in row.items()),
                sep=", ",
                flush=True,
            )
            for file in kept:
                file.add(row)


if __name__ == "__main__":
    main(sys.argv[1:])
