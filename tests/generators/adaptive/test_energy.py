"""The adaptive energy against finite differences, a plain double sum, and the uniform method."""

from __future__ import annotations

import itertools
import math

import numpy as np
import pytest

from gbnbench.doctor.numpy_references import numpy_box_gradient
from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.gbn.energy import AdaptiveEnergy
from gbnbench.generators.adaptive.gbn.kernel_widths import kernel_widths
from gbnbench.opencl import runtime


def _bumps(shape, seed=0):
    rng = np.random.default_rng(seed)
    at = np.meshgrid(*(np.arange(size) / 7 for size in shape), indexing="ij")
    return 1 + np.prod(np.sin(at), axis=0) + 0.3 * rng.random(shape)


def _energy(density, n, precision, *, sigma=1.0, smoothing=0.5, spread=0.8):
    return AdaptiveEnergy(
        runtime(), density, n, sigma=sigma, smoothing=smoothing, spread=spread, precision=precision
    )


@pytest.mark.parametrize("toroidal", [False, True])
@pytest.mark.parametrize(("shape", "n"), [((40, 56), 60), ((14, 18, 16), 25)])
def test_the_gradient_is_the_slope_of_the_energy(shape, n, toroidal):
    density = as_density(_bumps(shape), toroidal=toroidal)
    energy = _energy(density, n, "double")
    rng = np.random.default_rng(1)
    x = 0.5 + rng.random((n, len(shape))) * (np.array(shape) - 1)
    gradient, step = energy(x).gradient, 1e-4
    for _ in range(6):
        k, a = rng.integers(n), rng.integers(len(shape))
        ahead, behind = x.copy(), x.copy()
        ahead[k, a] += step
        behind[k, a] -= step
        slope = (energy(ahead).energy - energy(behind).energy) / (2 * step)
        assert slope == pytest.approx(gradient[k, a], abs=1e-7 * np.abs(gradient).max())


def test_float_agrees_with_double():
    density = as_density(_bumps((40, 56)))
    x = np.random.default_rng(2).random((80, 2)) * density.shape
    exact = _energy(density, 80, "double", smoothing=1.0)(x)
    fast = _energy(density, 80, "float", smoothing=1.0)(x)
    assert fast.energy == pytest.approx(exact.energy, rel=1e-5)
    assert np.abs(fast.gradient - exact.gradient).max() < 2e-5 * np.abs(exact.gradient).max()
    assert fast.widths == pytest.approx(exact.widths, rel=1e-6)


@pytest.mark.parametrize("spread", [0.0, 0.5, 1.0])
def test_the_energy_is_the_double_sum_over_points_and_pixels(spread):
    density, n = as_density(_bumps((30, 26)), toroidal=True), 40
    energy = _energy(density, n, "double", spread=spread)
    x = np.random.default_rng(3).random((n, 2)) * density.shape
    found = energy(x)
    widths = kernel_widths(density, n, 1.0, 0.5)
    centres = np.argwhere(np.ones(density.shape)) + 0.5

    def gauss(distance2, variance):
        return np.exp(-distance2 / (2 * variance)) / (2 * np.pi * variance)

    v = found.widths**2
    of_pixels = spread**2 * np.exp(2 * widths.log_width.ravel()) + 1 / 12
    expected = 0.0
    for image in itertools.product(range(-2, 3), repeat=2):
        shift = np.array(image) * density.shape
        between = ((x[:, None] - x + shift) ** 2).sum(axis=2)
        to_pixels = ((x[:, None] - centres + shift) ** 2).sum(axis=2)
        expected += 0.5 * gauss(between, v[:, None] + v).sum()
        expected -= (density.of_points(n).ravel() * gauss(to_pixels, v[:, None] + of_pixels)).sum()
    # Shares are interpolated among a ladder of widths.
    assert found.energy == pytest.approx(expected, rel=2e-5)


@pytest.mark.parametrize(("shape", "n"), [((64, 64), 256), ((60, 84), 200), ((24, 24, 24), 100)])
def test_a_constant_density_gives_the_gradient_of_the_uniform_method(shape, n):
    density, d, sigma = as_density(np.ones(shape), toroidal=True), len(shape), 1.0
    x = np.random.default_rng(4).random((n, d)) * shape
    found = _energy(density, n, "double", sigma=sigma)(x)
    spacing = (math.prod(shape) / n) ** (1 / d)
    assert found.widths == pytest.approx(sigma * spacing / math.sqrt(2), rel=1e-12)
    apart = x[:, None] - x
    uniform = np.zeros((n, d))
    for image in itertools.product(range(-2, 3), repeat=d):
        there = apart + np.array(image) * shape
        kernel = np.exp(-(there**2).sum(axis=2) / (2 * (sigma * spacing) ** 2))
        uniform -= (kernel[..., None] * there).sum(axis=1) / (sigma * spacing) ** 2
    mass = (2 * math.pi * sigma**2 * spacing**2) ** (d / 2)  # of the uniform kernel
    assert found.gradient * mass == pytest.approx(uniform, abs=1e-12 * np.abs(uniform).max())


def test_a_constant_density_in_a_box_gives_the_gradient_of_the_bounded_method():
    n, side = 100, 60
    density = as_density(np.ones((side, side)))
    x = np.random.default_rng(5).random((n, 2)) * side
    found = _energy(density, n, "double", spread=1.0)(x)
    spacing = side / math.sqrt(n)
    uniform = numpy_box_gradient(x / side, 1.0) / spacing
    mass = 2 * math.pi * spacing**2
    assert found.gradient * mass == pytest.approx(uniform, abs=1e-9 * np.abs(uniform).max())


@pytest.mark.parametrize("smoothing", [0.5, 1.0])
def test_kernel_widths_solve_their_equation(smoothing):
    density, n = as_density(_bumps((48, 40)), toroidal=True), 300
    found = np.exp(kernel_widths(density, n, 0.9, smoothing).log_width)
    k = [2 * np.pi * np.fft.fftfreq(size) for size in density.shape]
    square = k[0][:, None] ** 2 + k[1] ** 2
    spectrum = np.fft.fft2(density.of_points(n))
    for i, j in ((0, 0), (11, 31), (40, 7)):
        mean = np.fft.ifft2(spectrum * np.exp(-0.5 * square * (smoothing * found[i, j]) ** 2)).real[i, j]
        assert 2 * found[i, j] ** 2 * mean == pytest.approx(0.9**2, rel=5e-3)  # a straight line in a step
