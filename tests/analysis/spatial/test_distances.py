"""Nearest distances on the torus against loops, lattices and exact differences."""

from __future__ import annotations

import itertools
import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gbnbench.analysis.spatial.distances import mean_distance, min_distance, nearest_distances
from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import wrap
from tests.oracles.lattices import grid, hexagonal
from tests.published_sets import published


def even(d: int) -> np.ndarray:
    """Corners of the unit cube with an even sum."""
    corners = np.array(list(itertools.product((0, 1), repeat=d)))
    return corners[corners.sum(axis=1) % 2 == 0]


@pytest.mark.parametrize(("n", "d"), [(2, 1), (30, 1), (200, 2), (150, 3), (90, 5), (60, 8)])
def test_against_loops(n: int, d: int) -> None:
    x = np.random.default_rng(n).random((2, n, d))
    hermite = {1: 1, 2: 4 / 3, 3: 2, 5: 8, 8: 256}[d] ** (1 / d)  # gamma_d^d is rational (Conway & Sloane)
    for k, points in enumerate(x):
        nearest = [
            min(
                sum(min(abs(a - b), 1 - abs(a - b)) ** 2 for a, b in zip(p, q, strict=True)) ** 0.5
                for j, q in enumerate(points)
                if j != i
            )
            for i, p in enumerate(points)
        ]
        unit = hermite**0.5 * n ** (-1 / d)
        assert min_distance(x)[k] == pytest.approx(min(nearest) / unit, rel=1e-12, abs=0)
        assert mean_distance(x)[k] == pytest.approx(np.mean(nearest) / unit, rel=1e-12, abs=0)


@pytest.mark.parametrize(
    "lattice",
    [
        grid(17, 1),
        np.concatenate([grid(3, 3) + np.array(s) / 6 for s in ((0, 0, 0), (1, 1, 0), (1, 0, 1), (0, 1, 1))]),
        even(4) / 2,
        even(5) / 2,
        np.concatenate([even(8) / 2, even(8) / 2 + 0.25]),
    ],
    ids=["Z", "A3", "D4", "D5", "E8"],
)
def test_densest_lattices_measure_one(lattice: np.ndarray) -> None:
    x = wrap(lattice + 0.01)
    np.testing.assert_allclose(nearest_distances(x), 1, rtol=1e-12)


def test_points_that_nearly_meet_across_the_border_keep_their_distance() -> None:
    """1 - 3 u and 1e-17 are 3.4e-16 apart, of which the difference of the two has 3 quarters left."""
    rng = np.random.default_rng(5)
    last = 1 - 3 * 2.0**-53
    x = np.concatenate([[[last, 0.5], [1e-17, 0.5]], 0.1 + 0.3 * rng.random((30, 2))])
    exact = float(Fraction(1) - Fraction(last) + Fraction(1e-17))
    unit = math.sqrt(2 / math.sqrt(3) / 32)
    np.testing.assert_allclose(nearest_distances(x)[0, :2] * unit, exact, rtol=1e-14)
    assert min_distance(x)[0] * unit == pytest.approx(exact, rel=1e-14, abs=0)


def test_the_nearest_of_several_across_the_border_is_found() -> None:
    """The tree holds the last three of these at equal distance from the first."""
    x = np.array([[0.0], [1 - 2.0**-53], [1e-17], [3e-18], [2e-17], [0.5]])
    nearest = nearest_distances(x)[0] / 6
    assert nearest[0] == pytest.approx(3e-18, rel=1e-12, abs=0)
    assert nearest[1] == pytest.approx(2.0**-53, rel=1e-12, abs=0)
    assert nearest[2] == pytest.approx(7e-18, rel=1e-12, abs=0)


