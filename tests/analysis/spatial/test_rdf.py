"""Pair counts and the radial distribution function against loops, trees and exact integers."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial import cKDTree

from gbnbench.analysis.precision import double_device
from gbnbench.analysis.spatial.pair_counts import _numpy_counts, pair_counts
from gbnbench.analysis.spatial.pair_counts_device import device_counts, row_windows
from gbnbench.analysis.spatial.rdf import curve_bins, pair_density, rdf
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import wrap
from tests.oracles.lattices import grid


def all_distances(x: np.ndarray) -> np.ndarray:
    i, j = np.triu_indices(len(x), 1)
    gap = np.abs(x[i] - x[j])
    return np.sqrt((np.minimum(gap, 1 - gap) ** 2).sum(axis=1))


@pytest.mark.parametrize("reach", [0.5, 0.4999, 1 / 3, 0.25, 0.1, 0.013])
@pytest.mark.parametrize(("n", "d"), [(2, 2), (7, 1), (700, 1), (3, 2), (600, 2), (300, 3), (200, 6)])
def test_counts_every_pair_once(n: int, d: int, reach: float) -> None:
    x = np.random.default_rng(n + d).random((n, d))
    expected = np.histogram(all_distances(x), bins=50, range=(0, reach))[0]
    np.testing.assert_array_equal(pair_counts(x, 50, reach / 50), expected)


@pytest.mark.parametrize("d", [1, 2, 3])
def test_many_points_against_a_tree(d: int) -> None:
    x = np.random.default_rng(d).random((5000, d)) ** 2  # denser in a corner
    edges = np.linspace(0, 0.05, 21)
    tree = cKDTree(x, boxsize=1.0)
    cumulative = (tree.count_neighbors(tree, edges) - len(x)) // 2
    np.testing.assert_array_equal(pair_counts(x, 20, 0.05 / 20), np.diff(np.r_[0, cumulative[1:]]))


@pytest.mark.parametrize("reach", [0.3, 0.25, 0.2, 0.013, 1e-6])
@pytest.mark.parametrize("d", [2, 3, 6])
@pytest.mark.parametrize("kind", ["random", "corner", "grid", "coincident", "border"])
def test_the_device_counts_what_numpy_does(kind: str, d: int, reach: float) -> None:
    rng = np.random.default_rng(d)
    x = {
        "random": rng.random((700, d)),
        "corner": rng.random((700, d)) ** 4,
        "grid": wrap(grid({2: 26, 3: 9, 6: 3}[d], d) + 0.123),
        "coincident": np.repeat(rng.random((7, d)), 100, axis=0),
        "border": rng.choice([0.0, 2.0**-60, 1 - 2.0**-53, 0.5, 1 / 9], (700, d)),
    }[kind]
    device = double_device()
    if device is None:
        pytest.skip("no device computes in double here")
    for box in ((1.0,) * d, (1.25, *(1.0,) * (d - 2), 0.8)):
        for together in (1 << 20, 150):  # points whose windows are found together
            windows = row_windows(x, reach, box, together)
            assert windows is not None
            each = [device_counts(device, some, 41, 41 / reach, box) for some in windows if len(some.rows)]
            expected = _numpy_counts(x, 41, reach, 41 / reach, box)
            assert np.sum(each, axis=0).tolist() == expected.tolist()


def test_windows_hold_few_pairs_that_are_too_far() -> None:
    x = np.random.default_rng(5).random((5000, 2))
    found = row_windows(x, 0.25, (1.0, 1.0))
    assert found is not None
    (windows,) = found
    met = int((windows.ends[1::2] - windows.ends[::2]).sum(dtype=np.int64))
    assert 1 < met / (5000**2 / 2 * math.pi / 16) < 1.25


@pytest.mark.parametrize(("d", "reach"), [(1, 0.1), (2, 0.49)])
def test_no_windows_where_nothing_can_be_cut(d: int, reach: float) -> None:
    assert row_windows(np.random.default_rng(6).random((600, d)), reach, (1.0,) * d) is None


def test_grid_has_its_shells() -> None:
    # d = 1/16 at 4 neighbours, sqrt(2)/16 at 4, 2/16 at 4, sqrt(5)/16 at 8: half as many pairs a point
    counts = pair_counts(grid(16, 2), 400, 0.15 / 400)
    at = {int(r / 16 * 400 / 0.15): k for r, k in ((1, 2), (2**0.5, 2), (2, 2), (5**0.5, 4))}
    assert {i: c / 256 for i, c in enumerate(counts) if c} == at


def test_bins_are_those_of_psa() -> None:
    n = 1000
    x = np.random.default_rng(1).random((n, 2))
    made = rdf(x)
    hexagonal = math.sqrt(2 / (math.sqrt(3) * n))
    bins, width = int(0.125 * n), 8 * hexagonal / int(0.125 * n)
    counts = np.bincount((all_distances(x) / width).astype(int), minlength=bins)[:bins]
    scale = n * (n - 1) / 2 * math.pi * width**2
    np.testing.assert_allclose(made.g, counts / (scale * (2 * np.arange(bins) + 1)), rtol=1e-12)
    np.testing.assert_allclose(made.r, np.arange(bins) * width / hexagonal, rtol=1e-12)


@pytest.mark.parametrize("d", [1, 2, 3, 5])
def test_random_points_have_no_structure(d: int) -> None:
    n, sets = 800, 4
    made = rdf(np.random.default_rng(d).random((sets, n, d)))
    assert made.g_by_set.shape == (sets, len(made.r))
    np.testing.assert_allclose(made.g, made.g_by_set.mean(axis=0))
    width = made.r[1] * (1 if d == 1 else {2: (4 / 3) ** 0.25, 3: 2 ** (1 / 6), 5: 8**0.1}[d]) * n ** (-1 / d)
    volume = math.pi ** (d / 2) / math.gamma(d / 2 + 1) * np.diff((np.arange(len(made.r) + 1) * width) ** d)
    expected = sets * n * (n - 1) / 2 * volume
    enough = expected > 10
    assert enough.sum() > 5
    assert np.abs((made.g - 1) * np.sqrt(expected))[enough].max() < 4.5
    assert np.average(made.g, weights=expected) == pytest.approx(1, abs=5 / math.sqrt(expected.sum()))


@pytest.mark.parametrize(("n", "d"), [(40, 2), (100, 2), (296, 2), (1024, 3), (1024, 8)])
def test_stays_where_balls_fit_the_torus(n: int, d: int) -> None:
    made = rdf(np.random.default_rng(n).random((n, d)))
    hermite = {2: 4 / 3, 3: 2, 8: 256}[d] ** (1 / d)
    unit = hermite**0.5 * n ** (-1 / d)
    width = 8 * unit / int(0.125 * n)
    assert len(made.r) * width <= 0.5 + 1e-12
    assert (len(made.r) + 1) * width > 0.5 or len(made.r) == int(0.125 * n)


def test_frame() -> None:
    assert list(rdf(np.random.default_rng(2).random((100, 2))).to_frame().columns) == ["r", "g"]


def test_refusals() -> None:
    rng = np.random.default_rng(3)
    with pytest.raises(RefusalError, match="d=9"):
        rdf(rng.random((100, 9)))
    for n in (1, 7, 26):
        with pytest.raises(RefusalError, match=f"n={n}"):
            rdf(rng.random((n, 2)))
    with pytest.raises(InputError, match="bins must end"):
        pair_counts(rng.random((10, 2)), 10, 0.06)


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 2**32 - 1), st.integers(2, 120), st.integers(1, 4), st.floats(0.01, 0.5))
def test_counts_do_not_know_the_origin_or_the_order(seed: int, n: int, d: int, reach: float) -> None:
    rng = np.random.default_rng(seed)
    x = rng.random((n, d))
    y = wrap(x + rng.random(d))[rng.permutation(n)]
    one, two = pair_counts(x, 9, reach / 9), pair_counts(y, 9, reach / 9)
    assert np.abs(np.cumsum(one) - np.cumsum(two)).max() <= 1  # a distance may round across an edge
    assert abs(one.sum() - np.sum(all_distances(x) < reach)) <= 1


@pytest.mark.parametrize("m", [30, 64, 100])
def test_a_grid_s_distances_are_edges_whatever_its_coordinates_round_to(m: int) -> None:
    """PSA's bins are 1 / (200 m) wide: a grid's distances along the axes are edges."""
    for x in (grid(m, 2), wrap(grid(m, 2) + 0.123)):
        counts = pair_counts(x, 800, 1 / (200 * m))
        assert counts[[199, 200, 399, 400, 599, 600]].tolist() == [0, 2 * m * m] * 3


@pytest.mark.parametrize("d", [1, 2, 3, 8])
def test_expected_pairs_against_exact_integers(d: int) -> None:
    n, bins, width = 3000, 2000, 2.0**-13
    x = np.random.default_rng(d).random((n, d))
    counts = pair_counts(x, bins, width)
    ball = math.pi ** (d / 2) / math.gamma(d / 2 + 1) * width**d
    expected = [n * (n - 1) / 2 * ball * ((i + 1) ** d - i**d) for i in range(bins)]
    np.testing.assert_allclose(pair_density(x[None], bins, width)[0], counts / expected, rtol=1e-14)


def test_a_distance_that_is_exactly_an_edge_begins_its_bin():
    m = 32  # pairs along the axes stand 1/32 = 200/6400 apart, exactly
    x = np.stack(np.meshgrid(*[np.arange(m) / m] * 2), axis=-1).reshape(-1, 2)
    counts = pair_counts(x, 1601, 0.5 / 3200)
    assert counts[200] == 2 * m * m
    assert counts[199] == 0


@pytest.mark.parametrize("reach", [2.0, 4.0, 8.0])
def test_no_farther_than_was_asked_for(reach: float) -> None:
    x = np.random.default_rng(8).random((2, 4000, 2))
    whole, some, told = rdf(x), rdf(x, reach=reach), rdf(x, reach=reach, bins=int(500 * reach / 8))
    for found in (some, told):
        assert len(found.r) == 500 * reach / 8
        np.testing.assert_allclose(found.g, whole.g[: len(found.g)], rtol=1e-9)


@pytest.mark.parametrize(
    ("options", "said"),
    [({"reach": 0}, "reach must be a positive"), ({"bins": 0}, "bins must be a whole number")],
)
def test_ranges_that_are_none_are_refused(options: dict, said: str) -> None:
    with pytest.raises(InputError, match=said):
        rdf(np.random.default_rng(9).random((50, 2)), **options)


def test_few_points_have_bins_that_show_peaks_and_the_others_those_of_psa() -> None:
    assert [curve_bins(n) for n in (7, 8, 64, 639, 640, 100_000)] == [None, 80, 80, 80, None, None]
