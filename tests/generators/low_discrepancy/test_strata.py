"""Multi-jittered and optimised Latin sets: their strata, and exchanges that lower the criterion."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, toroidal_distance
from gbnbench.generators.low_discrepancy.correlated_multijitter import CorrelatedMultiJitter
from gbnbench.generators.low_discrepancy.latin_maximin import LatinMaximin
from gbnbench.generators.registry import generate


@pytest.mark.parametrize(("n", "aspect"), [(1, 1.0), (2, 1.0), (36, 1.0), (24, 1.5), (32, 2.0), (30, 1.2)])
def test_cmj_has_one_point_a_cell_and_a_stratum_where_n_is_a_product(n: int, aspect: float) -> None:
    x = CorrelatedMultiJitter(aspect)(n, 2, np.random.default_rng(n))
    columns = max(1, int(np.sqrt(n * aspect)))
    assert np.array_equal(np.sort(np.floor(x * n), axis=0), np.repeat(np.arange(n)[:, None], 2, axis=1))
    assert len(np.unique(np.floor(x * [columns, n // columns]), axis=0)) == n


@pytest.mark.parametrize("n", [3, 29, 1000])
def test_cmj_of_any_number_has_one_point_in_each_stratum_of_y(n: int) -> None:
    x = generate("cmj", n=n, d=2, seed=n)
    columns = int(np.sqrt(n))
    rows = -(-n // columns)
    assert np.array_equal(np.sort(np.floor(x[:, 1] * n)), np.arange(n))
    assert len(np.unique(np.floor(x[:, 0] * columns * rows))) == n


def test_cmj_rows_share_the_order_of_their_columns() -> None:
    """The correlated shuffle: within its cell, a point's place on x tells the row and nothing else."""
    x = generate("cmj", n=64, d=2, seed=1)
    cell = np.floor(x * 8).astype(int)
    sub = np.floor(x[:, 0] * 64).astype(int) % 8
    for row in range(8):
        assert len(np.unique(sub[cell[:, 1] == row])) == 1


def test_the_largest_power_tells_exchanges_apart() -> None:
    """Sums of distance**-100 stay finite, and the least distance grows."""
    drawn = [LatinMaximin(100, steps)(200, 2, np.random.default_rng(3)) for steps in (0, 2)]
    least = [np.min(toroidal_distance(x[:, None], x[None]) + np.eye(200)) for x in drawn]
    assert least[1] > 3 * least[0]


def phi(x: FloatArray, power: int) -> float:
    distance = toroidal_distance(x[:, None], x[None])
    return float((distance[np.triu_indices(len(x), 1)] ** -float(power)).sum() ** (1 / power))


@pytest.mark.parametrize(("n", "d", "power"), [(40, 2, 16), (30, 3, 15), (25, 4, 2)])
def test_exchanges_lower_the_criterion_and_keep_the_strata(n: int, d: int, power: int) -> None:
    drawn = [LatinMaximin(power, steps)(n, d, np.random.default_rng(3)) for steps in (0, 1, 4)]
    for x in drawn:
        assert np.array_equal(np.sort(np.floor(x * n), axis=0), np.repeat(np.arange(n)[:, None], d, axis=1))
    assert phi(drawn[2], power) <= phi(drawn[1], power) < phi(drawn[0], power)


def test_four_points_reach_the_optimum() -> None:
    """Of all Latin squares of 5 points the lattice of (1, 2) has the greatest least distance, sqrt(5)/5."""
    x = LatinMaximin()(5, 2, np.random.default_rng(0))
    distance = toroidal_distance(x[:, None], x[None])
    np.fill_diagonal(distance, 1)
    assert distance.min() == pytest.approx(np.sqrt(5) / 5)


def test_settings_out_of_range_are_refused() -> None:
    for settings in ({"power": 1}, {"power": 101}, {"steps": -1}, {"steps": float("inf")}):
        with pytest.raises(InputError, match=next(iter(settings))):
            LatinMaximin(**settings)  # type: ignore[arg-type]
    assert len(CorrelatedMultiJitter(1e308)(9, 2, np.random.default_rng(1))) == 9
    with pytest.raises(InputError, match="aspect"):
        CorrelatedMultiJitter(0)