@pytest.mark.parametrize("count", [20, 300])
def test_the_nearest_of_many_that_the_tree_holds_equally_far_is_found(count: int) -> None:
    """Points k 1e-18 from the border are one to the tree, as the last sees them."""
    for order in (np.arange(count), np.arange(count)[::-1], np.random.default_rng(1).permutation(count)):
        last = [1 - 2.0**-53, 0.0]
        x = np.concatenate([np.stack([order * 1e-18, np.zeros(count)], axis=1), [last]])
        unit = math.sqrt(2 / math.sqrt(3) / (count + 1))
        nearest = nearest_distances(x)[0] * unit
        assert nearest[-1] == pytest.approx(2.0**-53, rel=1e-12, abs=0)
        places = [Fraction(value) for value in sorted(x[:-1, 0].tolist())]
        gaps = [float(b - a) for a, b in itertools.pairwise(places)]
        exact = [min(pair) for pair in zip([math.inf, *gaps], [*gaps, math.inf], strict=True)]
        np.testing.assert_allclose(nearest[:-1][np.argsort(order)], exact, rtol=1e-12)


def test_coincident_points_are_at_distance_zero() -> None:
    x = np.array([[0.25, 0.5]] * 20 + [[0.75, 0.5]])
    assert nearest_distances(x)[0, :20].max() == 0
    assert nearest_distances(x)[0, 20] * math.sqrt(2 / math.sqrt(3) / 21) == pytest.approx(0.5)


@pytest.mark.parametrize("n", [10_007, 100_003])
def test_a_large_lattice_has_the_distance_of_its_shortest_vector(n: int) -> None:
    g = round(n * (math.sqrt(5) - 1) / 2)
    x = np.stack([np.arange(n), np.arange(n) * g % n], axis=1) / n
    steps = np.arange(1, n, dtype=np.int64)
    other = steps * g % n
    shortest = int((np.minimum(steps, n - steps) ** 2 + np.minimum(other, n - other) ** 2).min())
    expected = math.sqrt(shortest) / n / math.sqrt(2 / math.sqrt(3) / n)
    np.testing.assert_allclose(nearest_distances(x), expected, rtol=1e-12)


def test_hexagonal_lattice_measures_nearly_one() -> None:
    x = hexagonal(26, 15)  # strained by 7e-4
    assert min_distance(x)[0] == pytest.approx(1, abs=1e-3)
    assert mean_distance(x)[0] == pytest.approx(1, abs=1e-3)


def test_random_points_in_the_plane() -> None:
    # mean nearest distance of a Poisson process is 1/(2 sqrt(n)), over d_hex = sqrt(2/(sqrt(3) n))
    expected = 0.5 / (2 / 3**0.5) ** 0.5
    assert mean_distance(np.random.default_rng(1).random((8, 1024, 2))).mean() == pytest.approx(
        expected, abs=0.01
    )


@pytest.mark.parametrize(
    ("name", "least", "mean"),
    [("bnot-1024/bnot-1.txt", "0.742", "0.872"), ("step-1024/step-1.txt", "0.23", "0.65")],
)
def test_figures_of_psa(name: str, least: str, mean: str) -> None:
    x = published(name)
    for value, figure in ((min_distance(x)[0], least), (mean_distance(x)[0], mean)):
        assert value == pytest.approx(float(figure), abs=0.51 * 10 ** -(len(figure) - 2))


def test_refusals() -> None:
    with pytest.raises(RefusalError, match="n >= 2"):
        min_distance([[0.1, 0.2]])
    with pytest.raises(RefusalError, match="d=25"):
        mean_distance(np.random.default_rng(2).random((5, 25)))


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 2**32 - 1), st.integers(2, 60), st.integers(1, 5))
def test_distances_do_not_know_the_origin_or_the_order(seed: int, n: int, d: int) -> None:
    rng = np.random.default_rng(seed)
    x = rng.random((n, d))
    order = rng.permutation(n)
    y = wrap(x + rng.random(d))[order]
    np.testing.assert_allclose(nearest_distances(y)[0], nearest_distances(x)[0][order], atol=1e-12)
