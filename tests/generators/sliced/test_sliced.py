"""Sliced transport: the map keeps volumes, the quantiles are the ball's, a step is a mean of transports."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.measures import measures
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.generators.registry import find, generate
from gbnbench.generators.sliced.ball_to_cube import ball_to_cube, slope_of_edge
from gbnbench.generators.sliced.generator import ball_quantiles, random_directions, transport


@pytest.mark.parametrize("d", [2, 3, 5])
def test_the_map_to_the_cube_keeps_volumes(d):
    """Its Jacobian, by differences at points of the ball, is 2^d over the ball's volume everywhere."""
    from math import gamma, pi

    rng = np.random.default_rng(0)
    step = 1e-6
    for _ in range(20):
        x = rng.standard_normal(d)
        x *= 0.9 * rng.random() ** (1 / d) / np.linalg.norm(x)
        around = np.concatenate([x + step * np.eye(d), x - step * np.eye(d)])
        ahead, behind = np.split(ball_to_cube(around), 2)
        volume = abs(np.linalg.det((ahead - behind) / (2 * step)))
        assert volume == pytest.approx(2**d * gamma(d / 2 + 1) / pi ** (d / 2), rel=1e-5)


@pytest.mark.parametrize("d", [2, 3, 6])
def test_the_map_takes_sphere_to_surface_and_is_odd(d):
    x = np.random.default_rng(1).standard_normal((50, d))
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    assert np.abs(ball_to_cube(x)).max(axis=1) == pytest.approx(np.ones(50))
    assert np.array_equal(ball_to_cube(-x), -ball_to_cube(x))
    assert np.array_equal(ball_to_cube(np.zeros((1, d))), np.zeros((1, d)))


def test_the_plane_has_shirleys_map_and_space_its_slope():
    """On the side of the square the angle grows in proportion: 1/3 of the way at 15 degrees."""
    angle = np.pi / 4 / 3
    x = np.array([[np.cos(angle), np.sin(angle)]])
    assert ball_to_cube(x) == pytest.approx(np.array([[1, 1 / 3]]))
    assert slope_of_edge(3) == pytest.approx(np.sqrt(0.8))  # sin(atan) = 2 (1 - cos(atan(1 / .)))


@pytest.mark.parametrize("d", [2, 3, 7])
def test_quantiles_are_those_of_the_projected_ball(d):
    rng = np.random.default_rng(2)
    v = rng.standard_normal((100_000, d))
    v *= rng.random((len(v), 1)) ** (1 / d) / np.linalg.norm(v, axis=1, keepdims=True)
    drawn = np.quantile(v[:, 0], (np.arange(9) + 0.5) / 9)
    assert ball_quantiles(9, d) == pytest.approx(drawn, abs=0.015)  # four errors of a quantile of 1e5


def test_a_step_is_the_mean_of_transports_in_one_dimension():
    rng = np.random.default_rng(3)
    x, directions = rng.random((40, 3)) - 0.5, random_directions(5, 3, rng)
    assert np.linalg.norm(directions, axis=1) == pytest.approx(np.ones(5))
    quantiles = ball_quantiles(40, 3)
    expected = np.zeros((40, 3))
    for direction in directions:
        projected = x @ direction
        expected[np.argsort(projected)] += (quantiles - np.sort(projected))[:, None] * direction / 5
    assert transport(x, directions, quantiles) == pytest.approx(expected, abs=1e-12)


def test_a_set_at_its_quantiles_does_not_move():
    quantiles = ball_quantiles(10, 2)
    x = np.stack([quantiles, np.zeros(10)], axis=1)
    assert np.abs(transport(x, np.array([[1.0, 0.0]]), quantiles)).max() < 1e-15


def test_what_it_cannot_do_is_refused():
    with pytest.raises(RefusalError, match="got d=1, nearest is 2"):
        generate("sliced", n=16, d=1)
    with pytest.raises(RefusalError, match="n=1000000 points take"):
        generate("sliced", n=10**6)
    for text in ("sliced[iterations=-1]", "sliced[directions=0]"):
        with pytest.raises(InputError, match="must be"):
            find(text)


@pytest.mark.slow
def test_the_floor_goes_down_with_the_directions():
    """Each step moves by the mean over directions, whose scatter goes as one over their number."""
    floor = [
        measures(generate("sliced", n=512, realizations=3, iterations=1500, directions=m))["noise_floor"]
        for m in (8, 32)
    ]
    assert 2.5 < floor[0] / floor[1] < 6
