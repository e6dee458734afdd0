"""Histograms of Delaunay valences: lattices, the known means of random points, and averages over sets."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.spatial.delaunay import neighbours
from gbnbench.analysis.spatial.valence import valence, valence6
from gbnbench.core.errors import RefusalError
from tests.oracles.lattices import hexagonal
from tests.published_sets import published


def test_hexagonal_lattice_has_valence_six() -> None:
    histogram = valence(hexagonal(26, 15))
    assert histogram.degree.tolist() == [6]
    assert histogram.share.tolist() == [1.0]
    assert valence6(hexagonal(26, 15)).tolist() == [1.0]


def test_random_points_have_the_known_mean_degrees() -> None:
    rng = np.random.default_rng(4)
    plane = valence(rng.random((6, 1500, 2)))
    assert plane.share @ plane.degree == pytest.approx(6, abs=1e-12)
    assert plane.of(6).mean() == pytest.approx(0.2947, abs=0.015)  # Calka 2003
    space = valence(rng.random((1500, 3)))
    assert space.share @ space.degree == pytest.approx(48 * math.pi**2 / 35 + 2, abs=0.2)  # Meijering 1953


def test_histogram_averages_the_sets() -> None:
    x = np.random.default_rng(5).random((3, 60, 2))
    made = valence(x)
    np.testing.assert_allclose(made.share, made.share_by_set.mean(axis=0))
    np.testing.assert_allclose(made.share_by_set.sum(axis=1), 1)
    for k, points in enumerate(x):
        degrees = neighbours(points)[0].degree
        for degree in range(3, 12):
            assert made.of(degree)[k] == np.mean(degrees == degree)
    assert list(made.to_frame().columns) == ["degree", "share"]
    np.testing.assert_array_equal(valence(neighbours(x)).share, made.share)


def test_authors_set_is_mostly_six_valent() -> None:
    share = valence6(published("gbn-1024/official-10k-f32-1.txt"))
    assert 0.5 < share[0] < 0.7


def test_the_share_of_six_is_of_the_plane() -> None:
    with pytest.raises(RefusalError, match="d=3"):
        valence6(np.random.default_rng(7).random((50, 3)))
