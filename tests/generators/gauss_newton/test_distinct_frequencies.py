"""Distinct frequencies are those that sorting finds, whether a table or the sort is taken."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.generators.gauss_newton.distinct_frequencies import distinct_frequencies


@pytest.mark.parametrize("reach", [3, 40, 10**6])
@pytest.mark.parametrize("axes", [1, 2, 3])
@pytest.mark.parametrize("count", [1, 2000])
def test_they_are_those_of_sorting(reach: int, axes: int, count: int) -> None:
    f = np.random.default_rng(axes).integers(-reach, reach + 1, (count, axes)) + 5
    rows, place = distinct_frequencies(f)
    expected, where = np.unique(f, axis=0, return_inverse=True)
    assert np.array_equal(rows, expected)
    assert np.array_equal(place, where.reshape(-1))
    assert np.array_equal(rows[place], f)


def test_without_axes_there_is_one() -> None:
    rows, place = distinct_frequencies(np.zeros((4, 0), np.int64))
    assert rows.shape == (1, 0)
    assert place.tolist() == [0, 0, 0, 0]
