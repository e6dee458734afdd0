"""Rings, waves and directions that could show to the eye in deep sets, beside Gaussian Blue Noise's.

python -m gbnbench.benchmarks.experiments.depth_looks benchmarks/results/deep/depth_looks.csv [FOLDER ...]
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from gbnbench.analysis.radial.anisotropy import anisotropy
from gbnbench.analysis.radial.profile_measures import noise_floor, peak
from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spatial.bond_order import psi6
from gbnbench.analysis.spatial.delaunay import neighbours
from gbnbench.analysis.spatial.distances import mean_distance, min_distance
from gbnbench.analysis.spatial.rdf import rdf
from gbnbench.analysis.spatial.valence import valence6
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.benchmarks.experiments.depth_order_row import beyond
from gbnbench.benchmarks.timing.machine import Rows
from gbnbench.core.torus import FloatArray, as_realizations
from gbnbench.generators.registry import generate
from gbnbench.io.points import load

SOURCES = (
    "gbn[gradients=320]", "gbn[gradients=1000]", "deep[c=78.9568,gradients=100]",
    "deep[c=98.696,gradients=100]", "deep[c=78.9568,edge=0.68,gradients=100]",
    "deep[c=78.9568,edge=0.76,gradients=100]", "deep[c=118.4353,edge=0.7,gradients=100]",
    "deep[c=78.9568,gradients=200]", "deep[c=78.9568,gradients=320]",
    "deep[c=78.9568,edge=0.76,gradients=200]", "deep",
)  # fmt: skip
SETS = 16
EDGE = 0.72  # where the band beyond the edge begins, the same for every source
WAVES = ((2.0, 4.0), (4.0, 6.0))  # densest spacings
COLUMNS = (
    "source", "sets", "noise_floor", "peak", "peak_nu", "valence6", "psi6", "min_distance", "mean_distance",
    "beyond_mean", "beyond_ring", "rdf_peak", "waves_2_4", "waves_4_6",
    "anisotropy_below_db", "anisotropy_edge_db", "anisotropy_expected_db",
)  # fmt: skip


def waves(x: FloatArray) -> tuple[float, list[float]]:
    """Largest g of the sets' mean RDF, and the root mean square of g - 1 over each range of ``WAVES``."""
    found = rdf(x)
    middle = found.r + (found.r[1] - found.r[0]) / 2
    return float(found.g.max()), [
        float(np.sqrt(np.mean((found.g[(middle > low) & (middle < high)] - 1) ** 2))) for low, high in WAVES
    ]


def row(source: str, x: FloatArray) -> dict[str, Any]:
    """Measure all that could show to the eye.

    Parameters
    ----------
    source : str
        The name of the sets.
    x : (realizations, n, 2) float64
        The sets.

    Returns
    -------
    dict
    """
    spectrum = periodogram(x, math.ceil(2 * math.sqrt(x.shape[1])) + 1)
    shells = radial(spectrum)
    mean, ring = beyond(shells, EDGE)
    plane = neighbours(x)
    height, nu = peak(shells)
    rings = anisotropy(spectrum)
    top, (near, far) = waves(x)
    return {
        "source": source,
        "sets": len(x),
        "noise_floor": noise_floor(shells),
        "peak": height,
        "peak_nu": nu,
        "valence6": float(valence6(plane).mean()),
        "psi6": float(psi6(plane).mean()),
        "min_distance": float(min_distance(x).mean()),
        "mean_distance": float(mean_distance(x).mean()),
        "beyond_mean": mean,
        "beyond_ring": ring,
        "rdf_peak": top,
        "waves_2_4": near,
        "waves_4_6": far,
        "anisotropy_below_db": float(rings.anisotropy_db[rings.nu.between(0.1, 0.7)].mean()),
        "anisotropy_edge_db": float(rings.anisotropy_db[rings.nu.between(0.7, 0.9)].mean()),
        "anisotropy_expected_db": -10 * math.log10(len(x)),
    }


def rows(
    sources: Sequence[str], folders: Sequence[Path], n: int = 1024, sets: int = SETS
) -> Iterator[dict[str, Any]]:
    """Yield one row for each generator, then one for each folder of files.

    Parameters
    ----------
    sources : sequence of str
        Generators.
    folders : sequence of Path
        Folders of point sets.
    n, sets : int
        Points in a set, number of sets.

    Returns
    -------
    iterator of dict
    """
    for source in sources:
        yield row(source, generate(source, n=n, d=2, realizations=sets).reshape(sets, n, 2))
    for folder in folders:
        files = sorted(path for path in folder.iterdir() if path.suffix in {".txt", ".dat"})
        yield row(
            folder.name, as_realizations(np.concatenate([as_realizations(load(file)) for file in files]))
        )


def main(arguments: list[str]) -> None:
    """Write the table, and print some of it."""
    with Rows(Path(arguments[0]), COLUMNS) as table:
        for new in rows(SOURCES, [Path(name) for name in arguments[1:]]):
            table.add(new)
            print({k: f"{v:.3g}" if isinstance(v, float) else v for k, v in new.items()}, flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
