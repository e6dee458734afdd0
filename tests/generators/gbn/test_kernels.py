"""Other kernels of the energy: finite differences, Fourier and direct sums, closed forms."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn import ewald, pair_kernels
from gbnbench.generators.gbn.ewald import EwaldEnergy
from gbnbench.generators.gbn.generator import GaussianBlueNoise
from gbnbench.generators.gbn.mesh_evaluation import MeshEvaluation
from gbnbench.generators.gbn.mesh_sums import MeshEnergy
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import generate

KERNELS: list[dict[str, Any]] = [
    {"kernel": "distance"},
    {"kernel": "log"},
    {"kernel": "riesz", "power": 0.5},
    {"kernel": "multiquadric"},
    {"kernel": "inverse", "sigma": 0.7},
    {"kernel": "matern"},
    {"kernel": "vonmises"},
]


def evaluation(n: int, d: int, kernel: str, sigma: float = 1.0, power: float = 0.5) -> MeshEvaluation:
    """The energy of a kernel, the Gaussian's too, over a mesh."""
    return MeshEvaluation(kernel, n, d, sigma, power)


def frequencies(fmax: int, d: int) -> FloatArray:
    """All f != 0 with |f_a| <= fmax."""
    f = np.stack(np.meshgrid(*[np.arange(-fmax, fmax + 1.0)] * d, indexing="ij"), axis=-1).reshape(-1, d)
    return f[np.any(f != 0, axis=1)]


def fourier_energy(x: FloatArray, kernel: str, fmax: int, sigma: float = 1.0, power: float = 0.5) -> float:
    """(1/2n) sum of w |F|^2 over a cube of frequencies, a point."""
    n, d = x.shape
    f = frequencies(fmax, d)
    k = 2 * math.pi * n ** (-1 / d) * np.sqrt(np.sum(f**2, axis=1))
    w = pair_kernels.transform(kernel, k, d, sigma, power)
    return float(np.sum(w * np.abs(np.exp(-2j * math.pi * f @ x.T).sum(axis=1)) ** 2) / (2 * n) / n)


@pytest.mark.parametrize("d", [1, 2, 3])
def test_the_mesh_sums_what_frequencies_sum(d: int) -> None:
    n, fmax = 30, 6
    weights = realization_rng(0, 0).random((fmax + 1,) * d)
    x = realization_rng(1, 0).random((n, d))
    f = frequencies(fmax, d)
    waves = np.exp(-2j * math.pi * f @ x.T)
    amplitude, w = waves.sum(axis=1), weights[tuple(np.abs(f.T).astype(int))]
    energy, gradient = MeshEnergy(weights, n)(x)
    assert energy == pytest.approx(np.sum(w * np.abs(amplitude) ** 2) / (2 * n), rel=1e-6)
    slopes = np.real(waves.T * (w * amplitude.conj()) @ (-2j * math.pi * f)) / n / n ** (1 / d)
    assert gradient == pytest.approx(slopes, abs=1e-6 * np.abs(slopes).max())


@pytest.mark.parametrize("d", [1, 2, 3])
@pytest.mark.parametrize("settings", KERNELS, ids=lambda s: s["kernel"])
def test_the_gradient_is_the_energys(settings: dict[str, Any], d: int) -> None:
    n, h = 12, 1e-4
    side = n ** (1 / d)
    energy = GaussianBlueNoise(**settings).energy.open(n, d)
    x = realization_rng(2, 0).random((1, n, d))
    gradient = energy(x).gradient[0]
    for point in range(3):
        step = np.zeros_like(x)
        step[0, point, -1] = h / side
        ahead, behind = (n * energy(x + sign * step).excess[0] for sign in (1, -1))
        error = (ahead - behind) / (2 * h) - gradient[point, -1]
        assert abs(error) < 1e-5 * np.abs(gradient).max()


@pytest.mark.parametrize(
    ("kernel", "d", "fmax"),
    [("gaussian", 2, 12), ("inverse", 1, 60), ("inverse", 2, 40), ("multiquadric", 2, 40), ("matern", 2, 40)],
)
def test_smooth_energies_are_sums_over_frequencies(kernel: str, d: int, fmax: int) -> None:
    x = realization_rng(6, 0).random((20, d))
    # The Matérn kernel leaves out the frequencies whose curvature is below 1e-5 of the largest.
    tolerance = 1e-4 if kernel == "matern" else 1e-7
    expected = fourier_energy(x, kernel, fmax, 0.9)
    assert evaluation(20, d, kernel, 0.9)(x[None]).excess[0] == pytest.approx(expected, rel=tolerance)


