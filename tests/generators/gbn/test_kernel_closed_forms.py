"""What energies of other kernels are sums of: transforms and pairs in closed form, the Gaussian of GBN."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import j0

from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn import pair_kernels
from gbnbench.generators.gbn.energy_settings import EnergySettings
from gbnbench.generators.gbn.mesh_evaluation import MeshEvaluation
from gbnbench.generators.protocol import realization_rng


def evaluation(n: int, d: int, kernel: str, sigma: float = 1.0, power: float = 0.5) -> MeshEvaluation:
    """The energy of a kernel, the Gaussian's too, over a mesh."""
    return MeshEvaluation(kernel, n, d, sigma, power)


def profile(kernel: str, r: FloatArray, sigma: float) -> FloatArray:
    """The kernel itself."""
    s = math.sqrt(5) * r / sigma
    return {
        "gaussian": np.exp(-(r**2) / (2 * sigma**2)),
        "matern": (1 + s + s**2 / 3) * np.exp(-s),
        "inverse": 1 / np.sqrt(r**2 + sigma**2),
    }[kernel]


@pytest.mark.parametrize("k", [0.3, 1.7, 4.0])
@pytest.mark.parametrize("kernel", ["gaussian", "matern"])
def test_transforms_are_those_of_the_kernels(kernel: str, k: float) -> None:
    def integral(wave: Callable[[float], float]) -> float:
        return float(quad(lambda r: wave(r) * profile(kernel, r, 0.8), 0, 40, limit=400)[0])

    expected = {
        1: 2 * integral(lambda r: math.cos(k * r)),
        2: 2 * math.pi * integral(lambda r: r * j0(k * r)),
        3: 4 * math.pi / k * integral(lambda r: r * math.sin(k * r)),
    }
    for d, value in expected.items():
        found = pair_kernels.transform(kernel, np.array([k]), d, 0.8, 0.5)
        assert found[0] == pytest.approx(value, abs=1e-9)


def test_transforms_of_multiquadrics_have_closed_forms_in_the_plane_and_in_space() -> None:
    k = np.array([0.3, 1.7, 4.0])
    inverse = pair_kernels.transform("inverse", k, 2, 0.8, 0.5)
    assert inverse == pytest.approx(2 * math.pi * np.exp(-0.8 * k) / k)  # Sommerfeld's integral
    root = pair_kernels.transform("multiquadric", k, 2, 0.8, 0.5)
    assert root == pytest.approx(2 * math.pi * np.exp(-0.8 * k) * (1 + 0.8 * k) / k**3)


@pytest.mark.parametrize("kernel", ["gaussian", "matern"])
def test_energies_are_sums_over_pairs_and_their_images(kernel: str) -> None:
    n = 20
    one, other = realization_rng(8, 0).random((2, n, 2))
    side = math.sqrt(n)
    images = np.stack(np.meshgrid(np.arange(-6, 7), np.arange(-6, 7)), axis=-1).reshape(-1, 1, 1, 2)

    def pairs(x: FloatArray) -> float:
        apart = x[:, None] - x + images
        return float(np.sum(profile(kernel, side * np.sqrt(np.sum(apart**2, axis=-1)), 0.9)) / (2 * n))

    found = np.diff(evaluation(n, 2, kernel, 0.9)(np.stack([one, other])).excess)[0]
    assert found == pytest.approx(pairs(other) - pairs(one), rel=1e-4 if kernel == "matern" else 1e-7)


def test_von_mises_densities_are_products_of_exponentials() -> None:
    n = 20
    one, other = realization_rng(9, 0).random((2, n, 2))
    kappa = n / (2 * math.pi * 0.9) ** 2

    def pairs(x: FloatArray) -> float:
        apart = np.cos(2 * math.pi * (x[:, None] - x)) - 1
        return float(np.sum(np.exp(kappa * np.sum(apart, axis=-1))) / (2 * n))

    found = np.diff(evaluation(n, 2, "vonmises", 0.9)(np.stack([one, other])).excess)[0]
    assert found == pytest.approx(pairs(other) - pairs(one), rel=1e-7)


@pytest.mark.parametrize("d", [1, 2, 3])
def test_the_gaussian_energy_is_gbns(d: int) -> None:
    n = 100
    x = realization_rng(3, 0).random((n, d))
    mesh = evaluation(n, d, "gaussian", 0.9)(x[None])
    gbn = EnergySettings(0.9, 0.0, 0.0, "double", "torus", "none", 0.0).open(n, d)(x[None])
    assert mesh.excess == pytest.approx(gbn.excess, rel=1e-7)
    assert mesh.gradient == pytest.approx(gbn.gradient, abs=1e-6 * np.abs(gbn.gradient).max())
