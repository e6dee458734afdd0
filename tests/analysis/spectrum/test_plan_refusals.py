"""Requests for spectra that are refused, and in which words."""

from __future__ import annotations

import math

import pytest

from gbnbench.analysis.spectrum.plan import plan
from gbnbench.core.errors import InputError
from gbnbench.core.results.resolution import resolvable_power


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"n": 0, "d": 2, "fmax": 3}, "n must be an integer"),
        ({"n": 10.5, "d": 2, "fmax": 3}, "n must be an integer"),
        ({"n": 10, "d": True, "fmax": 3}, "d must be an integer"),
        ({"n": 10, "d": 2, "fmax": 0}, "fmax must be an integer"),
        ({"n": 10, "d": 2, "fmax": 3, "realizations": 0}, "realizations must be"),
        ({"n": 10, "d": 2, "fmax": 3, "floor": 0.0}, "floor must be"),
        ({"n": 10, "d": 2, "fmax": 3, "floor": -1e-9}, "floor must be"),
        ({"n": 10, "d": 2, "fmax": 3, "floor": math.nan}, "floor must be"),
        ({"n": 10, "d": 2, "fmax": 3, "floor": math.inf}, "floor must be"),
        ({"n": 10, "d": 2, "fmax": 3, "floor": "deep"}, "floor must be"),
        ({"n": 10, "d": 2, "fmax": 3, "floor": 1e-40}, "out of reach"),
        (
            {"n": 10, "d": 2, "fmax": 3, "floor": 1e-20, "precision": "float"},
            'precision="double" reaches deeper',
        ),
        ({"n": 10, "d": 2, "fmax": 3, "precision": "single"}, '"double" or "float"'),
        ({"n": 10, "d": 2, "fmax": 10**7}, "largest fmax that fits"),
        ({"n": 10, "d": 30, "fmax": 2}, "more than 2^63"),
        ({"n": 10, "d": 2, "fmax": 4, "band": (9, 10)}, "fmax=10"),
        ({"n": 10, "d": 2, "fmax": 4, "frequencies": 0}, "frequencies must be"),
        ({"n": 10, "d": 2, "fmax": 4, "frequencies": -3}, "frequencies must be"),
        ({"n": 10, "d": 2, "fmax": 4, "frequencies": 2.5}, "frequencies must be"),
        ({"n": 10, "d": 2, "fmax": -4, "frequencies": 2}, "fmax must be"),
        ({"n": 10, "d": 2, "fmax": "4", "frequencies": 2}, "fmax must be"),
    ],
)
def test_bad_requests_are_refused_in_words(arguments, says):
    with pytest.raises(InputError) as refusal:
        plan(**arguments)
    assert says in str(refusal.value)


def test_a_refused_floor_names_the_least_that_is_served():
    with pytest.raises(InputError) as refusal:
        plan(1000, 2, 20, floor=1e-40)
    least = float(str(refusal.value).split("here is ")[1].split(";")[0])
    assert plan(1000, 2, 20, floor=1.1 * least).precision == "double"
    assert least == pytest.approx(resolvable_power(plan(1000, 2, 20).errors.rms), rel=0.5)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"half": True, "shells": True}, "one of half, shells"),
        ({"frequencies": 5, "half": True}, "one of frequencies, half"),
        ({"half": "no"}, "True or False"),
        ({"floor": True}, "floor must be"),
        ({"frequencies": 3, "precision": "half"}, "precision"),
    ],
)
def test_requests_that_contradict_themselves_are_refused(arguments, says):
    with pytest.raises(InputError, match=says):
        plan(100, 2, 5, **arguments)


def test_a_list_may_hold_any_frequency_of_64_bits():
    assert plan(10, 2, 2**63, frequencies=1).method == "direct"
