"""Balanced digits: every frequency of a cube is the sum of two groups' entries exactly once."""

from __future__ import annotations

import math
import time
from itertools import product

import numpy as np
import pytest

from gbnbench.analysis.spectrum.digits import (
    Axis,
    cheapest_division,
    division,
    even_division,
    half_size,
    half_space,
    multiples,
    multiplied_columns,
    size,
    whole_axes,
    zero_apart,
)


def reached(division, d):
    """All sums of the two parts' frequencies, by brute force over their digits: (pairs, d)."""
    parts = []
    for axes in (division.leading, division.trailing):
        listed = [[0] * d]
        for axis in axes:
            listed = [
                [*f[: axis.coordinate], f[axis.coordinate] + axis.multiple * digit, *f[axis.coordinate + 1 :]]
                for f in listed
                for digit in range(-axis.largest, axis.largest + 1)
            ]
        parts.append(np.array(listed))
    return (parts[0][:, None] + parts[1]).reshape(-1, d)


def check_covered_once(division, reach):
    """Every |f_a| <= reach[a] once, in the order of a cube, and a few beyond the edge on one axis."""
    if not reach:
        assert division.leading == division.trailing == ()
        return
    f = reached(division, len(reach))
    most = np.abs(f).max(axis=0)
    cube = np.stack(np.unravel_index(np.arange(len(f)), 2 * most + 1), axis=1) - most
    assert np.array_equal(f, cube)
    assert (most >= reach).all()
    assert (most > reach).sum() <= 1
    assert (most - reach < 2 * division.fine + 1).all()


@pytest.mark.parametrize(("d", "fmax"), [(1, 1), (1, 2), (1, 7), (1, 52), (2, 1), (2, 4), (3, 2), (4, 1)])
def test_every_division_covers_the_cube_once(d, fmax):
    axes = whole_axes(d, fmax)
    for at, fine in product(range(d), range(fmax + 1)):
        check_covered_once(division(axes, at, fine), [fmax] * d)


@pytest.mark.parametrize("d", [1, 2, 3, 5, 7])
@pytest.mark.parametrize("rows", [3, 4])
def test_the_cheapest_division_covers_the_cube_once(d, rows):
    for fmax in {1: (1, 2, 3, 10, 40, 364, 4097), 2: (1, 2, 3, 20, 64), 3: (1, 2, 5, 9), 5: (1, 2)}.get(
        d, (1,)
    ):
        found = cheapest_division(d, fmax, rows)
        check_covered_once(found, [fmax] * d)
        for part in (found.leading, found.trailing):
            reach = [axis.largest for axis in part]
            check_covered_once(_renumbered(even_division(part), part), reach)


def _renumbered(found, part):
    """Let a division's axes count a part's own digits, each a coordinate with multiple 1."""
    position = {axis.coordinate: (k, axis.multiple) for k, axis in enumerate(part)}

    def own(axes):
        return tuple(
            Axis(position[a.coordinate][0], a.multiple // position[a.coordinate][1], a.largest) for a in axes
        )

    return type(found)(own(found.leading), own(found.trailing), found.at, found.fine)


@pytest.mark.parametrize(
    ("d", "fmax"), [(1, 2**20), (1, 10**6), (2, 4096), (3, 101), (8, 1), (8, 2), (12, 1), (12, 2), (20, 1)]
)
def test_a_large_cube_is_divided_in_groups_of_like_size(d, fmax):
    found = cheapest_division(d, fmax, 3)
    a, b = half_size(found.leading), half_size(found.trailing)
    covered = size(found.leading) * size(found.trailing)
    assert (2 * fmax + 1) ** d <= covered < 1.02 * (2 * fmax + 1) ** d
    assert max(a, b) < 3 * math.sqrt((2 * fmax + 1) ** d)
    for part in (found.leading, found.trailing):
        entries = even_division(part)
        assert half_size(entries.leading) + half_size(entries.trailing) <= 5 * math.sqrt(size(part))


def test_columns_are_padded_to_parts_of_a_block_but_for_a_last_frequency_0():
    assert [multiplied_columns(count, 4) for count in (1, 2, 4, 5, 6, 41, 42)] == [0, 4, 4, 4, 8, 40, 44]
    assert [multiplied_columns(count, 1) for count in (1, 2, 41)] == [1, 2, 41]
    assert [count for count in range(1, 20) if zero_apart(count, 8)] == [1, 9, 17]
    assert not any(zero_apart(count, 1) for count in range(1, 20))


def test_even_division_is_the_best_of_all():
    for d, fmax in ((1, 9), (1, 60), (2, 3), (2, 16), (3, 2), (6, 1)):
        axes = whole_axes(d, fmax)
        entries = [
            half_size(found.leading) + half_size(found.trailing)
            for found in (division(axes, at, fine) for at in range(d) for fine in range(fmax + 1))
        ]
        best = even_division(axes)
        assert half_size(best.leading) + half_size(best.trailing) == min(entries)
    assert even_division(()).leading == even_division(()).trailing == ()


@pytest.mark.parametrize(("d", "fmax"), [(1, 1), (1, 8), (2, 3), (3, 2), (5, 1)])
def test_half_space_lists_zero_and_one_of_each_pair(d, fmax):
    axes = whole_axes(d, fmax)
    digits = half_space(axes)
    assert digits.shape == (half_size(axes), d)
    assert not digits[0].any()
    rows = {tuple(row) for row in digits.tolist()}
    assert len(rows) == len(digits)
    for f in product(range(-fmax, fmax + 1), repeat=d):
        assert (f in rows) != (tuple(-c for c in f) in rows) or not any(f)
    assert half_space(()).shape == (1, 0)


def test_multiples_add_up_what_one_coordinate_has_in_two_digits():
    axes = (Axis(2, 5, 3), Axis(0, 1, 1), Axis(2, 1, 2))
    digits = np.array([[3, -1, 2], [-2, 1, 0]])
    assert multiples(axes, digits, 4).tolist() == [[-1, 0, 17, 0], [1, 0, -10, 0]]
    assert multiples((), np.zeros((1, 0), np.int64), 2).tolist() == [[0, 0]]


def test_dividing_many_dimensions_takes_no_time():
    began = time.process_time()
    found = cheapest_division(20, 2, 3)
    assert size(found.leading) * size(found.trailing) == 5**20
    assert time.process_time() - began < 1
