"""The density profile near the faces of the box, against closed forms."""

from __future__ import annotations

import itertools
from fractions import Fraction

import numpy as np
import pytest

from gbnbench.analysis.spatial.edge_density import edge_density
from gbnbench.core.errors import InputError


@pytest.mark.parametrize(("n", "d"), [(100, 1), (400, 2), (200, 3), (50, 8)])
def test_uniform_points_have_density_one_to_the_centre(n, d):
    profile = edge_density(np.random.default_rng(d).random((200, n, d)), width=0.5)
    assert np.all(np.abs(profile.density - 1) < 5 * profile.standard_error + 1e-12)
    assert profile.edges[-1] == pytest.approx(min(8.0, n ** (1 / d) / 2))
    if profile.edges[-1] < 8:
        assert profile.cumulative[-1] == pytest.approx(1)


def test_uniform_points_come_as_near_to_a_face_as_the_least_of_n():
    """The least of n uniform numbers is 1 / (n + 1) in the mean, n^(1/2) / (n + 1) spacings."""
    profile = edge_density(np.random.default_rng(0).random((2000, 64, 2)))
    assert profile.extreme == pytest.approx(8 / 65, abs=5 * profile.extreme_error)


def test_a_grid_counts_whole_rows():
    x = (np.stack(np.meshgrid(*[np.arange(10)] * 2, indexing="ij"), -1).reshape(-1, 2) + 0.5) / 10
    profile = edge_density(x, width=1.0)
    assert profile.density == pytest.approx(np.ones(5))
    half = edge_density(x + 1e-9, width=0.4)
    assert half.density[0] == 0
    assert half.density[1] == pytest.approx(36 / 100 / (0.92**2 - 0.84**2))
    assert profile.extreme == pytest.approx(0.5)
    assert np.isnan(profile.extreme_error)
    assert list(profile.to_frame().columns) == ["low", "high", "density", "standard_error", "cumulative"]


@pytest.mark.parametrize(("n", "width"), [(32, 0.25), (49, 0.25), (96, 0.1), (100, 0.3)])
def test_rows_of_a_grid_at_edges_of_bins_count_beyond_them(n, width):
    """Of k/n on the line one point has depth 0, and two each have depth 1, 2, ... spacings."""
    profile = edge_density(np.arange(n)[:, None] / n, width=width, depth=8.0)
    edges = [Fraction(k) * Fraction(str(width)) for k in range(len(profile.edges) - 1)] + [Fraction(8)]
    expected = [
        sum((1 if k == 0 else 2) for k in range(9) if a <= k < b) for a, b in itertools.pairwise(edges)
    ]
    assert profile.density * 2 * np.diff(profile.edges) == pytest.approx(expected)


def test_the_last_bin_holds_the_centre():
    profile = edge_density(np.array([[0.0], [0.25], [0.5], [0.75]]), width=1.0)
    assert profile.density * 2 * np.diff(profile.edges) == pytest.approx([1, 3])


@pytest.mark.parametrize(("n", "d"), [(100_000, 1), (40_000, 2), (5_000, 3)])
def test_thin_shells_of_many_points_have_exact_volumes(n, d):
    x = np.random.default_rng(n).random((n, d))
    profile = edge_density(x, width=1e-3, depth=4e-3)
    side = n ** (1 / d)
    cuts = [1 - Fraction(2 * edge / side) for edge in profile.edges.tolist()]
    volumes = [float(a**d - b**d) for a, b in itertools.pairwise(cuts)]
    depth = np.minimum(x, 1 - x).min(axis=1) * side
    counts = np.histogram(depth, profile.edges)[0]
    assert profile.density == pytest.approx(counts / n / volumes, rel=1e-11)


@pytest.mark.parametrize(("width", "depth"), [(0, 1), (2, 1), (1, np.inf), (-1, 2)])
def test_bins_out_of_order_are_refused(width, depth):
    with pytest.raises(InputError, match="0 < width <= depth"):
        edge_density(np.zeros((1, 2)), width, depth)
