"""The cost told beforehand is that of the tables and grids that are then made."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.generators.gauss_newton.modes import modes_below
from gbnbench.generators.gauss_newton.product_cost import (
    convolution_operations,
    convolutions_are_cheaper,
    solver_operations,
    wave_sum_operations,
)
from gbnbench.generators.gauss_newton.wave_sums import WaveSums


@pytest.mark.parametrize(("n", "d", "edge"), [(50, 1, 0.4), (300, 2, 0.7), (300, 3, 0.8), (100, 5, 0.95)])
def test_tables_are_as_large_as_told(n, d, edge):
    x, below = np.random.default_rng(0).random((n, d)), modes_below(n, d, edge)
    made = 2 * n * math.prod(WaveSums(x, below.f).shape)
    assert wave_sum_operations(n, d, int(below.square.max())) == pytest.approx(made, rel=0.35)


def test_transforms_win_in_the_plane_and_sums_in_high_dimension():
    """Measured ms of a product, transforms and sums: 0.4, 1.3; 1.9, 4.1; 24, 4.3; 78, 7.1."""
    for n, d, edge, expected in ((1024, 2, 0.72, True), (1000, 3, 0.835, True), (1024, 4, 0.9, False)):
        assert convolutions_are_cheaper(n, d, int(modes_below(n, d, edge).square.max())) is expected
    assert convolutions_are_cheaper(1024, 5, 14) is False


def test_a_grid_that_does_not_fit_is_never_chosen():
    assert convolution_operations(8, 20) == math.inf
    assert not convolutions_are_cheaper(10**6, 8, 40)


def test_work_grows_as_the_square_of_the_points_in_the_plane():
    assert solver_operations(4 * 10**5, 2, 0.72) == pytest.approx(
        16 * solver_operations(10**5, 2, 0.72), rel=0.1
    )
    assert solver_operations(100, 2, 0.05) == 0
