"""Estimates against their definition, and the variance that spectra foretell against brute force."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
import pytest

from gbnbench.analysis.integration.estimator import estimate_errors
from gbnbench.analysis.integration.spectral_variance import FourierSeries, fourier_series, predicted_variance
from gbnbench.analysis.integration.variance import crossed_mean, variance_of
from gbnbench.core.errors import InputError
from gbnbench.core.torus import wrap
from gbnbench.generators.registry import generate


@dataclass(frozen=True, eq=False)
class Cosines:
    """2 + sum of a_f cos(2 pi (f.x + phase_f)): band-limited, written without the library."""

    f: np.ndarray
    a: np.ndarray
    phase: np.ndarray
    integral: float = 2.0

    def __call__(self, x):
        return 2 + np.cos(2 * np.pi * (x @ self.f.T + self.phase)) @ self.a

    def energy(self, frequencies):
        found = np.zeros(len(frequencies))
        for k, g in enumerate(frequencies):
            same = np.all(self.f == g, axis=1) | np.all(self.f == -g, axis=1)
            found[k] = np.sum(self.a[same] / 2) ** 2 if same.any() else 0.0
        return found


@dataclass(frozen=True)
class Family:
    name: ClassVar[str] = "cosines"
    summary: ClassVar[str] = ""
    periodic: ClassVar[bool] = True
    reach: int = 3

    def refusal(self, d):
        return None

    def frequencies(self, d, share, most=0):
        cube = np.indices((2 * self.reach + 1,) * d).reshape(d, -1).T - self.reach
        return cube[len(cube) // 2 + 1 :]

    def draw(self, d, rng):
        f = self.frequencies(d, 0.5)
        f = f[rng.permutation(len(f))[:5]]
        return Cosines(f, rng.random(len(f)), rng.random(len(f)))


def test_errors_are_means_less_the_integral():
    rng = np.random.default_rng(0)
    family = Family()
    drawn = [family.draw(2, rng) for _ in range(3)]
    x = rng.random((4, 50, 2))
    errors = estimate_errors(drawn, x)
    assert errors.shape == (3, 4)
    for i, integrand in enumerate(drawn):
        for k, points in enumerate(x):
            assert errors[i, k] == pytest.approx(integrand(points).mean() - 2, abs=1e-14)


def test_a_constant_far_above_its_error_does_not_hide_it():
    class Tilted:
        integral = 1e6

        def __call__(self, x):
            return 1e6 + 1e-9 * np.cos(2 * np.pi * x[:, 0])

    x = np.array([[[0.0], [0.5], [0.25], [0.0]]])
    # Each value is good to 1e-10, a rounding of the million, and so is the mean: 1e-9 / 4.
    assert estimate_errors([Tilted()], x)[0, 0] == pytest.approx(2.5e-10, abs=1.2e-10)


@pytest.mark.parametrize("d", [1, 2, 3])
def test_predicted_variance_is_that_over_all_shifts(d):
    """Over every shift of a grid finer than the band the mean square is exact, not sampled."""
    rng = np.random.default_rng(d)
    family = Family(reach=2)
    integrand = family.draw(d, rng)
    x = rng.random((2, 20, d))
    steps = 5  # > 2 reach: products of two waves of the band average to zero over the grid of shifts
    shifts = np.indices((steps,) * d).reshape(d, -1).T / steps
    series = fourier_series(family, [integrand], d)
    (predicted,) = predicted_variance(series, x)
    for k in range(2):
        moved = wrap(x[k][None] + shifts[:, None, :])
        squares = estimate_errors([integrand], moved)[0] ** 2
        assert predicted[k] == pytest.approx(squares.mean(), rel=1e-12)


def test_measured_and_predicted_agree_for_a_band_limited_family():
    """The issue's demonstration: sets as they are, random integrands, agreement within the joint error."""
    family = Family(reach=4)
    rng = np.random.default_rng(5)
    drawn = [family.draw(2, rng) for _ in range(60)]
    series = fourier_series(family, drawn, 2)
    for name in ("random", "jittered", "gbn[gradients=30]"):
        x = generate(name, n=64, d=2, seed=3, realizations=40)
        measured = variance_of(estimate_errors(drawn, x))
        predicted = predicted_variance(series, x)
        assert predicted.shape == (60, 40)
        difference = crossed_mean(estimate_errors(drawn, x) ** 2 - predicted)
        assert abs(difference.value) < 3.5 * difference.standard_error, name
        assert difference.standard_error < 0.1 * measured.value  # so that agreement means something


def test_a_family_that_is_not_periodic_has_no_series():
    class Plain(Family):
        periodic = False

    assert fourier_series(Plain(), [], 2) is None


def test_dimensions_must_be_the_same():
    series = FourierSeries(np.array([[1, 0]]), np.array([[1.0]]), 0.5)
    with pytest.raises(InputError, match="d=2"):
        predicted_variance(series, np.zeros((4, 3)))
