"""Pair correlation and nearest neighbours against plain loops and closed forms."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.window.box import check_window
from gbnbench.analysis.window.estimates import in_window
from gbnbench.analysis.window.nearest_neighbours import nearest_distances
from gbnbench.analysis.window.pair_correlation import seen_density


def test_pair_correlation_against_a_loop_over_pairs():
    sides = np.array([3.0, 2.0])
    x = np.random.default_rng(0).random((80, 2)) * sides
    found = in_window(x, 0, sides)
    table = found.pair_correlation
    width = table["r"].iloc[1] - table["r"].iloc[0]
    sums, counts = np.zeros(len(table)), np.zeros(len(table), int)
    for i in range(80):
        for j in range(80):
            label = int(math.dist(x[i], x[j]) / width)
            if i != j and label < len(table):
                sums[label] += 1 / np.prod(sides - np.abs(x[i] - x[j]))
                counts[label] += 1
    edges = width * np.arange(len(table) + 1)
    plain = 36 / (80 * 79 * math.pi * np.diff(edges**2)) * sums
    seen = [seen_density(x, found.window, r) for r in table["r"]]
    assert (table["pairs"] * 2 == counts).all()
    np.testing.assert_allclose(table["g"], plain / np.array(seen) ** 2, rtol=0.02)  # between 13 radii


def test_seen_density_against_points_on_circles():
    sides = np.array([3.0, 2.0])
    x = np.random.default_rng(1).random((200, 2)) * sides
    angle = 2 * math.pi * np.arange(5000) / 5000
    w = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    r = 0.7
    total = 0.0
    for point in x:
        moved = point + r * w
        inside = ((moved >= 0) & (moved <= sides)).all(axis=1)
        total += (inside * 6 / np.prod(sides - r * np.abs(w), axis=1)).mean()
    window = check_window(x, 0, sides)[1]
    assert seen_density(x, window, r) == pytest.approx(total / 200, rel=2e-3)


def test_nearest_distances_against_a_loop():
    sides = np.array([3.0, 2.0])
    x = np.random.default_rng(2).random((60, 2)) * sides
    found = nearest_distances(*check_window(x, 0, sides))
    weights, distances = [], []
    for i in range(60):
        d = min(math.dist(x[i], x[j]) for j in range(60) if j != i)
        if d < min(*x[i], *(sides - x[i])):
            distances.append(d)
            weights.append(1 / np.prod(sides - 2 * d))
    mean = np.dot(weights, distances) / sum(weights)
    assert found.mean == pytest.approx(mean, rel=1e-12)
    half = sum(w for w, d in zip(weights, distances, strict=True) if d <= mean) / sum(weights)
    assert found.distribution(np.array([0.0, mean, 9.0])) == pytest.approx([0.0, half, 1.0])
    assert found.smallest == min(math.dist(x[i], x[j]) for i in range(60) for j in range(i))


def test_hidden_neighbours_against_a_loop():
    """Kaplan and Meier: of the points seen up to a distance, those whose neighbour is farther, multiplied."""
    sides = np.array([25.0, 1.0])
    x = np.random.default_rng(1).random((25, 2)) * sides
    met, lost = [], []
    for i in range(25):
        d = min(math.dist(x[i], x[j]) for j in range(25) if j != i)
        b = min(*x[i], *(sides - x[i]))
        (met if d < b else lost).append(min(d, b))
    share, variance = 1.0, 0.0
    for d in set(met):  # of two points that are one another's neighbours
        left, here = sum(at >= d for at in met + lost), met.count(d)
        share *= 1 - here / left
        variance += here / (left * (left - here))
    found = nearest_distances(*check_window(x, 0, sides))
    assert (found.hidden, found.hidden_error) == pytest.approx((share, share * variance**0.5))
    assert 0 < found.hidden < 1


@pytest.mark.parametrize(("sides", "known"), [((300, 1), False), ((300, 4), True), ((30, 30, 1.2), False)])
def test_a_window_too_narrow_for_the_nearest_neighbours_says_so(sides, known):
    sides = np.array(sides, float)
    x = np.random.default_rng(6).random((int(sides.prod()), len(sides))) * sides
    scalars = in_window(x, 0, sides, nu_max=1).scalars
    assert np.isfinite(scalars["mean_distance"]) == known
    assert ("a wider window is needed" in scalars.reasons.get("mean_distance", "")) != known
    assert np.isfinite(scalars["min_distance"])


def test_coincident_points_have_distance_zero():
    x = np.repeat(np.random.default_rng(3).random((20, 2)), 2, axis=0)
    found = in_window(x, 0, 1)
    assert found.scalars["mean_distance"] == 0 == found.scalars["min_distance"]
    assert np.isfinite(found.structure_factor["S"]).all()


@pytest.mark.parametrize("d", [1, 2, 3])
def test_poisson_points_have_g_one_and_the_known_mean_distance(d):
    ball = math.pi ** (d / 2) / math.gamma(d / 2 + 1)
    n = 1000
    found = in_window(np.random.default_rng(4).random((n, d)), 0, 1, nu_max=1)
    truth = math.gamma(1 + 1 / d) / (ball * n) ** (1 / d)
    z = (found.scalars["mean_distance"] - truth) / found.scalars.standard_error["mean_distance"]
    assert abs(z) < 3.5
    table = found.pair_correlation[found.pair_correlation["pairs"] >= 10]
    scores = (table["g"] - 1) / table["standard_error"]
    assert abs(scores.mean()) < 0.6
    assert 0.5 < (scores**2).mean() < 1.8


@pytest.mark.filterwarnings("error")
def test_a_lone_point_on_the_axis_of_the_window_has_no_weight():
    """Its border, half the shortest side, leaves no window within, whose volume it was divided by."""
    points = np.array([[0.5, 50.0], *[[0.5, 1 + 0.1 * k] for k in range(19)]])
    found = nearest_distances(*check_window(points, 0, [1, 100]))
    assert len(found.distance) == 19
    assert found.mean == pytest.approx(0.1)
