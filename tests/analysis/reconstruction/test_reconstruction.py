"""Densities found back from points, against plain sums, closed forms and what must be kept."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.special import erf

from gbnbench.analysis.reconstruction.blurred_difference import blurred_difference, blurred_difference_map
from gbnbench.analysis.reconstruction.density_estimates import ESTIMATES, reconstructed_density
from gbnbench.analysis.reconstruction.image_quality import image_quality
from gbnbench.analysis.reconstruction.kernel_sums import kernel_sums
from gbnbench.analysis.reconstruction.shaping import amplitudes, kernel_width, with_reflections
from gbnbench.core.errors import InputError


@pytest.mark.parametrize("d", [2, 3])
def test_kernel_sums_are_the_double_sum(d):
    rng = np.random.default_rng(d)
    points, places = rng.random((300, d)) * 40, rng.random((500, d)) * 60 - 10
    weights, variances = rng.random(300) + 0.5, np.exp(rng.normal(size=300) * 1.5)
    square = ((places[:, None] - points) ** 2).sum(axis=2)
    expected = (weights * np.exp(-square / (2 * variances))).sum(axis=1)
    assert kernel_sums(places, points, weights, variances) == pytest.approx(expected, abs=2e-5)


@pytest.mark.parametrize("average", ["squares", "mean"])
def test_amplitudes_are_algorithm_2(average):
    rng = np.random.default_rng(0)
    n, shape = 60, (30, 40)
    points = rng.random((n, 2)) * shape
    sigma = 0.5 * math.sqrt(30 * 40 / n)
    square = ((points[:, None] - points) ** 2).sum(axis=2)
    a = np.ones(n)
    for _ in range(4):
        kernels = a * np.exp(-a * square / (2 * sigma**2))  # column l: that of point l
        np.fill_diagonal(kernels, 0)
        density = kernels.sum(axis=1)
        a = density / (math.sqrt((density**2).mean()) if average == "squares" else density.mean())
    found = amplitudes(points, shape, iterations=4, average=average, reflected=False)
    assert found == pytest.approx(a, rel=1e-4, abs=1e-6)


def test_a_grid_has_amplitudes_of_1_up_to_its_borders():
    at = np.arange(12) * 5 + 2.5
    points = np.stack(np.meshgrid(at, at, indexing="ij"), axis=-1).reshape(-1, 2)
    assert amplitudes(points, (60, 60)) == pytest.approx(1, rel=1e-5)
    cut = amplitudes(points, (60, 60), reflected=False)
    assert cut.min() < 0.95


@pytest.mark.parametrize("reflected", [True, False])
@pytest.mark.parametrize("n", [1, 3, 150])
@pytest.mark.parametrize("estimate", ESTIMATES)
@pytest.mark.parametrize("shape", [(40, 60), (14, 18, 16), (1, 1), (1, 30), (3, 2), (9, 7), (1, 5, 4)])
def test_estimates_add_up_to_the_number_of_points(estimate, shape, n, reflected):
    points = np.random.default_rng(1).random((n, len(shape))) * shape
    found = reconstructed_density(points, shape, estimate=estimate, reflected=reflected)
    assert found.shape == shape
    assert found.sum() == pytest.approx(n, rel=1e-12)
    assert found.min() >= 0
    for size in (tuple(2 * side for side in shape), (1,) * len(shape)):
        other = reconstructed_density(points, shape, estimate=estimate, size=size, reflected=reflected)
        assert other.shape == size
        assert other.mean() == pytest.approx(found.mean(), rel=1e-12)


def test_kernels_have_the_mass_of_their_points_before_they_are_scaled():
    points = np.random.default_rng(1).random((150, 2)) * (40, 60)
    width, a = kernel_width(150, (40, 60), 0.5), amplitudes(points, (40, 60))
    sources, number = with_reflections(points, (40, 60), 12 * width)
    variances = width**2 / a[number] + 1 / 12
    centres = np.argwhere(np.ones((40, 60))) + 0.5
    total = kernel_sums(centres, sources, 1 / (2 * np.pi * variances), variances).sum()
    assert total == pytest.approx(150, rel=2e-4)


def test_a_ramp_is_found_back():
    rows = np.linspace(0.2, 1, 60)
    rng = np.random.default_rng(2)
    y = np.interp((np.arange(3000) + 0.5) / 3000, np.cumsum(rows) / rows.sum(), np.arange(60) + 1.0)
    points = np.stack([np.clip(y, 0, 60), rng.random(3000) * 60], axis=1)
    for estimate in ESTIMATES:
        found = reconstructed_density(points, (60, 60), estimate=estimate).mean(axis=1)
        assert found[5:-5] == pytest.approx(rows[5:-5] * 3000 / rows.sum() / 60, rel=0.1)


@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize("estimate", ESTIMATES)
def test_few_points_are_served(n, estimate):
    points = np.random.default_rng(3).random((n, 2)) * (9, 7)
    found = reconstructed_density(points, (9, 7), estimate=estimate)
    assert np.isfinite(found).all()
    coincident = np.full((5, 2), 3.0)
    assert np.isfinite(reconstructed_density(coincident, (9, 7), estimate=estimate)).all()


def test_reflections_are_mirror_images():
    points, number = with_reflections(np.array([[1.0, 5.0]]), (10, 10), 2.0)
    assert points.tolist() == [[1.0, 5.0], [-1.0, 5.0]]
    assert number.tolist() == [0, 0]
    assert len(with_reflections(np.array([[0.0, 10.0]]), (10, 10), 99.0)[0]) == 9  # at both ends of each axis
    assert len(with_reflections(np.array([[0.0, 10.0]]), (10, 10), 0.0)[0]) == 1
    assert kernel_width(100, (20, 20), 0.5) == pytest.approx(1.0)


def test_quality_is_that_of_the_best_gain():
    image = np.random.default_rng(4).random((32, 32))
    same = image_quality(image / 7, image)
    assert same.gain == pytest.approx(7)
    assert same.psnr > 250
    assert same.ssim == pytest.approx(1)
    noise = image_quality(image + 0.1 * np.sin(np.arange(32)), image)
    assert 20 < noise.psnr < 30
    assert math.isnan(image_quality(np.ones((3, 3)), np.ones((3, 3))).ssim)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ({"points": np.ones((3, 3))}, "must be"),
        ({"points": np.full((3, 2), 11.0)}, "within the domain"),
        ({"estimate": "best"}, "estimate must be"),
        ({"size": (0, 4)}, "size must be"),
        ({"average": "median"}, "average must be"),
        ({"iterations": -1}, "iterations must be"),
        ({"sigma": -1.0}, "sigma must be"),
    ],
)
def test_wrong_arguments_are_refused_in_words(arguments, words):
    given = {"points": np.ones((3, 2)), "shape": (10, 10), **arguments}
    with pytest.raises(InputError, match=words):
        reconstructed_density(**given)
    with pytest.raises(InputError, match="one shape"):
        image_quality(np.ones((3, 3)), np.ones((3, 4)))


def test_a_blurred_difference_of_a_lattice_is_none_and_of_halves_is_the_density():
    density = np.ones((16, 16))
    one_each = np.argwhere(density) + 0.5
    assert blurred_difference(one_each, density, 2.0, toroidal=True) < 1e-12
    shifted = np.where(one_each[:, :1] < 8, one_each, one_each - [8, 0])  # all in the upper half
    found = blurred_difference_map(shifted, density, 2.0, toroidal=True)
    assert found[4] == pytest.approx(1, abs=0.1)
    assert found[12] == pytest.approx(-1, abs=0.1)


@pytest.mark.parametrize(("width", "error"), [(2.0, 6e-4), (5.0, 1.6e-5)])
@pytest.mark.parametrize("toroidal", [False, True])
def test_a_blurred_difference_is_that_of_gaussians_at_the_points(width, error, toroidal):
    rng = np.random.default_rng(8)
    rows, columns = 20, 14
    density, points = rng.random((rows, columns)), rng.random((30, 2)) * (rows, columns)
    points[0] = 0, columns
    wanted = density * 30 / density.sum()

    def gaussians(at, size):  # (n, size): at the centres of pixels
        images = np.arange(-6, 7) * size if toroidal else np.zeros(1)
        away = np.arange(size) + 0.5 - at[:, None, None] + images[:, None]
        return np.exp(-(away**2) / (2 * width**2)).sum(1) / np.sqrt(2 * np.pi) / width

    def over_pixels(size):  # (size, size): a pixel's share of what another centre has
        images = np.arange(-6, 7) * size if toroidal else np.zeros(1)
        edge = np.arange(size)[:, None, None] + images[:, None] - np.arange(size) - 0.5
        return 0.5 * (erf((edge + 1) / width / np.sqrt(2)) - erf(edge / width / np.sqrt(2))).sum(1)

    of_points = gaussians(points[:, 0], rows).T @ gaussians(points[:, 1], columns)
    exact = of_points - over_pixels(rows).T @ wanted @ over_pixels(columns)
    found = blurred_difference_map(points, density, width, toroidal=toroidal) * wanted.mean()
    assert np.abs(found - exact).max() < error * of_points.max()
    with pytest.raises(InputError, match=r"at least 2 pixels, got 1\.9"):
        blurred_difference(points, density, 1.9)
