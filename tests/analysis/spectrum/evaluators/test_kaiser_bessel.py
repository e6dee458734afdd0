"""The window against Bessel functions and the waves that it must carry."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

from gbnbench.analysis.spectrum.evaluators.kaiser_bessel import OVERSAMPLING, nodes_for, window


@pytest.mark.parametrize(("width", "degree", "allowed"), [(16, 18, 3e-16), (8, 11, 3e-8)])
@mpmath.workdps(40)
def test_polynomials_are_the_kaiser_bessel_window(width, degree, allowed):
    fitted = window(width, degree)
    beta = mpmath.mpf(float(np.pi * width * (1 - 0.5 / OVERSAMPLING) * 0.99))
    place = np.array([0.0, 0.125, 0.5, 0.9375])
    values = fitted.values(place)
    for i, s in enumerate(place):
        for j in range(width):
            z = (j - width // 2 + 1 - mpmath.mpf(s)) / (mpmath.mpf(width) / 2)
            exact = mpmath.besseli(0, beta * mpmath.sqrt(1 - z * z)) / mpmath.besseli(0, beta)
            assert values[i, j] == pytest.approx(float(exact), abs=allowed)


@pytest.mark.parametrize(("width", "degree", "allowed"), [(16, 18, 3e-15), (8, 11, 2e-7)])
@pytest.mark.parametrize("fmax", [12, 64, 311])
def test_waves_are_carried_by_any_place_to_rounding(width, degree, allowed, fmax):
    fitted = window(width, degree)
    nodes = nodes_for(fmax, 4)
    place = np.random.default_rng(0).random(50)
    f = np.arange(fmax + 1)
    away = np.arange(width) - width // 2 + 1
    phase = (away - place[:, None])[:, :, None] * f / nodes
    carried = (fitted.values(place)[:, :, None] * np.exp(-2j * np.pi * phase)).sum(axis=1)
    assert np.abs(carried / fitted.transform(fmax, nodes) - 1).max() <= allowed
    assert fitted.left_out <= allowed
    assert 1 < fitted.amplification(fmax, nodes) < 4


def test_nodes_are_two_and_a_half_times_the_frequencies():
    assert nodes_for(64, 4) == 324
    assert nodes_for(1, 8) == 8
