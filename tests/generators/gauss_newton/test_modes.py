"""Frequencies below an edge, listed and counted, against the whole cube."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.generators.gauss_newton.modes import bound_coordinates, half_ball, modes_below
from tests.oracles.gauss_newton import half_space_below


@pytest.mark.parametrize(("n", "d", "edge"), [(20, 1, 0.4), (64, 2, 0.72), (100, 3, 0.8), (50, 5, 0.95)])
def test_one_of_each_pair_below_the_edge(n, d, edge):
    below = modes_below(n, d, edge)
    assert sorted(map(tuple, below.f)) == sorted(map(tuple, half_space_below(edge, n, d)))
    assert bound_coordinates(n, d, edge) == 2 * len(below)
    assert below.nu == pytest.approx(np.linalg.norm(below.f, axis=1) * n ** (-1 / d), rel=1e-14)
    assert np.linalg.norm(below.direction, axis=1) == pytest.approx(1)


def test_a_frequency_on_the_edge_is_left_out():
    assert modes_below(100, 2, 0.5).square.max() == 20  # 4**2 + 2**2; |f| = 5 is nu = 0.5


def test_there_are_none_below_the_first():
    assert len(modes_below(64, 2, 0.1)) == 0
    assert bound_coordinates(64, 2, 0.1) == 0


def test_the_count_needs_no_list():
    assert bound_coordinates(10**6, 2, 0.72) == pytest.approx(math.pi * 0.72**2 * 1e6, rel=1e-3)
    assert bound_coordinates(1000, 30_000, 42.0) == 1e150
    assert bound_coordinates(1000, 8, 1.06) == 2 * len(half_ball(8, 6))
