"""Smoothed particle hydrodynamics: its kernels' mass, a slow sum of its forces, and its range of sets."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from gbnbench.analysis.measures import measures
from gbnbench.core.errors import InputError
from gbnbench.generators.kernel_based.particle_hydrodynamics import (
    POLY6,
    SPIKY,
    ParticleHydrodynamics,
    pressure_acceleration,
)
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import generate


@pytest.mark.parametrize("d", [1, 2, 3])
def test_kernels_have_unit_mass(d: int) -> None:
    sphere = {1: 2.0, 2: 2 * np.pi, 3: 4 * np.pi}[d]
    for constant, kernel in ((POLY6[d], lambda r: (1 - r**2) ** 3), (SPIKY[d], lambda r: (1 - r) ** 3)):
        mass, _ = quad(lambda r, kernel=kernel: sphere * r ** (d - 1) * kernel(r), 0, 1)
        assert constant * mass == pytest.approx(1)


@pytest.mark.parametrize("d", [1, 2, 3])
def test_forces_are_those_of_a_slow_sum(d: int) -> None:
    n, h, rest = 200, 2.0, 0.8
    x = realization_rng(0, 0).random((n, d))
    apart = x[:, None] - x[None]
    apart = (apart - np.round(apart)) * n ** (1 / d)
    r = np.linalg.norm(apart, axis=2)
    density = np.sum(np.where(r < h, POLY6[d] / h**d * (1 - (r / h) ** 2) ** 3, 0), axis=1)
    ratio = np.maximum(density - rest * density.mean(), 0) / density**2
    slope = np.where((r < h) & (r > 0), 3 * SPIKY[d] / h ** (d + 1) * (1 - r / h) ** 2, 0)
    unit = apart / np.where(r > 0, r, 1)[:, :, None]
    expected = np.sum(((ratio[:, None] + ratio[None]) * slope)[:, :, None] * unit, axis=1)
    found = pressure_acceleration(x, rest, h)
    assert found == pytest.approx(expected, abs=1e-10)
    assert found.sum(axis=0) == pytest.approx(np.zeros(d), abs=1e-10)


@pytest.mark.slow
def test_the_rest_density_goes_from_lloyds_order_to_capacities() -> None:
    """CCVT sets have min .748, mean .872 and psi6 near .45; sets of Lloyd's method mean .93 and psi6 .8."""
    even, ordered = (measures(generate("sph", n=1024, realizations=4, rest=rest)) for rest in (0.9, 0.0))
    assert even["mean_distance"] == pytest.approx(0.872, abs=0.015)
    assert even["noise_floor"] < 8e-4
    assert even["psi6"] < 0.52
    assert ordered["mean_distance"] > 0.9
    assert ordered["psi6"] > 0.65


@pytest.mark.parametrize("wrong", [{"rest": -0.1}, {"rest": 1.1}, {"iterations": -1}, {"support": 1.0}])
def test_wrong_settings_are_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(InputError, match=next(iter(wrong))):
        ParticleHydrodynamics(**wrong)  # type: ignore[arg-type]
