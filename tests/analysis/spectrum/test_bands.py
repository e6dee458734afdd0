"""Several bands of shells are those of each, once, and measures of whole shells are not made of them."""

from __future__ import annotations

import numpy as np
import pytest

import gbnbench
from gbnbench.core.errors import InputError

X = np.random.default_rng(31).random((2, 300, 2))


@pytest.mark.parametrize("sides", [None, (2, 1)])
def test_several_bands_are_each_band(sides: tuple[int, ...] | None) -> None:
    told: list[float] = []
    bands = [(10, 12), (1, 3), (2.5, 4)]
    found = gbnbench.shells(X, band=bands, sides=sides, progress=told.append)
    low, high = (gbnbench.shells(X, band=band, sides=sides) for band in ((1, 4), (10, 12)))
    for name in ("frequency", "nu", "power", "count", "deviation"):
        both = np.concatenate([getattr(low, name), getattr(high, name)])
        np.testing.assert_allclose(getattr(found, name), both, rtol=1e-9, atol=1e-12)
    assert found.gaps
    assert not low.gaps
    assert found.error_bound == max(low.error_bound, high.error_bound)
    assert found.fmax == 12
    assert sorted(told) == told


def test_a_single_band_may_be_listed() -> None:
    one, same = gbnbench.shells(X, band=[(2, 5)]), gbnbench.shells(X, band=(2, 5))
    assert np.array_equal(one.power, same.power)
    assert not one.gaps


@pytest.mark.parametrize("bands", [[(1, 2), (3,)], [(1, 2), (5, 4)], [(1, 2), ("a", 3)], [(1, 2), (-1, 3)]])
def test_bands_that_are_none_are_refused(bands: list) -> None:
    with pytest.raises(InputError, match="band must be"):
        gbnbench.shells(X, band=bands)
