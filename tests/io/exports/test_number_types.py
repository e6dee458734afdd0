"""Rounding of coordinates to the types of exported numbers: nearest, below 1, and back without loss."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gbnbench.core.errors import InputError
from gbnbench.core.torus import toroidal_distance
from gbnbench.io.exports.number_types import check_number_type, fractions, rounded

WORST = {"float32": 2.0**-25, "float64": 0.0, "uint32": 2.0**-33}


@pytest.mark.parametrize("number_type", sorted(WORST))
@settings(deadline=None, derandomize=True)
@given(value=st.floats(0, 1, exclude_max=True))
def test_rounded_points_are_near_on_the_torus_and_below_1(number_type, value):
    x = np.array([[value]])
    back = fractions(rounded(x, number_type))
    assert back.dtype == np.float64
    assert back.min() >= 0
    assert back.max() < 1
    assert toroidal_distance(x, back).max() <= WORST[number_type]
    assert np.array_equal(fractions(rounded(back, number_type)), back)


def test_what_would_be_1_is_0():
    assert rounded(np.array([1 - 2.0**-30, 1 - 2.0**-24]), "float32").tolist() == [0.0, 1 - 2.0**-24]
    assert rounded(np.array([1 - 2.0**-34]), "uint32").tolist() == [0]


def test_other_types_are_refused():
    with pytest.raises(InputError, match="type must be one of float32, float64, uint32; got 'half'"):
        check_number_type("half")
