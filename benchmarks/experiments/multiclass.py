"""Inks drawn together and each by itself, for docs/adaptive.md: flat greys of two, and a picture of four.

python -m gbnbench.benchmarks.experiments.multiclass benchmarks/results/adaptive/multiclass.csv

It goes on where it was stopped.
"""

from __future__ import annotations

import argparse
import itertools
import math
from pathlib import Path

import numpy as np
import pandas as pd

from gbnbench import measures, periodogram
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.gbn.joint_energy import union_density
from gbnbench.generators.adaptive.registry import adaptive_classes
from gbnbench.io.images import read_image
from gbnbench.studies.stippling.inks import ink_darkness, shared_out
from gbnbench.studies.stippling_comparison.relative_variance import relative_variance

COUNTS = ((512, 512), (256, 768))
UNIONS = (0, 0.1, 0.3, 1, 10)
PICTURE_UNIONS = (0, 0.1, 1)
SIDE, SETS = 128, 3
BAND = (0.25, 0.6)  # of nu, in which independent sets have power and blue noise has none
PICTURE, DOTS = "astronaut", 10_000


def band_power(x: FloatArray) -> float:
    """Give the mean power over frequencies with nu in ``BAND``.

    Parameters
    ----------
    x : (n, 2) float64
        Points on the unit torus.

    Returns
    -------
    float
        1 in expectation for white noise.
    """
    fmax = math.ceil(BAND[1] * math.sqrt(len(x)))
    f = np.arange(-fmax, fmax + 1)
    nu = np.hypot(f[:, None], f) / math.sqrt(len(x))
    return float(periodogram(x, fmax).power[(nu > BAND[0]) & (nu <= BAND[1])].mean())


def flat_greys(counts: tuple[int, ...], union: float) -> dict[str, float]:
    """Measure two inks of a constant density on the torus.

    Parameters
    ----------
    counts : tuple of int
        Dots of each.
    union : float
        Weight of the energy of all dots.

    Returns
    -------
    dict of str to float
        Means over sets.
    """
    flat = as_density(np.ones((SIDE, SIDE)), toroidal=True)
    found = []
    for seed in range(SETS):
        sets = [x / SIDE for x in adaptive_classes(f"gbn[union={union}]", [flat, flat], counts, seed=seed)]
        row: dict[str, float] = {}
        for name, x in (("first", sets[0]), ("second", sets[1]), ("all", np.concatenate(sets))):
            has = measures(x)
            row[f"floor {name}"] = has["noise_floor"]
            row[f"band {name}"] = band_power(x)
            row[f"min {name}"] = has["min_distance"]
        found.append(row)
    return {str(name): float(mean) for name, mean in pd.DataFrame(found).mean().items()}


def picture(union: float) -> dict[str, float]:
    """Measure the four inks of a picture.

    Parameters
    ----------
    union : float
        Weight of the energy of all dots.

    Returns
    -------
    dict of str to float
        Relative variance of each ink and of all.
    """
    darkness = ink_darkness(read_image(PICTURE))
    densities = [one.density() for one in darkness.values()]
    counts = list(shared_out(darkness, DOTS).values())
    sets = adaptive_classes(f"gbn[union={union}]", densities, counts)
    named = zip(darkness, sets, densities, strict=True)
    row = {ink: relative_variance(x, density) for ink, x, density in named}
    return {**row, "all": relative_variance(np.concatenate(sets), union_density(densities, counts))}


def main() -> None:
    """Run the command."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path)
    given = parser.parse_args()
    given.out.parent.mkdir(parents=True, exist_ok=True)
    table = pd.read_csv(given.out) if given.out.exists() else pd.DataFrame(columns=["dots", "union"])
    greys: list[tuple[tuple[int, ...], float]] = list(itertools.product(COUNTS, UNIONS))
    for dots, union in (*greys, *(((), union) for union in PICTURE_UNIONS)):
        name = " + ".join(map(str, dots)) or PICTURE
        if ((table["dots"] == name) & (table["union"] == union)).any():
            continue
        found = flat_greys(dots, union) if dots else picture(union)
        row = pd.DataFrame([{"dots": name, "union": union, **found}])
        table = row if table.empty else pd.concat([table, row])
        table.to_csv(given.out, index=False, float_format="%.3g")
        print(row.to_string(index=False), flush=True)


if __name__ == "__main__":
    main()
