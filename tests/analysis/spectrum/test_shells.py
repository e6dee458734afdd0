"""Groupings of frequencies by radius, against enumeration one by one."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from itertools import product
from math import isqrt, sqrt

import numpy as np
import pytest

from gbnbench.analysis.spectrum.shells import annuli, digit_classes, exact_shells, squared_radius


def enumerated(fmax, d, key):
    groups = Counter()
    for f in product(range(-fmax, fmax + 1), repeat=d):
        r2 = sum(c * c for c in f)
        if 0 < r2 <= fmax**2:
            groups[key(f, r2)] += 1
    return groups


@pytest.mark.parametrize(("fmax", "d"), [(9, 1), (12, 2), (5, 3), (2, 5), (1, 8)])
def test_exact_shells_are_the_integer_squares(fmax, d):
    shells, expected = exact_shells(fmax, d), enumerated(fmax, d, lambda f, r2: r2)
    assert np.array_equal(shells.radius, np.sqrt(sorted(expected)))
    assert shells.count.tolist() == [expected[r2] for r2 in sorted(expected)]
    r2 = squared_radius(fmax, d)
    assert np.array_equal(shells.label == shells.size, (r2 == 0) | (r2 > fmax**2))
    assert shells.mean(r2.astype(float)) == pytest.approx(sorted(expected), rel=1e-15)


@pytest.mark.parametrize(("fmax", "d"), [(6, 2), (4, 3), (2, 5)])
def test_digit_classes_are_the_sorted_absolute_digits(fmax, d):
    classes = digit_classes(fmax, d)
    expected = enumerated(fmax, d, lambda f, r2: (r2, tuple(sorted(map(abs, f)))))
    assert classes.size == len(expected)
    assert sorted(zip(classes.radius.round(12).tolist(), classes.count.tolist(), strict=True)) == sorted(
        (round(sqrt(r2), 12), count) for (r2, _), count in expected.items()
    )


@pytest.mark.parametrize(("fmax", "d", "width"), [(40, 1, 1.1), (8, 2, sqrt(2)), (5, 3, sqrt(3))])
def test_frequencies_at_an_edge_of_annuli_belong_above_it(fmax, d, width):
    """|f| = k width but for rounding, as 33 = 30 * 1.1, opens annulus k, as in a box of unequal sides."""
    square = squared_radius(fmax, d)
    inside = (square > 0) & (square <= fmax**2)
    ratio = Fraction(width**2).limit_denominator(1000)
    numbers = [isqrt(int(s / ratio)) for s in square[inside].tolist()]
    assert annuli(fmax, d, width).count.tolist() == np.unique(numbers, return_counts=True)[1].tolist()


def test_annuli_are_psas():
    rings = annuli(12, 2, 2.0)
    expected = enumerated(12, 2, lambda f, r2: isqrt(r2) // 2)
    assert rings.count.tolist() == [expected[k] for k in sorted(expected)]
    assert ((rings.radius // 2).astype(int) == sorted(expected)).all()
