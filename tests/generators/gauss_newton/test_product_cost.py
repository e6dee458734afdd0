"""The cost told beforehand is that of the tables and grids that are then made."""

from __future__ import annotations

import math
import tracemalloc

import numpy as np
import pytest

from gbnbench.generators.gauss_newton.modes import modes_below
from gbnbench.generators.gauss_newton.product_cost import (
    convolution_operations,
    convolutions_are_cheaper,
    list_operations,
    solver_operations,
    table_bytes,
    table_entries,
    wave_sum_operations,
)
from gbnbench.generators.gauss_newton.wave_sums import WaveSums


@pytest.mark.parametrize(("n", "d", "edge"), [(50, 1, 0.4), (300, 2, 0.7), (300, 3, 0.8), (100, 5, 0.95)])
def test_tables_are_as_large_as_told(n, d, edge):
    x, below = np.random.default_rng(0).random((n, d)), modes_below(n, d, edge)
    made = 2 * n * math.prod(WaveSums(x, below.f).shape)
    assert wave_sum_operations(n, d, int(below.square.max())) == pytest.approx(made, rel=0.35)


@pytest.mark.parametrize(("n", "d", "edge"), [(50, 1, 9.0), (300, 2, 3.0), (300, 3, 1.6), (100, 5, 0.95)])
def test_the_entries_of_tables_are_those_told(n, d, edge):
    x, below = np.random.default_rng(0).random((n, d)), modes_below(n, d, edge)
    assert table_entries(n, d, int(below.square.max())) == pytest.approx(
        n * sum(WaveSums(x, below.f).shape) / 2, rel=0.02
    )


def test_the_memory_told_for_tables_is_taken():
    """On a line, where tables are all: a block in the making is three times 16 bytes an entry, at most."""
    n, below = 64, modes_below(64, 1, 300.0)
    square = int(below.square.max())
    waves = WaveSums(np.random.default_rng(0).random((n, 1)), below.f, single=True)
    tracemalloc.start()
    waves.amplitudes()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert 0.4 * table_bytes(n, 1, square) < peak < 1.05 * table_bytes(n, 1, square)


def test_what_lists_take_is_counted_where_products_are_little():
    """On a line tables are all that takes time, of few points in many waves the frequencies."""
    line, plane = int(1.06 * 16_384) ** 2, 800**2
    assert list_operations(16_384, 1, line) > 10 * wave_sum_operations(16_384, 1, line)
    assert list_operations(64, 2, plane) > 10 * wave_sum_operations(64, 2, plane)
    assert list_operations(16_384, 2, 256**2) < wave_sum_operations(16_384, 2, 256**2)


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
