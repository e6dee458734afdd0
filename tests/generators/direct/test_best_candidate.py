"""Best candidates: bounds that hold, and the distribution of plain best candidates."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.errors import InputError
from gbnbench.core.torus import toroidal_distance
from gbnbench.generators.direct.best_candidate import BestCandidate, Bounds, Nearest


@pytest.mark.parametrize("d", [1, 2, 3])
def test_bounds_are_never_below_a_distance(d: int) -> None:
    rng = np.random.default_rng(d)
    points = Nearest(rng.random((40, d)))
    points.count = 20
    bounds = Bounds(points)
    for k in range(20, 40):
        bounds.lower(points.x[k])
    places = rng.random((2000, d))
    cell = np.ravel_multi_index(np.floor(places * bounds.side).astype(int).T, (bounds.side,) * d)
    distance = toroidal_distance(places[:, None], points.x[None]).min(axis=1)
    assert np.all(distance <= bounds.high[cell])
    points.count = 40
    assert np.allclose(points.distances(places), distance, rtol=1e-12, atol=0)


@pytest.mark.parametrize("aim", [None, 0.3, 0.2, 0.12])
@pytest.mark.parametrize("count", [3, 40, 400])
def test_the_best_is_distributed_as_that_of_all_candidates(count: int, aim: float | None) -> None:
    """Whatever distance is aimed at first; the largest there is is 0.23."""
    rng = np.random.default_rng(9)
    points = Nearest(rng.random((30, 2)))
    points.count = 30
    bounds = Bounds(points)
    ours = []
    for _ in range(600):
        bounds.last = aim or bounds.last
        ours.append(float(points.distances(bounds.best(count, rng)[None])[0]))
    plain = points.distances(rng.random((600 * count, 2))).reshape(600, count).max(axis=1)
    from scipy.stats import ks_2samp

    assert ks_2samp(ours, plain).pvalue > 1e-3


def test_the_least_distance_rises_with_the_candidates() -> None:
    def least(candidates: int) -> float:
        x = BestCandidate(candidates=candidates)(150, 2, np.random.default_rng(1))
        distance = toroidal_distance(x[:, None], x[None])
        np.fill_diagonal(distance, 1)
        return float(distance.min())

    assert least(30) > least(1) > 0.3 / np.sqrt(150)


@pytest.mark.parametrize("candidates", [0, 10**9])
def test_candidates_out_of_range_are_refused(candidates: int) -> None:
    with pytest.raises(InputError, match="candidates"):
        BestCandidate(candidates)


def test_the_most_points_fall_with_the_candidates() -> None:
    assert "nearest is 4096" in str(BestCandidate().refusal(5000, 5))
    assert "nearest is 409" in str(BestCandidate(100).refusal(5000, 5))
    assert "nearest is 6553" in str(BestCandidate(100).refusal(65_536, 2))
