"""Published figures: each names a generator and a measure, and ours are measured of the sets."""

from __future__ import annotations

import math
from functools import cache

import numpy as np
import pytest

import gbnbench
from gbnbench.analysis.measure_definitions import BY_NAME
from gbnbench.analysis.measures import measures
from gbnbench.core.torus import FloatArray
from gbnbench.generators.registry import find, generate
from gbnbench.verification.published import PUBLISHED
from gbnbench.verification.published.bnot_radial_power import (
    PUBLISHED_POWER,
    PowerOverPublished,
    ring_power,
)
from gbnbench.verification.published.low_discrepancy import of_whole
from gbnbench.verification.published.set_figures import gain_in_integration, spread_of_voronoi_areas
from gbnbench.verification.published_figure import FIGURE, KINDS, SETS, THEORY, PublishedFigure
from gbnbench.verification.verify import Verified, verify
from gbnbench.verification.wording import agreeing, values
from tests.published_sets import published_files


@pytest.mark.parametrize("figure", PUBLISHED, ids=lambda f: f"{f.generator}-{f.measure_name}")
def test_a_figure_can_be_measured(figure: PublishedFigure) -> None:
    assert find(figure.generator).refusal(figure.n, figure.d) is None
    assert not isinstance(figure.measure, str) or figure.measure in BY_NAME
    assert figure.low < figure.high
    assert figure.published
    assert figure.reason
    assert figure.source
    assert figure.kind in KINDS
    assert (figure.kind == SETS) == figure.source.startswith("measured on ")
    assert not figure.whole or math.isclose(math.ceil(figure.low) - figure.low, 0.1)


def test_a_whole_number_that_one_of_four_sets_misses_does_not_agree() -> None:
    figure = PublishedFigure("sobol", first_coordinate, "0", *of_whole(0, 0), "none", "none", whole=True)
    assert Verified(figure, 0.0).agrees
    assert not Verified(figure, 0.25).agrees


@pytest.mark.parametrize(
    ("low", "high", "ours", "whole", "written"),
    [
        (0.712, 0.803, 0.7391, False, ("0.739", "0.712 to 0.803")),
        (1.81315e-3, 1.81335e-3, 1.81322e-3, False, ("0.00181322", "0.00181325 ± 1e-7")),
        (1 - 1e-9, 1 + 1e-9, 1.0, False, ("1", "1 ± 1e-9")),
        (-math.inf, 6e-3, 2.03e-12, False, ("2.03e-12", "at most 0.00600")),
        (1.0, math.inf, 279000.0, False, ("2.79e5", "at least 1.00")),
        (*of_whole(0, 0), 0.0, True, ("0", "exactly 0")),
        (*of_whole(2, 3), 2.25, True, ("2.25", "2 to 3")),
        (*of_whole(0, 1), math.nan, True, ("–", "0 to 1")),
    ],
)
def test_what_agrees_is_written_in_digits_that_tell(
    low: float, high: float, ours: float, whole: bool, written: tuple[str, str]
) -> None:
    figure = PublishedFigure("random", "noise_floor", "x", low, high, "none", "none", whole=whole)
    assert values(Verified(figure, ours)) == written


def test_counts_are_told_kind_by_kind() -> None:
    figures = [
        PublishedFigure("random", "noise_floor", "x", 0, 1, "none", "none", kind=kind)
        for kind in (THEORY, FIGURE, THEORY)
    ]
    found = [Verified(figure, ours) for figure, ours in zip(figures, (0.5, 0.5, 2.0), strict=True)]
    assert agreeing(found) == "Published figure: 1 of 1 agree; theory: 1 of 2 agree."


def first_coordinate(x: FloatArray) -> float:
    return float(x[0, 0])


def test_ours_are_the_measures_of_the_sets() -> None:
    sets = generate("random", n=16, d=2, seed=3, realizations=3)
    drawn: list[str] = []
    figures = [
        PublishedFigure("random", measure, "none", low, math.inf, "none", "none", n=16, sets=3, seed=3)
        for measure, low in (("power_at_1", -math.inf), (first_coordinate, 1.0))
    ]
    power, coordinate = verify(figures, drawn.append)
    assert drawn == ["random"]
    assert power.ours == measures(sets)["power_at_1"]
    assert power.agrees
    assert coordinate.ours == pytest.approx(np.mean(sets[:, 0, 0]))
    assert not coordinate.agrees


@cache
def found_in_the_sets(shared: tuple[str, int, int, int, int]) -> list[Verified]:
    """Every figure of the same sets, which are drawn and measured once."""
    return list(verify(figure for figure in PUBLISHED if figure.same_sets == shared))


@pytest.mark.slow
@pytest.mark.parametrize("figure", PUBLISHED, ids=lambda f: f"{f.generator}-{f.measure_name}")
def test_ours_agrees_with_what_was_published(figure: PublishedFigure) -> None:
    (found,) = [one for one in found_in_the_sets(figure.same_sets) if one.figure is figure]
    assert found.agrees, (found.ours, figure.published)


def test_independent_points_gain_nothing_in_integration_and_a_lattice_has_equal_areas() -> None:
    sets = generate("random", n=200, d=2, seed=1, realizations=40)
    assert 1 / np.mean([1 / gain_in_integration(x) for x in sets]) == pytest.approx(1, abs=0.2)
    assert spread_of_voronoi_areas(generate("grid", n=64, d=2)) == pytest.approx(0, abs=1e-9)


def test_the_published_radial_power_of_bnot_is_that_of_the_published_sets() -> None:
    """Means over the four sets to three digits, those of |f| = 3 and 40 summed wave by wave too."""
    sets = np.array([gbnbench.load(path) for path in published_files("bnot-1024/*")])
    mean = np.mean([ring_power(x) for x in sets], axis=0)
    np.testing.assert_allclose(PUBLISHED_POWER, mean, rtol=6e-3)
    for ring in (3, 40):
        f = np.array(
            [(a, b) for a in range(-41, 42) for b in range(-41, 42) if round(math.hypot(a, b)) == ring]
        )
        waves = np.exp(-2j * np.pi * np.einsum("snd,fd->sfn", sets, f)).sum(axis=2)
        assert np.mean(np.abs(waves) ** 2) / 1024 == pytest.approx(mean[ring - 3], rel=1e-9)
    ratio = [PowerOverPublished(16, 23)(x) for x in sets]
    assert np.mean(ratio) == pytest.approx(1, abs=2e-3)
