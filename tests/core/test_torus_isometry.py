"""Shifts, flips and swaps keep distances and spectra, and wrong ones are refused."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.errors import InputError
from gbnbench.core.torus import toroidal_distance
from gbnbench.core.torus_isometry import identity, isometry, random_isometries

X = np.random.default_rng(3).random((40, 3))
FREQUENCIES = np.array(list(itertools.product(range(-3, 4), repeat=3)))


def test_distances_are_kept():
    copy = isometry(3, [(0, 2)], [1], [0.25, 0.7, 0.1])(X)
    assert copy.min() >= 0
    assert copy.max() < 1
    assert toroidal_distance(copy[:, None], copy) == pytest.approx(
        toroidal_distance(X[:, None], X), abs=1e-15
    )


def test_frequencies_of_the_spectrum_change_places_as_said():
    made = isometry(3, [(0, 1), (1, 2)], [0], [0.3, 0.6, 0.9])
    assert made.axes == (1, 2, 0)
    power = periodogram(made(X), frequencies=FREQUENCIES).power
    there = np.zeros_like(FREQUENCIES)
    for a, axis in enumerate(made.axes):
        there[:, axis] = FREQUENCIES[:, a] * (-1 if made.flipped[a] else 1)
    assert power == pytest.approx(periodogram(X, frequencies=there).power, abs=1e-11)


def test_words_tell_what_is_done():
    assert isometry(2, [(0, 1)], [1], [0.5, 0.0]).words() == (
        "axes in the order 1,0; flipped on 1; shifted by 0.5,0.0"
    )
    assert identity(2).words() == "as it is"
    assert identity(2).is_identity()
    assert np.array_equal(identity(3)(X), X)


def test_zero_is_its_own_mirror_image():
    assert isometry(1, flip=[0])(np.array([[0.0], [0.25]])).tolist() == [[0.0], [0.75]]


def test_all_eight_turns_of_the_square_come_before_one_comes_again():
    drawn = random_isometries(16, 2, np.random.default_rng(0))
    turns = [(one.axes, one.flipped) for one in drawn]
    assert drawn[0].is_identity()
    assert len(set(turns[:8])) == len(set(turns[8:])) == 8
    assert len({one.shift for one in drawn}) == 16


def test_axes_of_unequal_sides_keep_their_places():
    drawn = random_isometries(40, 3, np.random.default_rng(1), sides=(2.0, 1.0, 1.0))
    assert {one.axes for one in drawn} == {(0, 1, 2), (0, 2, 1)}
    with pytest.raises(InputError, match="those of 0 and 1 are 2 and 1"):
        isometry(3, [(0, 1)], sides=(2.0, 1.0, 1.0))


def test_many_axes_are_turned_at_random():
    drawn = random_isometries(5, 12, np.random.default_rng(1))
    assert len({one.axes for one in drawn}) == 5
    assert all(sorted(one.axes) == list(range(12)) for one in drawn)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"swap": [(0, 2)]}, r"two axes of 0 to 1, each once; got \(0, 2\)"),
        ({"swap": [(1, 1)]}, "two axes of 0 to 1"),
        ({"flip": [-1]}, r"axes of 0 to 1, each once; got \(-1,\)"),
        ({"shift": [0.5]}, "shift must be 2 finite numbers"),
        ({"shift": [0.5, float("nan")]}, "shift must be 2 finite numbers"),
    ],
)
def test_wrong_arguments_are_named(arguments, said):
    with pytest.raises(InputError, match=said):
        isometry(2, **arguments)
