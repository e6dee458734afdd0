"""Quality of projections: against whole measures, random points, and the noise that rounding must add."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.measures import measures
from gbnbench.analysis.radial.projection_quality import (
    projection_quality,
    qualities,
    random_min_distance,
    renderers_projections,
)
from gbnbench.core.errors import InputError
from gbnbench.core.torus import displacement
from gbnbench.generators.registry import generate
from gbnbench.io.exports.number_types import fractions, rounded


def test_whole_sets_have_the_noise_floor_of_all_measures():
    x = generate("jittered", n=256, realizations=3, seed=2)
    found, whole = projection_quality(x, (0, 1)), measures(x)
    assert found.noise_floor == pytest.approx(whole["noise_floor"], rel=1e-9)
    assert found.power_at_1 == pytest.approx(whole["power_at_1"], rel=1e-9)


@pytest.mark.parametrize("axes", [(0,), (2, 0), (0, 1, 2)])
def test_distances_are_those_of_all_pairs(axes):
    x = np.random.default_rng(5).random((2, 60, 3))
    between = np.abs(displacement(x[:, :, None], x[:, None]))[..., list(axes)]
    lengths = np.sqrt((between**2).sum(-1)) + np.eye(60) * 9
    found = projection_quality(x, axes)
    assert found.min_distance == pytest.approx(lengths.min(axis=(1, 2)).mean(), rel=1e-9)
    assert found.over_random == pytest.approx(found.min_distance / random_min_distance(60, len(axes)))


@pytest.mark.parametrize("m", [1, 2, 3])
def test_random_points_are_as_far_apart_as_expected(m):
    x = np.random.default_rng(m).random((400, 80, m))
    found = projection_quality(x, tuple(range(m)))
    spread = math.sqrt(math.gamma(1 + 2 / m) / math.gamma(1 + 1 / m) ** 2 - 1)  # of a Weibull distribution
    assert found.over_random == pytest.approx(1, abs=4 * spread / 20 + 2 / 80)
    assert found.noise_floor == pytest.approx(1, abs=0.1)


@pytest.mark.parametrize(("number_type", "variance"), [("float32", 4.0**-23 / 84), ("uint32", 2.0**-64 / 12)])
def test_rounding_adds_the_power_of_its_errors(number_type, variance):
    """P gains (2 pi |f|)^2 var; errors of float32 have 4^-23 / 84, ulps being 2^-23-k from 2^-k to 2^1-k."""
    x = generate("stealthy", n=256, realizations=2)
    band = [a * a + b * b for a in range(-4, 5) for b in range(-4, 5) if 0 < a * a + b * b <= 16]
    expected = 4 * math.pi**2 * float(np.mean(band)) * variance
    assert projection_quality(x, (0, 1)).noise_floor < 1e-27
    found = projection_quality(fractions(rounded(x, number_type)), (0, 1)).noise_floor
    assert found == pytest.approx(expected, rel=0.4)  # 48 frequencies of two sets: 0.14 standard errors


def test_projections_on_a_box_have_its_sides():
    x = np.random.default_rng(9).random((1, 40, 3))
    found = projection_quality(x, (0, 1), sides=(4, 1, 1))
    between = np.abs(displacement(x[0][:, None], x[0]))[..., :2] * (2, 0.5)
    lengths = np.sqrt((between**2).sum(-1)) + np.eye(40) * 9
    assert found.min_distance == pytest.approx(lengths.min(), rel=1e-9)


def test_points_that_coincide_and_single_ones():
    column = np.array([[0.25, 0.1], [0.25, 0.6], [0.75, 0.1]])
    assert projection_quality(column, (0,)).over_random == 0
    assert math.isnan(projection_quality([[0.3, 0.4]], (0, 1)).min_distance)


def test_the_projections_of_renderers():
    assert renderers_projections(2) == ()
    assert renderers_projections(3) == ((0,), (1,), (2,), (0, 1), (0, 2), (1, 2))
    assert len(renderers_projections(16)) == 16 + 120
    assert renderers_projections(20)[20:] == tuple((a, a + 1) for a in range(0, 20, 2))


def test_progress_and_wrong_axes():
    told = []
    x = np.random.default_rng(0).random((30, 3))
    found = qualities(x, [(0,), (1, 2)], progress=lambda *step: told.append(step))
    assert [one.axes for one in found] == [(0,), (1, 2)]
    assert told[-1] == (2, 2, "projections")
    for axes in ((), (0, 0), (3,)):
        with pytest.raises(InputError, match="some of the coordinates 0 to 2, each once"):
            projection_quality(x, axes)
