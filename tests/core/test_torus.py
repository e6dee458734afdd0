"""Points on the torus: what is accepted, wrapped, measured and turned into exact phases."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from gbnbench.core.errors import InputError
from gbnbench.core.torus import (
    check_points,
    densest_spacing,
    displacement,
    fixed_point,
    scale,
    spacing,
    toroidal_distance,
    wrap,
)


@pytest.mark.parametrize(
    ("x", "says"),
    [
        ([[0.5, 1.0]], "1.0 at index (0, 1)"),
        ([[0.5, -1e-300]], "[0, 1)"),
        ([[0.5, math.nan]], "nan"),
        ([0.5, 0.25], "(2,)"),
        (np.zeros((0, 2)), "(0, 2)"),
        (np.zeros((3, 0)), "(3, 0)"),
        ([["a", "b"]], "real numbers"),
        ([[1j, 0]], "real numbers"),
    ],
)
def test_what_is_not_points_of_the_torus_is_refused_in_words(x, says):
    with pytest.raises(InputError) as refusal:
        check_points(x)
    assert says in str(refusal.value).replace("np.float64(1.0)", "1.0")


@given(
    st.one_of(
        st.floats(width=64),
        st.sampled_from(
            [0.0, -0.0, 5e-324, -5e-324, math.nextafter(1, 0), 1.0, math.inf, -math.inf, math.nan, -math.nan]
        ),
    )
)
def test_every_double_is_accepted_just_where_it_lies_from_0_up_to_1(value):
    x = np.array([[0.5, value]])
    if 0 <= value < 1:
        assert check_points(x) is x
        return
    with pytest.raises(InputError):
        check_points(x)


@given(arrays(float, (4, 3), elements=st.floats(-1e6, 1e6)))
def test_wrap_stays_below_one_and_moves_by_whole_turns(x):
    y = wrap(x)
    assert ((y >= 0) & (y < 1)).all()
    turns = x - y
    assert np.abs(turns - np.rint(turns)).max() <= 2e-10


def test_a_tiny_negative_wraps_to_zero_and_not_to_one():
    assert wrap([-1e-17])[0] == 0.0


def test_a_single_number_wraps_as_one_coordinate():
    assert wrap(1.25).tolist() == [0.25]


@pytest.mark.parametrize(
    "x",
    [
        np.ma.masked_less([[0.1, 0.9]], 0.5),
        np.array([0.5 + 1j]),
        [["0.1", "0.2"]],
        "mine.txt",
        [[0.1], [0.2, 1]],
    ],
    ids=["masked", "complex", "texts", "a path", "ragged"],
)
def test_what_is_no_real_number_is_neither_wrapped_nor_scaled(x):
    for bring in (wrap, scale):
        with pytest.raises(InputError, match="real numbers, none"):
            bring(x)


@given(arrays(float, (5, 2), elements=st.floats(0, 1, exclude_max=True)), st.integers(-3, 3))
def test_distance_ignores_whole_turns_and_is_symmetric(x, turns):
    a, b = x[:-1], x[1:]
    there = toroidal_distance(a, b)
    assert there == pytest.approx(toroidal_distance(b, a), abs=0)
    assert there == pytest.approx(toroidal_distance(a + turns, b), abs=1e-14)
    assert (there <= math.sqrt(2) / 2 + 1e-15).all()
    assert (np.abs(displacement(a, b)) <= 0.5).all()


@given(
    st.lists(st.tuples(st.floats(0, 1e-12), st.integers(1, 10**6)), min_size=1, max_size=5),
)
def test_displacements_across_the_border_keep_all_their_digits(places):
    """Points at u and 1 - k 2^-53 are u + k 2^-53 apart; u - (1 - k 2^-53) has lost the digits of u."""
    for u, k in places:
        exact = float(Fraction(u) + Fraction(k, 2**53))
        a, b = np.array([u]), np.array([1 - k * 2.0**-53])
        assert displacement(a, b)[0] == pytest.approx(exact, rel=2.0**-52, abs=0)
        assert displacement(b, a)[0] == -displacement(a, b)[0]
        assert toroidal_distance(a, b) == pytest.approx(exact, rel=2.0**-51, abs=0)


def test_densest_spacings_are_those_of_the_known_lattices():
    # Minimum distance of Z, A2, D3, D4, E8, and of Lambda_9, K_12, Lambda_16 and Leech's lattice, scaled to
    # one point a unit volume (Conway & Sloane, Tables 1.2 and 1.3).
    known = {1: 1.0, 2: (4 / 3) ** 0.25, 3: 2 ** (1 / 6), 4: 2**0.25, 8: math.sqrt(2)}
    known |= {9: math.sqrt(2), 12: 2 / 3**0.25, 16: 2**0.75, 24: 2.0}
    for d, distance in known.items():
        assert densest_spacing(1, d) == pytest.approx(distance, rel=1e-15, abs=0)
    assert densest_spacing(1024, 2) == pytest.approx(math.sqrt(2 / (math.sqrt(3) * 1024)), rel=1e-15, abs=0)
    assert math.isnan(densest_spacing(10, 25))
    assert spacing(4096, 3) == pytest.approx(1 / 16)


@given(st.integers(0, 2**53 - 1))
def test_fixed_point_is_exact_for_multiples_of_the_double_grid(k):
    assert int(fixed_point(np.array([k / 2**53]), 64)[0]) == k * 2**11


def test_fixed_point_wraps_where_float_rounds_up_to_a_turn():
    assert fixed_point(np.array([1 - 2.0**-53]), 32)[0] == 0
    assert fixed_point(np.array([1 - 2.0**-53]), 64)[0] == 2**64 - 2**11
