"""The variance that spectra predict, against brute force over shifts and against measured variance."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.integration.estimator import estimate_errors
from gbnbench.analysis.integration.spectral_variance import FourierSeries, fourier_series, predicted_variance
from gbnbench.analysis.integration.variance import crossed_mean, variance_of
from gbnbench.core.errors import InputError
from gbnbench.core.torus import wrap
from gbnbench.generators.registry import generate
from tests.analysis.integration.band_limited import CosineFamily


@pytest.mark.parametrize("d", [1, 2, 3])
def test_predicted_variance_is_that_over_all_shifts(d):
    """Over every shift of a grid finer than the band the mean square is exact, not sampled."""
    rng = np.random.default_rng(d)
    family = CosineFamily(reach=2)
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
    """Sets as they are, random integrands, agreement within the joint error."""
    family = CosineFamily(reach=4)
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
    class Plain(CosineFamily):
        periodic = False

    assert fourier_series(Plain(), [], 2) is None


def test_dimensions_must_be_the_same():
    series = FourierSeries(np.array([[1, 0]]), np.array([[1.0]]), 0.5)
    with pytest.raises(InputError, match="d=2"):
        predicted_variance(series, np.zeros((4, 3)))
