"""The picture of docs/generators.md: point sets with spectra of one's own, beside step, peak and stair.

python -m gbnbench.benchmarks.experiments.target_picture docs/images/targets.png [PROFILE.csv ...]
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np

from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.torus import FloatArray
from gbnbench.generators.registry import generate
from gbnbench.generators.spectral_control.target_profiles import Table
from gbnbench.generators.spectral_control.targeted import Targeted

N, FMAX, SEED, SETS = 1024, 48, 3, 4
NAMED = ("step", "peak", "staircase")


def ring_means(x: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Average the power of sets over rings of |f| one unit wide.

    Parameters
    ----------
    x : (realizations, n, 2) float64
        Points.

    Returns
    -------
    nu, power : (rings,) float64
        Of each ring.
    """
    shells = radial(periodogram(x, FMAX))
    ring = np.rint(shells.nu * N**0.5).astype(np.int64)
    count = np.maximum(np.bincount(ring, shells.count), 1)
    power = np.bincount(ring, shells.power * shells.count) / count
    nu = np.arange(len(power)) / N**0.5
    return nu[1 : FMAX + 1], power[1 : FMAX + 1]


def main(path: Path, profiles: list[str]) -> None:
    """Draw the picture into a file: points, their spectrum, ring means with the target; one column each.

    Parameters
    ----------
    path : Path
        The file.
    profiles : list of str
        Files of targets besides the named ones.
    """
    from matplotlib.figure import Figure

    targets = [*NAMED, *profiles]
    figure = Figure(figsize=(2.3 * len(targets), 6.6), layout="constrained")
    axes = figure.subplots(3, len(targets), squeeze=False)
    for (points, spectrum, profile), target in zip(axes.T, targets, strict=True):
        x = generate("targeted", n=N, seed=SEED, realizations=SETS, target=target)
        points.scatter(*x[0].T, s=1.5, c="black", linewidths=0)
        points.set(xlim=(0, 1), ylim=(0, 1), aspect="equal", xticks=[], yticks=[], title=Path(target).stem)
        power = periodogram(x[0], FMAX).power.copy()
        power[FMAX, FMAX] = 0
        spectrum.imshow(power, vmin=0, vmax=3, cmap="gray", origin="lower")
        spectrum.set(xticks=[], yticks=[])
        table = Table.read(target) if target in profiles else None
        nu = np.linspace(0.01, FMAX / N**0.5 if table is None else table.edge, 600)
        profile.plot(nu, Targeted(target=target).profile(2)(nu), color="0.6", linewidth=3, label="target")
        profile.plot(*ring_means(x), color="black", linewidth=0.8, label=f"{SETS} sets")
        profile.set(xlabel=r"$\nu$", ylim=(0, 2.6))
    axes[2, 0].set_ylabel("power")
    axes[2, 0].legend(frameon=False, fontsize="small")
    figure.savefig(path, dpi=110)


if __name__ == "__main__":
    main(Path(sys.argv[1]), sys.argv[2:])
