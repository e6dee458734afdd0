"""Energy and gradient of Gaussian Blue Noise against mpmath's theta function and plain image sums."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest

from gbnbench.analysis.periodogram import periodogram
from gbnbench.generators.gbn import energy
from gbnbench.generators.gbn.energy import NearestImage, Theta, field
from gbnbench.opencl import runtime

ALLOWED = {"double": 1e-12, "float": 2e-5}  # of the largest component
ROUNDING = {"double": 1e-14, "float": 3e-6}  # of one pair's force, where n of them cancel


def theta_field(x, sigma):
    """Gradient in spacings and excess energy by mpmath's jtheta (Eq. 22), 30 digits, pair by pair."""
    n, d = x.shape
    with mpmath.workdps(30):
        side = mpmath.mpf(n) ** (mpmath.mpf(1) / d)
        s = mpmath.mpf(sigma) / side
        nome = mpmath.exp(-2 * mpmath.pi**2 * s**2)
        scale = mpmath.sqrt(2 * mpmath.pi) * s
        energy, gradient = mpmath.mpf(0), [[mpmath.mpf(0)] * d for _ in range(n)]
        for k in range(n):
            for m in range(n):
                u = [mpmath.mpf(float(x[k, a])) - mpmath.mpf(float(x[m, a])) for a in range(d)]
                value = [scale * mpmath.jtheta(3, mpmath.pi * t, nome) for t in u]
                slope = [scale * mpmath.pi * mpmath.jtheta(3, mpmath.pi * t, nome, 1) / side for t in u]
                energy += mpmath.fprod(value) / 2
                for a in range(d):
                    gradient[k][a] += slope[a] * mpmath.fprod(v for b, v in enumerate(value) if b != a)
        uniform = n * (2 * mpmath.pi) ** (mpmath.mpf(d) / 2) * mpmath.mpf(sigma) ** d / 2
        return np.array(gradient, float), float((energy - uniform) / n)


@pytest.mark.parametrize(
    ("n", "d", "sigma"), [(2, 2, 1.0), (7, 1, 0.5), (9, 2, 0.7), (8, 3, 1.3), (6, 5, 1.0), (5, 9, 0.4)]
)
@pytest.mark.parametrize("precision", ["double", "float"])
def test_small_boxes_agree_with_the_theta_function(n, d, sigma, precision):
    x = np.random.default_rng(n).random((n, d))
    gradient, excess = theta_field(x, sigma)
    at = field(n, d, sigma, precision)(x)
    assert np.abs(at.gradient - gradient).max() <= ALLOWED[precision] * np.abs(gradient).max()
    assert at.excess == pytest.approx(excess, abs=ALLOWED[precision] * (1 + abs(excess)))


def image_sum(x, sigma):
    """The same by adding images one by one, in numpy."""
    n, d = x.shape
    side = n ** (1 / d)
    u = ((x[:, None] - x[None]) * side)[..., None] + np.arange(-3, 4) * side
    gauss = np.exp(-(u**2) / (2 * sigma**2))
    value, slope = gauss.sum(-1), (-u / sigma**2 * gauss).sum(-1)
    gradient = [(slope[..., a] * np.delete(value, a, -1).prod(-1)).sum(1) for a in range(d)]
    excess = value.prod(-1).sum() / (2 * n) - (2 * math.pi) ** (d / 2) * sigma**d / 2
    return np.stack(gradient, 1), excess


@pytest.mark.parametrize(("n", "d", "sigma"), [(431, 2, 0.9), (509, 2, 0.3), (53, 1, 1.0), (347, 3, 0.35)])
@pytest.mark.parametrize("precision", ["double", "float"])
def test_both_evaluations_agree_with_image_sums_on_hard_sets(n, d, sigma, precision):
    rng = np.random.default_rng(n)
    scattered = rng.random((n, d))
    clustered = 0.5 + 1e-3 * rng.standard_normal((n, d))
    border = rng.choice([0.0, 1 - 2.0**-53, 2.0**-60], (n, d))
    coincident = np.full((n, d), 0.25)
    for x in (scattered, clustered, border, coincident):
        gradient, excess = image_sum(x, sigma)
        allowed = ALLOWED[precision] * np.abs(gradient).max() + ROUNDING[precision] * n
        for evaluate in (
            NearestImage(runtime(), n, d, sigma, precision),
            Theta(runtime(), n, d, sigma, precision),
        ):
            at = evaluate(x)
            assert np.abs(at.gradient - gradient).max() <= allowed, evaluate.method
            assert at.excess == pytest.approx(excess, rel=ALLOWED[precision], abs=ALLOWED[precision])


def test_the_cheaper_exact_evaluation_is_chosen():
    assert field(1024, 2, 1.0, "double").method == NearestImage.method
    assert field(300, 2, 1.0, "double").method == Theta.method  # 17.3 spacings: images matter at 9 sigma
    assert field(300, 2, 1.0, "float").method == NearestImage.method
    assert field(1024, 8, 1.0, "double").method == Theta.method


@pytest.mark.parametrize(("n", "d", "fmax"), [(400, 2, 30), (64, 2, 20), (50, 3, 8)])
def test_excess_is_the_weighted_sum_of_the_power(n, d, fmax):
    x = np.random.default_rng(n).random((n, d))
    power = periodogram(x, fmax).power
    f = np.indices(power.shape) - fmax
    q2 = (2 * np.pi / n ** (1 / d)) ** 2 * (f**2).sum(axis=0)
    weight = (2 * np.pi) ** (d / 2) * np.exp(-q2 / 2)
    weight[(fmax,) * d] = 0
    assert field(n, d, 1.0)(x).excess == pytest.approx((weight * power).sum() / (2 * n), rel=1e-9)


def test_a_flat_kernel_gives_finite_forces():
    x = np.random.default_rng(1).random((20, 2))
    at = field(20, 2, 3.0)(x)
    assert np.isfinite(at.gradient).all()
    assert np.isfinite(at.excess)


def test_forces_keep_their_digits_across_the_border():
    """Two points a hair apart on either side of 0: theta must see their distance."""
    for apart in (1e-9, 1e-13):
        x = np.array([[apart / 2, 0.3], [1 - apart / 2, 0.3], [0.5, 0.6]])
        moved = np.array([[0.5 + apart / 2, 0.3], [0.5 - apart / 2, 0.3], [0.0, 0.6]])
        near, same = (Theta(runtime(), 3, 2, 1.0, "double")(points).gradient for points in (x, moved))
        rounded = 2.0**-52 / apart  # of 1 - apart/2 itself
        assert near[0, 0] == pytest.approx(same[0, 0], rel=1e-12 + 4 * rounded, abs=1e-15)


@pytest.mark.parametrize("box", [1, 32])
def test_any_size_of_box_gives_the_same_forces(monkeypatch, box):
    """Vectors may hold more points than a box is meant to: sixteen floats on some devices."""
    monkeypatch.setattr(energy, "BOX", box)
    x = np.random.default_rng(1).random((431, 2))
    for precision in ("double", "float"):
        gradient, _ = image_sum(x, 1.0)
        at = NearestImage(runtime(), 431, 2, 1.0, precision)(x)
        assert np.abs(at.gradient - gradient).max() <= ALLOWED[precision] * np.abs(gradient).max()
