"""Runs made up for the tests of the reports, with plain numpy and nothing of the analysis."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pandas as pd

from gbnbench.analysis.measure_definitions import DEFINITIONS
from gbnbench.core.results.measures import Measures
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.runs.comparison_result import Run, SourceResult
from tests.oracles.power import lattice_of, mean_power


def cube_power(sets: np.ndarray, fmax: int) -> np.ndarray:
    """Mean power over the cube, exactly 0 where sums of rounded points leave next to nothing."""
    d = sets.shape[2]
    power = mean_power(sets, lattice_of(fmax, d)).astype(float)
    return np.where(power < 1e-24, 0.0, power).reshape((2 * fmax + 1,) * d)


def shells(power: np.ndarray, n: int, fmax: int, sets: int) -> tuple[RadialPower, pd.DataFrame]:
    """Exact shells and the anisotropy of unit rings."""
    d = power.ndim
    axes = np.meshgrid(*[np.arange(-fmax, fmax + 1)] * d, indexing="ij")
    square = sum(a.astype(int) ** 2 for a in axes).ravel()
    keep = (square > 0) & (square <= fmax**2)
    values, inverse, count = np.unique(square[keep], return_inverse=True, return_counts=True)
    flat = power.ravel()[keep]
    mean = np.bincount(inverse, flat) / count
    frequency = np.sqrt(values)
    nu = frequency * n ** (-1 / d)
    relative = np.bincount(inverse, (flat / np.maximum(mean[inverse], 1e-300) - 1) ** 2) * (
        sets * count / 2 + 1
    )
    ring = np.round(frequency).astype(int)
    top = np.bincount(ring, relative / (sets * count / 2))
    bottom = np.bincount(ring, count - 2.0)
    rows = [
        (
            k,
            k * n ** (-1 / d),
            10 * math.log10(top[k] / bottom[k]) if bottom[k] > 0 and top[k] > 0 else math.nan,
        )
        for k in np.unique(ring)
    ]
    return RadialPower(frequency, nu, mean, count), pd.DataFrame(
        rows, columns=["frequency", "nu", "anisotropy_db"]
    )


def plate(x: np.ndarray, pixels: int = 128) -> np.ndarray:
    """A zone plate by nearest point, coarse but recognisable."""
    grid = (np.stack(np.meshgrid(np.arange(pixels), np.arange(pixels)), -1) + 0.5) / pixels
    from scipy.spatial import cKDTree

    distance, near = cKDTree(x, boxsize=1.0).query(grid, k=min(4, len(x)))
    distance, near = distance.reshape(pixels, pixels, -1), near.reshape(pixels, pixels, -1)
    weight = np.exp(-0.5 * (distance * math.sqrt(len(x)) / 0.5) ** 2) + 1e-12
    value = 0.5 + 0.5 * np.cos(0.9 * len(x) * np.sum(x**2, 1))
    return np.sum(weight * value[near], -1) / weight.sum(-1)


def source(
    label: str,
    sets: np.ndarray,
    fmax: int = 8,
    *,
    measured: Mapping[str, float] | None = None,
    cpu: float = 0.25,
    warnings: Sequence[str] = (),
    key: str | None = None,
) -> SourceResult:
    """A source with honest spectrum and pictures and a few honest measures; the rest given or made up."""
    count, n, d = sets.shape
    power = cube_power(sets, fmax)
    radial, anisotropy = shells(power, n, fmax, count)
    values = {definition.name: math.nan for definition in DEFINITIONS}
    low = (radial.nu <= 0.25) | (radial.frequency == radial.frequency[0])
    values["noise_floor"] = float(np.sum((radial.power * radial.count)[low]) / radial.count[low].sum())
    values["power_at_1"] = float(radial.power[0])
    values["peak"] = float(radial.power.max())
    values["peak_nu"] = float(radial.nu[radial.power.argmax()])
    values["psi6"] = 0.4 + 0.01 * len(label)
    values["profile_epsilon"] = values["noise_floor"]
    values["profile_c"] = 39.2
    values["anisotropy_db"] = -12.345
    reasons = {name: "not in the made-up run" for name, v in values.items() if math.isnan(v)}
    if measured is not None:
        values |= measured
        reasons = {name: "not in the made-up run" for name, v in values.items() if math.isnan(v)}
    errors = {name: abs(v) * 0.021 if count > 1 else math.nan for name, v in values.items()}
    r = np.linspace(0.02, 8, max(int(0.125 * n), 2))
    rdf = None if n < 16 else pd.DataFrame({"r": r, "g": 1 - np.exp(-((r / 0.8) ** 4)) * np.cos(5 * r)})
    valence = None
    if d == 2:
        share = {4: 0.02, 5: 0.25, 6: 0.47, 7: 0.24, 8: 0.02}
        valence = pd.DataFrame({"degree": list(share), "share": list(share.values())})
    return SourceResult(
        key=key or f"{''.join(c for c in label if c.isalnum())[:20]}-{len(label)}_n{n}_d{d}",
        label=label,
        n=n,
        d=d,
        realizations=count,
        points=sets,
        spectrum=Spectrum(power, n, d, count, fmax),
        radial=radial,
        anisotropy=anisotropy,
        rdf=rdf,
        valence=valence,
        zone_plate=plate(sets[0]) if d == 2 else None,
        measures=Measures(values, errors, reasons),
        cpu_seconds=cpu,
        warnings=tuple(warnings),
    )


def random(n: int, d: int, count: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).random((count, n, d))


def jittered(n: int, d: int, count: int, seed: int = 0) -> np.ndarray:
    m = round(n ** (1 / d))
    corner = np.array(list(itertools.product(range(m), repeat=d)), dtype=float)
    return (corner + np.random.default_rng(seed).random((count, m**d, d))) / m


def grid(n: int, d: int) -> np.ndarray:
    m = round(n ** (1 / d))
    return (np.array(list(itertools.product(range(m), repeat=d)), dtype=float)[None] + 0.5) / m


def manifest(**more: Any) -> dict[str, Any]:
    return {
        "command": "gbnbench compare random jittered -n 64",
        "version": "0.1.0",
        "seed": 0,
        "realizations": 4,
        "device": {"name": "cpu-haswell", "platform": "Portable Computing Language", "version": "PoCL 6.0"},
        "versions": {"numpy": "2.4.6", "python": "3.11.2"},
        "started": "2026-11-22T01:00:00+00:00",
        "wall_seconds": 12.3,
        "settings": {"precision": "double"},
    } | more


def small_run(**more: Any) -> Run:
    """Two sources of 64 points in the plane, four realizations."""
    return Run(
        manifest(**more),
        (source("random", random(64, 2, 4)), source("jittered", jittered(64, 2, 4), cpu=0.5)),
    )
