"""Conjugate gradients on matrices that are known, and the tolerance of each step."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.generators.gauss_newton.conjugate_gradients import forcing, solve


def real_linear(rng, m):
    """A positive matrix on the real and imaginary parts, and its product."""
    root = rng.normal(size=(2 * m, 2 * m))
    matrix = root @ root.T + 0.1 * np.eye(2 * m)

    def product(y):
        z = matrix @ np.concatenate([y.real, y.imag])
        return z[:m] + 1j * z[m:]

    return matrix, product


def test_it_solves_to_the_tolerance():
    rng = np.random.default_rng(0)
    matrix, product = real_linear(rng, 15)
    b = rng.normal(size=15) + 1j * rng.normal(size=15)
    y, products = solve(product, b, 1e-10, 500)
    expected = np.linalg.solve(matrix, np.concatenate([b.real, b.imag]))
    assert np.concatenate([y.real, y.imag]) == pytest.approx(expected, rel=1e-6)
    assert 0 < products < 500
    loose, fewer = solve(product, b, 0.1, 500)
    assert np.linalg.norm(product(loose) - b) <= 0.1001 * np.linalg.norm(b)
    assert fewer < products


def test_it_keeps_within_its_limit():
    _, product = real_linear(np.random.default_rng(1), 30)
    assert solve(product, np.ones(30, complex), 1e-12, 3)[1] == 3


def test_nothing_is_solved_by_nothing():
    y, products = solve(lambda y: y, np.zeros(3, complex), 1e-3, 10)
    assert not y.any()
    assert products == 0


def test_the_tolerance_follows_the_residual():
    assert forcing(1.0, math.inf, 0.1) == 0.1
    assert forcing(0.1, 1.0, 0.01) == pytest.approx(0.9e-2)
    assert forcing(1e-9, 1.0, 1e-3) == 1e-5
    assert forcing(2.0, 1.0, 1e-3) == 0.1
