"""Verdicts on measured values, and the tolerances that they are judged by."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy import stats

from gbnbench.core.errors import InputError
from gbnbench.regression.cases import Case, Expectation, Spread
from gbnbench.regression.runner import expect
from gbnbench.regression.verdict import judge

FLOOR = Expectation("lower", "ratio", "seeds", (7.5e-10,), 1.6, Spread(20, 0.1))


def sets(**measures: Expectation) -> Case:
    return Case("gbn-2d-1024", "sets", 1024, 2, measures, generator="gbn")


@pytest.mark.parametrize(
    ("found", "word", "words"),
    [
        (7.5e-10, "ok", ""),
        (1.19e-9, "ok", ""),
        (3.2e-9, "worse", "noise floor 3.20e-9 is 4.27 times the expected 7.50e-10 (at most 1.60 times)"),
        (1e-10, "better", "noise floor 1.00e-10 is 0.133 times the expected 7.50e-10 (at least 0.625 times)"),
        (0.0, "better", "noise floor 0 is 0 times"),
        (math.nan, "worse", "noise floor is undefined"),
        (math.inf, "worse", "noise floor is undefined"),
    ],
)
def test_a_ratio_is_judged_by_its_factor(found, word, words):
    verdict = judge(sets(noise_floor=FLOOR), "noise_floor", (found,))
    assert verdict.word == word
    if words:
        assert verdict.text.startswith("gbn-2d-1024: ")
        assert words in verdict.text
    else:
        assert verdict.text == ""


@pytest.mark.parametrize(
    ("better", "found", "word"),
    [
        ("lower", 0.66, "worse"), ("lower", 0.55, "better"), ("lower", 0.64, "ok"),
        ("higher", 0.66, "better"), ("higher", 0.55, "worse"),
        ("neither", 0.66, "worse"), ("neither", 0.55, "worse"),
    ],
)  # fmt: skip
def test_a_difference_is_judged_by_its_side(better, found, word):
    case = sets(valence6=Expectation(better, "difference", "seeds", (0.61,), 0.04, Spread(20, 0.01)))
    verdict = judge(case, "valence6", (found,))
    assert verdict.word == word
    assert word == "ok" or ("above" in verdict.text) == (found > 0.61)


def test_several_values_are_judged_by_the_largest_departure():
    expectation = Expectation("neither", "relative", "rounding", (1.0, -4.0), 1e-3, reference="closed form")
    case = Case("field", "field", 2, 1, {"gradient": expectation})
    assert judge(case, "gradient", (1.003, -4.0)).word == "ok"
    verdict = judge(case, "gradient", (1.0, -4.1))
    assert verdict.word == "worse"
    assert verdict.text == (
        "field: gradient departs from the 2 exact values by 0.0250 of the largest (at most 0.00100)"
    )
    assert judge(case, "gradient", (1.0,)).word == "worse"


@pytest.mark.parametrize(("better", "chance"), [("lower", 1e-4), ("neither", 0.5e-4)])
def test_a_tolerance_is_a_prediction_by_students_t(better, chance):
    values = [2.0, 4.0, 8.0]
    found = expect("x", Expectation(better, "ratio", "r"), [(v,) for v in values])
    assert found.expected == (4.0,)
    assert found.spread == Spread(3, pytest.approx(math.log(2), rel=1e-3))
    departure = math.log(found.tolerance) / (math.log(2) * math.sqrt(4 / 3))
    assert stats.t(2).sf(departure) == pytest.approx(chance, rel=0.02)
    plain = expect("x", Expectation(better, "difference", "r"), [(v,) for v in values])
    assert plain.expected == (pytest.approx(14 / 3, rel=1e-5),)
    assert plain.spread.deviation == pytest.approx(np.std(values, ddof=1), rel=1e-2)


def test_a_tolerance_holds_as_often_as_it_says():
    """At a chance of 1e-4, hardly any of 2,000 new seeds departs."""
    rng = np.random.default_rng(1)
    alarms = 0
    for _ in range(2000):
        floor = expect("x", Expectation("lower", "ratio", "r"), np.exp(0.2 * rng.standard_normal((12, 1))))
        alarms += (
            judge(sets(noise_floor=floor), "noise_floor", (math.exp(0.2 * rng.standard_normal()),)).word
            == "worse"
        )
    assert alarms <= 3  # 0.2 expected; four or more has a chance of 6e-5


@pytest.mark.parametrize(
    ("scale", "values", "words"),
    [
        ("ratio", [(1.0,), (0.0,), (1.0,)], "not above 0"),
        ("difference", [(1.0,), (math.nan,), (1.0,)], "undefined for some seeds"),
        ("difference", [(1.0, 2.0)] * 3, "need a reference"),
    ],
)
def test_what_has_no_spread_is_refused(scale, values, words):
    with pytest.raises(InputError, match=words):
        expect("x", Expectation("lower", scale, "r"), values)
