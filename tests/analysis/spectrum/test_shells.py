"""Groupings of frequencies by radius, against enumeration one by one."""

from __future__ import annotations

from collections import Counter
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


def test_annuli_are_psas():
    rings = annuli(12, 2, 2.0)
    expected = enumerated(12, 2, lambda f, r2: isqrt(r2) // 2)
    assert rings.count.tolist() == [expected[k] for k in sorted(expected)]
    assert ((rings.radius // 2).astype(int) == sorted(expected)).all()
