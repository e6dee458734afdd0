"""Sums of Gaussians on the torus: values and integrals against all images, in both forms."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest

from gbnbench.analysis.integration.integrands import kernel_values
from gbnbench.analysis.integration.integrands.gaussians import Gaussians, GaussianSum
from gbnbench.analysis.integration.integrands.theta_polynomial import NEAREST, circle, theta_polynomial
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.integer_frequencies import half_ball
from gbnbench.core.torus import FloatArray
from tests.oracles.theta import image_sum

DIMENSIONS = (1, 2, 3, 5, 8, 12, 20)


def exact(integrand: GaussianSum, x: FloatArray) -> list[mpmath.mpf]:
    def one(point: FloatArray, centre: FloatArray) -> mpmath.mpf:
        steps = [mpmath.mpf(a) - mpmath.mpf(b) for a, b in zip(point, centre, strict=True)]
        return mpmath.fprod(image_sum(u, integrand.width) for u in steps)

    with mpmath.workdps(30):
        return [mpmath.fsum(one(point, centre) for centre in integrand.centres) for point in x]


def numpy_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(kernel_values, "double_device", lambda: None)


@pytest.mark.parametrize("where", ["device", "numpy"])
@pytest.mark.parametrize("d", DIMENSIONS)
def test_values_are_those_of_all_images(d: int, where: str, monkeypatch: pytest.MonkeyPatch) -> None:
    if where == "numpy":
        numpy_alone(monkeypatch)
    rng = np.random.default_rng(d)
    one = Gaussians(count=3).draw(d, rng)
    near = (one.centres[0] + one.width * rng.normal(size=(2, d))) % 1.0
    x = np.concatenate([near, rng.random((2, d)), one.centres[:1]])
    largest = 3 * float(image_sum(0, one.width)) ** d
    assert np.array(exact(one, x) - one(x), dtype=float) == pytest.approx(0, abs=2e-15 * largest)


@pytest.mark.parametrize("d", [1, 2, 3])
@pytest.mark.parametrize("where", ["device", "numpy"])
def test_both_forms_hold_at_the_switch(d: int, where: str, monkeypatch: pytest.MonkeyPatch) -> None:
    if where == "numpy":
        numpy_alone(monkeypatch)
    rng = np.random.default_rng(9)
    x = np.concatenate([rng.random((6, d)), np.zeros((1, d)), np.full((1, d), 1 - 2.0**-53)])
    centres = np.concatenate([rng.random((2, d)), np.full((1, d), 0.5)])
    x[0] = centres[0] - NEAREST / 2
    for width in (NEAREST, np.nextafter(NEAREST, 1)):
        one = GaussianSum(centres, float(width))
        assert (one.harmonics.size == 0) == (width == NEAREST)
        assert np.array(exact(one, x) - one(x), dtype=float) == pytest.approx(0, abs=3e-15)


def test_the_nearest_image_is_all_there_is_up_to_the_switch() -> None:
    with mpmath.workdps(30):
        at_half = image_sum(0.5, NEAREST) - mpmath.exp(
            -(mpmath.mpf(0.5) ** 2) / (2 * mpmath.mpf(NEAREST) ** 2)
        )
    assert float(at_half) < 2.0**-54


@pytest.mark.parametrize("width", [0.058, 0.0625, 0.125, 0.3, 0.7, 2.0])
def test_the_polynomial_is_theta(width: float) -> None:
    coefficients = theta_polynomial(width)
    with mpmath.workdps(30):
        mean = mpmath.sqrt(2 * mpmath.pi) * mpmath.mpf(width)
        largest = float(image_sum(0, width) / mean)
        assert np.abs(coefficients).sum() < 1.3 * largest
        for u in np.linspace(0, 0.5, 9):
            c = mpmath.cos(2 * mpmath.pi * mpmath.mpf(u))
            value = mpmath.fsum(mpmath.mpf(a) * c**k for k, a in enumerate(coefficients))
            assert float(value - image_sum(u, width) / mean) == pytest.approx(0, abs=4e-16 * largest)


def test_circles_are_exact_at_eighths() -> None:
    x = np.arange(8) / 8
    half = math.sqrt(0.5)
    assert circle(x)[0] == pytest.approx([1, half, 0, -half, -1, -half, 0, half], abs=2e-16)
    assert circle(x)[1] == pytest.approx([0, half, 1, half, 0, -half, -1, -half], abs=2e-16)


@pytest.mark.parametrize("d", [1, 2, 3])
def test_the_integral_is_that_of_a_fine_grid(d: int) -> None:
    m = {1: 8192, 2: 256, 3: 80}[d]
    x = (np.stack(np.meshgrid(*[np.arange(m)] * d), axis=-1) + 0.5) / m
    one = Gaussians(count=5).draw(d, np.random.default_rng(d))
    assert one(x).mean() == pytest.approx(one.integral, rel=2e-15)  # spectral accuracy


@pytest.mark.parametrize("d", DIMENSIONS)
def test_the_integral_is_that_of_whole_gaussians(d: int) -> None:
    one = Gaussians(count=3, points=700).draw(d, np.random.default_rng(0))
    with mpmath.workdps(30):
        width = mpmath.mpf(one.width)
        each = mpmath.quad(lambda u: mpmath.exp(-(u**2) / (2 * width**2)), [-9, -1, 0, 1, 9])
        assert one.integral == pytest.approx(float(3 * each**d), rel=1e-14)


@pytest.mark.parametrize(("d", "m"), [(1, 4096), (2, 160)])
def test_energy_is_that_of_the_fourier_transform_of_samples(d: int, m: int) -> None:
    one = Gaussians(count=6).draw(d, np.random.default_rng(4))
    x = np.stack(np.meshgrid(*[np.arange(m) / m] * d, indexing="ij"), axis=-1)
    f = half_ball(d, 300)
    sampled = np.abs(np.fft.fftn(one(x))[tuple(f.T)] / m**d) ** 2
    assert one.energy(f) == pytest.approx(sampled, rel=1e-9, abs=1e-25)
    assert one.energy(-f) == pytest.approx(one.energy(f), rel=1e-12)


def test_the_mean_energy_is_the_mean_over_centres() -> None:
    family, rng = Gaussians(count=5), np.random.default_rng(2)
    f = half_ball(2, 10)
    each = np.array([family.draw(2, rng).energy(f) for _ in range(4000)])
    error = each.std(axis=0) / math.sqrt(len(each))
    assert np.abs(each.mean(axis=0) - family.mean_energy(f)) == pytest.approx(0, abs=4.5 * error.max())


@pytest.mark.parametrize("d", [1, 2, 3, 5, 8, 12, 20])
@pytest.mark.parametrize("share", [0.1, 1e-6])
def test_frequencies_leave_out_no_more_than_the_share(d: int, share: float) -> None:
    family = Gaussians()
    f = family.frequencies(d, share)
    decay = 4 * math.pi**2 * family.width(d) ** 2
    with mpmath.workdps(40):
        total = mpmath.jtheta(3, 0, mpmath.exp(-decay)) ** d - 1
        squares, times = np.unique((f**2).sum(axis=1), return_counts=True)
        each = [2 * int(k) * mpmath.exp(-decay * int(m)) for m, k in zip(squares, times, strict=True)]
        kept = mpmath.fsum(each)
        assert 0 <= 1 - kept / total < share
        assert 1 - (kept - each[-1]) / total >= share or len(each) == 1  # no shell too many


def test_settings_and_dimensions_out_of_range_are_told() -> None:
    with pytest.raises(InputError, match="count of gaussians must be at least 1; got 0"):
        Gaussians(count=0)
    with pytest.raises(InputError, match="points of gaussians must be at least 1; got 0"):
        Gaussians(points=0)
    assert Gaussians().refusal(21) == "sums of Gaussians are for d = 1 to 20; got d=21"
    with pytest.raises(RefusalError, match="d=21"):
        Gaussians().draw(21, np.random.default_rng(0))