def test_the_distance_in_the_plane_is_a_sum_over_frequencies() -> None:
    """Of two sets: what each point has with itself is in the one and not in the other, and falls out."""
    one, other = realization_rng(7, 0).random((2, 16, 2))
    found = np.diff(evaluation(16, 2, "distance")(np.stack([one, other])).excess)[0]
    expected = fourier_energy(other, "distance", 40) - fourier_energy(one, "distance", 40)
    assert found == pytest.approx(expected, rel=5e-3)  # of a cube of frequencies that ends somewhere


@pytest.mark.parametrize("kernel", ["log", "distance"])
def test_series_on_the_circle_have_closed_forms(kernel: str) -> None:
    """Sums of cos(2 pi f x) over f are -log(2 sin pi x), over f**2 pi**2 (x**2 - x + 1/6)."""
    n = 16
    sets = realization_rng(7, 0).random((2, n, 1))

    def closed(x: FloatArray) -> float:
        apart = np.abs(x - x.T)[np.triu_indices(n, 1)]
        if kernel == "log":
            return float(np.sum(-np.log(2 * np.sin(math.pi * apart))) / math.pi / n)
        return float(np.sum(apart**2 - apart + 1 / 6) / 2)

    found = np.diff(evaluation(n, 1, kernel)(sets).excess)[0]
    assert found == pytest.approx(closed(sets[1]) - closed(sets[0]), rel=1e-6)


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
        gradient = GaussianBlueNoise(**settings).energy.open(16, 2)(grid[None] + 0.013).gradient
        assert np.abs(gradient).max() < 1e-6


@pytest.mark.parametrize("settings", KERNELS, ids=lambda s: s["kernel"])
def test_the_energy_falls(settings: dict[str, Any]) -> None:
    generator = GaussianBlueNoise(**settings, gradients=40)
    start = realization_rng(0, 0).random((1, 60, 2))
    energy = generator.energy.open(60, 2)
    end = generate(generator, n=60, seed=0)
    assert energy(end[None]).excess[0] < 0.1 * energy(start).excess[0]


def test_charges_on_a_circle_come_to_rest_evenly() -> None:
    """In one dimension a convex kernel has its least energy at equal distances, and descent finds it."""
    for kernel in ("distance", "log", "inverse"):
        x = np.sort(generate(f"gbn[kernel={kernel},gradients=150]", n=12, d=1, seed=1)[:, 0])
        assert np.diff(x) == pytest.approx(1 / 12, abs=1e-5)


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        ({"sigma": 0.1}, "sigma must lie in"),
        ({"power": 0.0}, "power must be"),
        ({"power": 3.0}, "power must be"),
        ({"kernel": "log", "cutoff": 2.0}, "kernel=log is summed whole"),
        ({"kernel": "log", "domain": "box"}, "kernel=log is summed whole"),
        ({"kernel": "matern", "precision": "float"}, "precision=float"),
    ],
)
def test_wrong_settings_are_refused(wrong: dict[str, Any], says: str) -> None:
    with pytest.raises(InputError, match=says):
        GaussianBlueNoise(**wrong)


@pytest.mark.parametrize(
    ("settings", "n", "d", "says"),
    [
        ({"kernel": "riesz", "power": 2.0}, 10, 2, "power=2 in d=2"),
        ({"kernel": "inverse"}, 10, 4, "nearest is 3"),
        ({"kernel": "inverse"}, 30_000, 2, "nearest is 20000"),
    ],
)
def test_what_cannot_be_summed_is_refused(settings: dict[str, Any], n: int, d: int, says: str) -> None:
    assert says in str(GaussianBlueNoise(**settings).refusal(n, d))


def test_its_evaluation_is_explained() -> None:
    assert "Ewald's sum of log, error 1.0e-07" in GaussianBlueNoise(kernel="log").explain(100, 2)
