"""Energies of kernels: against direct sums, finite differences, GBN's own energy, and charges on a circle."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from gbnbench.core.errors import InputError
from gbnbench.core.torus import wrap
from gbnbench.generators.gbn.energy_settings import EnergySettings
from gbnbench.generators.kernel_based import ewald
from gbnbench.generators.kernel_based.ewald import EwaldEnergy
from gbnbench.generators.kernel_based.kernel_energy import KernelEnergy
from gbnbench.generators.kernel_based.mesh_sums import MeshEnergy
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import generate

KERNELS: list[dict[str, Any]] = [
    {"kernel": "distance"},
    {"kernel": "log"},
    {"kernel": "riesz", "power": 0.5},
    {"kernel": "gaussian"},
    {"kernel": "multiquadric"},
    {"kernel": "inverse", "width": 0.7},
    {"kernel": "vonmises"},
]


@pytest.mark.parametrize("d", [1, 2, 3])
def test_the_mesh_sums_what_frequencies_sum(d: int) -> None:
    n, fmax = 30, 6
    weights = realization_rng(0, 0).random((fmax + 1,) * d)
    x = realization_rng(1, 0).random((n, d))
    f = np.stack(np.meshgrid(*[np.arange(-fmax, fmax + 1)] * d, indexing="ij"), axis=-1).reshape(-1, d)
    f = f[np.any(f != 0, axis=1)]
    waves = np.exp(-2j * math.pi * f @ x.T)
    amplitude, w = waves.sum(axis=1), weights[tuple(np.abs(f.T))]
    energy, gradient = MeshEnergy(weights, n)(x)
    assert energy == pytest.approx(np.sum(w * np.abs(amplitude) ** 2) / (2 * n), rel=1e-6)
    slopes = np.real(waves.T * (w * amplitude.conj()) @ (-2j * math.pi * f)) / n / n ** (1 / d)
    assert gradient == pytest.approx(slopes, abs=1e-6 * np.abs(slopes).max())


@pytest.mark.parametrize("d", [1, 2, 3])
@pytest.mark.parametrize("settings", KERNELS, ids=lambda s: s["kernel"])
def test_the_gradient_is_the_energys(settings: dict[str, Any], d: int) -> None:
    n, h = 40, 1e-4
    side = n ** (1 / d)
    energy = KernelEnergy(**settings).energy(n, d)
    x = realization_rng(2, 0).random((n, d))
    _, gradient = energy(x)
    for point in range(3):
        step = np.zeros_like(x)
        step[point, -1] = h / side
        ahead, behind = (energy(wrap(x + sign * step))[0] for sign in (1, -1))
        error = (ahead - behind) / (2 * h) - gradient[point, -1]
        assert abs(error) < 1e-5 * np.abs(gradient).max()


@pytest.mark.parametrize("d", [1, 2, 3])
def test_the_gaussian_energy_is_gbns(d: int) -> None:
    n = 100
    x = realization_rng(3, 0).random((n, d))
    energy, gradient = KernelEnergy(kernel="gaussian", width=0.9).energy(n, d)(x)
    gbn = EnergySettings(0.9, 0.0, 0.0, "double", "torus", "none", 0.0).open(n, d)(x[None])
    assert energy / n == pytest.approx(gbn.excess[0], rel=1e-7)
    assert gradient == pytest.approx(gbn.gradient[0], abs=1e-6 * np.abs(gradient).max())


@pytest.mark.parametrize(("d", "t"), [(1, 1.0), (2, 0.0), (2, 1.0), (3, -1.0), (3, 1.0), (2, -1.5)])
def test_the_split_between_pairs_and_frequencies_does_not_matter(
    d: int, t: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    x = realization_rng(4, 0).random((80, d))
    _, wide = EwaldEnergy(80, d, t)(x)
    monkeypatch.setattr(ewald, "CUT", 0.3 * 80 ** (1 / d))
    _, narrow = EwaldEnergy(80, d, t)(x)
    assert narrow == pytest.approx(wide, abs=2e-6 * np.abs(wide).max())


def test_one_dimensional_charges_feel_how_many_stand_on_either_side() -> None:
    """With -r in 1D the force of a pair is 1/2 sign(u) - u / side, u its distance on the circle: exact."""
    n = 12
    x = realization_rng(5, 0).random((n, 1))
    _, gradient = EwaldEnergy(n, 1, 1.0)(x)
    apart = x - x.T
    apart -= np.round(apart)
    expected = -np.sum(np.sign(apart) / 2 - apart, axis=1)
    assert gradient[:, 0] == pytest.approx(expected, abs=1e-6)


def test_lattices_are_at_rest() -> None:
    grid = np.stack(np.meshgrid(np.arange(4), np.arange(4)), axis=-1).reshape(-1, 2) / 4
    for settings in KERNELS:
        _, gradient = KernelEnergy(**settings).energy(16, 2)(grid + 0.013)
        assert np.abs(gradient).max() < 1e-6


@pytest.mark.parametrize("settings", KERNELS, ids=lambda s: s["kernel"])
def test_the_energy_falls_and_points_spread(settings: dict[str, Any]) -> None:
    generator = KernelEnergy(**settings, gradients=30)
    start = realization_rng(0, 0).random((60, 2))
    energy = generator.energy(60, 2)
    end = generate(generator, n=60, seed=0)
    assert energy(end)[0] < energy(start)[0]


@pytest.mark.parametrize(
    "wrong", [{"width": 0.1}, {"width": 4.0}, {"power": 0.0}, {"power": 3.0}, {"gradients": 0}]
)
def test_wrong_settings_are_refused(wrong: dict[str, Any]) -> None:
    with pytest.raises(InputError, match=next(iter(wrong))):
        KernelEnergy(**wrong)


def test_a_power_of_the_dimension_is_refused() -> None:
    assert "power=2 in d=2" in str(KernelEnergy(kernel="riesz", power=2.0).refusal(10, 2))
