"""Errors of estimates against their definition."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.integration.estimator import estimate_errors
from tests.analysis.integration.band_limited import CosineFamily


def test_errors_are_means_less_the_integral():
    rng = np.random.default_rng(0)
    family = CosineFamily()
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
