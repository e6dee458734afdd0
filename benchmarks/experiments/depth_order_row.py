"""Measures of one set of the map of depth against order: a row of its table."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from gbnbench.analysis.radial.anisotropy import anisotropy_db
from gbnbench.analysis.radial.profile_measures import evacuated_energy, noise_floor, peak, power_at_1
from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spatial.bond_order import psi6
from gbnbench.analysis.spatial.delaunay import neighbours
from gbnbench.analysis.spatial.distances import mean_distance, min_distance
from gbnbench.analysis.spatial.valence import valence6
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.shells import exact_shells
from gbnbench.core.errors import RefusalError
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.energy import energy_evaluation

BEYOND = 0.15  # width in nu of the band beyond the edge that is looked at
KEY = ("generator", "n", "d", "c_pi2", "edge", "gradients", "seed")
COLUMNS = (
    *KEY, "chi", "converged", "steps", "products", "cpu_s", "excess", "noise_floor", "power_at_1",
    "evacuated_energy", "peak", "valence6", "psi6", "min_distance", "mean_distance", "anisotropy_db",
    "beyond_mean", "beyond_ring",
)  # fmt: skip


def chi(d: int, edge: float) -> float:
    """Half of the share of the coordinates that a profile binds: V_d edge**d / (2 d).

    Parameters
    ----------
    d : int
        Dimension.
    edge : float
        Where the profile ends, in nu.

    Returns
    -------
    float
        V_d is the volume of the unit ball.

    Examples
    --------
    >>> round(chi(2, 0.72), 4), round(chi(3, 0.8), 4)
    (0.4072, 0.3574)
    """
    return float(math.pi ** (d / 2) / math.gamma(d / 2 + 1) * edge**d / (2 * d))


def beyond(shells: RadialPower, edge: float) -> tuple[float, float]:
    """Measure the band edge <= nu <= edge + 0.15.

    Parameters
    ----------
    shells : RadialPower
        Of the set.
    edge : float
        Where the band begins, in nu.

    Returns
    -------
    mean : float
        Mean power of the band.
    ring : float
        Largest mean power of its rings round(|f|) = k.
    """
    band = (shells.nu >= edge) & (shells.nu <= edge + BEYOND)
    ring = np.rint(shells.frequency[band]).astype(np.int64)
    count = np.bincount(ring, shells.count[band])
    total = np.bincount(ring, shells.count[band] * shells.power[band])
    return float(total.sum() / count.sum()), float(np.max(total[count > 0] / count[count > 0]))


def row(key: tuple[Any, ...], x: FloatArray, edge: float, **told: object) -> dict[str, Any]:
    """Measure one set; a measure that means nothing for it is nan.

    Parameters
    ----------
    key : tuple
        As ``KEY`` says.
    x : (n, d) float64
        The set.
    edge : float
        Where the band beyond the edge begins, in nu.
    **told
        The other columns.

    Returns
    -------
    dict
        By ``COLUMNS``.
    """
    n, d = x.shape
    spectrum = periodogram(x, math.ceil(2 * n ** (1 / d)) + 1)
    shells = radial(spectrum)
    mean, ring = beyond(shells, edge)
    plane = neighbours(x) if d == 2 else None
    return {
        **dict(zip(KEY, key, strict=True)),
        **told,
        "excess": float(energy_evaluation(n, d, 1.0)(x[None]).excess[0]),
        "noise_floor": noise_floor(shells),
        "power_at_1": power_at_1(shells),
        "evacuated_energy": or_nan(lambda: evacuated_energy(spectrum.power, n, d, spectrum.fmax)),
        "peak": peak(shells)[0],
        "valence6": float(valence6(plane)[0]) if plane else math.nan,
        "psi6": float(psi6(plane)[0]) if plane else math.nan,
        "min_distance": float(min_distance(x)[0]),
        "mean_distance": float(mean_distance(x)[0]),
        "anisotropy_db": or_nan(
            lambda: anisotropy_db(spectrum.power, exact_shells(spectrum.fmax, d), 1, spectrum.spacing)
        ),
        "beyond_mean": mean,
        "beyond_ring": ring,
    }


def or_nan(compute: Callable[[], float]) -> float:
    """Return the measure, or nan where it means nothing for this set."""
    try:
        return compute()
    except RefusalError:
        return math.nan


def key_text(key: tuple[Any, ...]) -> tuple[str, ...]:
    """Return a key as the file has it."""
    return tuple(f"{cell:.6g}" if isinstance(cell, float) else str(cell) for cell in key)
