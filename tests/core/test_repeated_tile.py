"""Repeated tiles have the power of one at multiples of their counts, and none elsewhere."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.errors import InputError
from gbnbench.core.repeated_tile import repeated


def test_a_repeated_tile_has_power_at_multiples_alone():
    tile = np.random.default_rng(5).random((20, 2))
    laid = repeated(tile, (2, 3))
    assert laid.shape == (120, 2)
    f = np.array(list(itertools.product(range(-4, 5), range(-6, 7))))
    power = periodogram(laid, frequencies=f).power
    multiple = (f[:, 0] % 2 == 0) & (f[:, 1] % 3 == 0)
    of_tile = periodogram(tile, frequencies=f[multiple] // (2, 3)).power
    assert power[multiple] == pytest.approx(6 * of_tile, abs=1e-10)
    assert power[~multiple] == pytest.approx(0, abs=1e-26 * 120**2)


@pytest.mark.parametrize("counts", [(2,), (2, 0), (2, 1.5)])
def test_wrong_counts_of_tiles_are_named(counts):
    with pytest.raises(InputError, match="repeat must be 2 whole numbers of at least 1"):
        repeated(np.zeros((1, 2)), counts)
