"""Limited-memory BFGS: minima that are known, and the ways in which it stops."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.torus import FloatArray
from gbnbench.generators.spectral_control.limited_memory_bfgs import minimise


def rosenbrock(x: FloatArray) -> tuple[float, FloatArray]:
    a, b = x[:, 0], x[:, 1]
    value = float(np.sum((1 - a) ** 2 + 100 * (b - a**2) ** 2))
    return value, np.stack([-2 * (1 - a) - 400 * a * (b - a**2), 200 * (b - a**2)], axis=1)


def test_rosenbrocks_valley_is_followed_to_its_end():
    end = minimise(rosenbrock, np.array([[-1.2, 1.0], [0.0, 0.5]]), 500, 1e-20)
    assert end.x == pytest.approx(np.ones((2, 2)), abs=1e-8)
    assert end.iterations < 500


def test_an_ill_conditioned_bowl_takes_few_steps():
    stiffness = np.geomspace(1, 1e2, 20).reshape(10, 2)
    told: list[float] = []
    end = minimise(
        lambda x: (float(np.sum(stiffness * x**2)), 2 * stiffness * x),
        np.ones((10, 2)),
        120,
        1e-14,
        lambda _, value: told.append(value),
    )
    assert end.value <= 1e-14
    assert told == sorted(told, reverse=True)
    assert len(told) == end.iterations


def test_no_step_is_taken_where_none_is_wanted_or_none_helps():
    start = np.ones((3, 2))
    assert minimise(rosenbrock, start, 10, 1.0).iterations == 0
    assert minimise(rosenbrock, 2 * start, 0, 0.0).iterations == 0
    wrong = minimise(lambda x: (float(np.sum(x**2)), -2 * x), start, 10, 0.0)
    assert wrong.iterations == 0
    assert np.array_equal(wrong.x, start)
