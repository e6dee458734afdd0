"""Sample elimination: its order against weights summed anew, and progressive prefixes."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.errors import InputError
from gbnbench.core.torus import toroidal_distance
from gbnbench.generators.direct.sample_elimination import SampleElimination, largest_radius
from gbnbench.generators.registry import generate


@pytest.mark.parametrize(("n", "d"), [(30, 1), (40, 2), (30, 3), (12, 4)])
def test_every_removed_point_is_the_heaviest_of_those_left(n: int, d: int) -> None:
    """Weights are summed anew at every step; two points that are each other's only ones weigh the same."""
    x = np.random.default_rng(5).random((4 * n, d))
    kept, removed = SampleElimination().eliminate(x, n)
    reach = 2 * largest_radius(n, d)
    least = reach * (1 - 0.25**1.5) * 0.65
    distance = np.maximum(toroidal_distance(x[:, None], x[None]), least)
    share = np.maximum(1 - distance / reach, 0) ** 8
    np.fill_diagonal(share, 0)
    left = list(range(4 * n))
    for heaviest in removed:
        weight = share[np.ix_(left, left)].sum(axis=1)
        assert weight[left.index(heaviest)] >= weight.max() * (1 - 1e-9) - 1e-15
        left.remove(heaviest)
    assert left == kept.tolist()


def test_largest_radii_are_those_of_the_densest_lattices() -> None:
    assert largest_radius(7, 2) == pytest.approx(np.sqrt(1 / (2 * np.sqrt(3) * 7)))
    assert largest_radius(7, 3) == pytest.approx((1 / (4 * np.sqrt(2) * 7)) ** (1 / 3))
    assert largest_radius(7, 1) == pytest.approx(1 / 14)


def test_halves_of_a_progressive_order_are_eliminations() -> None:
    x = generate("elimination[progressive=true]", n=128, d=2, seed=2)
    plain = generate("elimination", n=128, d=2, seed=2)
    assert np.array_equal(np.unique(x, axis=0), np.unique(plain, axis=0))
    for n in (64, 32, 16):
        kept, _ = SampleElimination().eliminate(x[: 2 * n], n)
        assert np.array_equal(np.sort(kept), np.arange(n))


@pytest.mark.parametrize(
    "settings",
    [
        *({"inputs": 1}, {"alpha": 0}, {"beta": 1.1}, {"gamma": -1}, {"beta": float("nan")}),
        *({"inputs": 1e6}, {"alpha": float("inf")}, {"gamma": float("inf")}),
    ],
)
def test_settings_out_of_range_are_refused(settings: dict[str, float]) -> None:
    with pytest.raises(InputError, match=next(iter(settings))):
        SampleElimination(**settings)


def test_most_points_are_those_whose_pairs_fit_memory() -> None:
    """Ten million pairs at some 300 bytes each."""
    for d in (2, 6, 12):
        reason = str(SampleElimination().refusal(10**7, d))
        n = int(reason.rsplit(" ", 1)[1])
        assert SampleElimination().refusal(n, d) is None
        assert n > 890
    assert SampleElimination().refusal(16_384, 2) is None
