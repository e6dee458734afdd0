"""Void-and-cluster: the pattern's defining optimality, its ranks, and its raster against sums of images."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from gbnbench.analysis.measures import measures
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.kernel_based.raster_energy import RasterEnergy, pixel_centres
from gbnbench.generators.kernel_based.raster_kernel import gaussian
from gbnbench.generators.kernel_based.void_and_cluster import VoidAndCluster, initial_binary_pattern
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import generate


def gaussian_sums(ones: FloatArray, side: int, d: int, sigma: float) -> FloatArray:
    """Slow twin: the Gaussians of all ones and their images, at every pixel of the raster."""
    grid = np.stack(np.unravel_index(np.arange(side**d), (side,) * d), axis=1)
    at = np.stack(np.unravel_index(np.flatnonzero(ones), (side,) * d), axis=1)
    difference = grid[:, None] - at[None]
    images = np.sum([np.exp(-((difference + t * side) ** 2) / (2 * sigma**2)) for t in range(-8, 9)], axis=0)
    return np.asarray(images.prod(axis=2).sum(axis=1))


@pytest.mark.parametrize(("side", "d", "sigma"), [(40, 1, 1.5), (9, 2, 1.5), (30, 2, 1.2), (7, 3, 1.0)])
def test_sums_are_those_of_all_images(side: int, d: int, sigma: float) -> None:
    rng = np.random.default_rng(1)
    energy = RasterEnergy((side,) * d, gaussian((side,) * d, sigma), rng)
    pixels = rng.choice(side**d, 12, replace=False)
    for pixel in pixels:
        energy.add(int(pixel))
    for pixel in pixels[:4]:
        energy.remove(int(pixel))
    expected = gaussian_sums(energy.ones, side, d, sigma)
    assert energy.count == 8
    assert [energy.at(p) for p in range(side**d)] == pytest.approx(expected, abs=1e-12)
    assert expected[energy.largest_void()] == pytest.approx(expected[~energy.ones].min(), abs=1e-12)
    assert expected[energy.tightest_cluster()] == pytest.approx(expected[energy.ones].max(), abs=1e-12)


def test_no_swap_betters_the_initial_pattern() -> None:
    side, sigma = 24, 1.5
    pattern = initial_binary_pattern((side, side), gaussian((side, side), sigma), 0.1, realization_rng(0, 0))
    ones = pattern.ones.copy()
    cluster = np.flatnonzero(ones)[gaussian_sums(ones, side, 2, sigma)[ones].argmax()]
    ones[cluster] = False
    assert gaussian_sums(ones, side, 2, sigma)[~ones].argmin() == np.flatnonzero(~ones).searchsorted(cluster)


def test_fewer_points_are_a_part_of_more() -> None:
    sets = [
        VoidAndCluster(pixels=32, shift=False)(n, 2, realization_rng(4, 0)) for n in (40, 102, 200, 700, 1024)
    ]
    pixels = [set(map(tuple, x.tolist())) for x in sets]
    assert all(few < more for few, more in itertools.pairwise(pixels))


def test_phase_three_is_phase_two() -> None:
    """The tightest cluster of zeros is the largest void, since all ones together give a constant."""
    rng = np.random.default_rng(3)
    energy = RasterEnergy((16, 16), gaussian((16, 16), 1.5), rng)
    for pixel in rng.choice(256, 180, replace=False):
        energy.add(int(pixel))
    zeros = gaussian_sums(~energy.ones, 16, 2, 1.5)
    assert np.flatnonzero(~energy.ones)[zeros[~energy.ones].argmax()] == energy.largest_void()


def test_points_are_pixel_centres_unless_jittered() -> None:
    n, side = 64, VoidAndCluster().side(64, 2)
    assert side == 32
    still = VoidAndCluster(shift=False)(n, 2, realization_rng(0, 0))
    assert np.all(still * side % 1 == 0.5)
    assert pixel_centres(np.array([0, 33]), side, 2).tolist() == [[0.5 / 32, 0.5 / 32], [1.5 / 32, 1.5 / 32]]
    jittered = VoidAndCluster(shift=False, jitter=True)(n, 2, realization_rng(0, 0))
    assert 0 < np.abs(jittered - still).max() <= 0.5 / side


@pytest.mark.parametrize(
    "wrong",
    [{"share": 0.0}, {"share": 1.0}, {"pixels": -1}, {"sigma": 0.0}, {"sigma": 21.0}, {"initial": 0.6}],
)
def test_wrong_settings_are_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(InputError, match=next(iter(wrong))):
        VoidAndCluster(**wrong)  # type: ignore[arg-type]


def test_refusals_name_the_raster() -> None:
    assert "nearest is 64" in str(VoidAndCluster(pixels=8).refusal(65, 2))
    assert "nearest is 65536" in str(VoidAndCluster().refusal(70_000, 2))
    assert "at most 101 a side" in str(VoidAndCluster(pixels=200).refusal(50, 3))


@pytest.mark.slow
def test_the_spectrum_is_exponential_with_the_exponent_of_farthest_points() -> None:
    """Section 3.2 and Fig. 1(g) of Gaussian Blue Noise: c of ln P = ln eps + c nu**2, to 20%."""
    ours = measures(generate("voidcluster", n=1024, realizations=16))
    farthest = measures(generate("fpo", n=1024, realizations=2))
    assert ours["profile_residual_db"] < 0.7 * ours["powerlaw_residual_db"]
    assert ours["profile_c"] == pytest.approx(farthest["profile_c"], rel=0.2)
