"""Cosine power against the periodogram of mirrored sets, and white noise's mean of 1."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest

from gbnbench.analysis.spectrum.cosine_power import cosine_power, cosine_radial
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.errors import InputError


@pytest.mark.parametrize(("n", "d", "fmax"), [(30, 1, 20), (25, 2, 9), (12, 3, 4)])
def test_it_is_the_periodogram_of_the_mirrored_set(n, d, fmax):
    x = np.random.default_rng(n).random((n, d))
    images = [np.where(np.array(flip), 2 - x, x) / 2 for flip in product((0, 1), repeat=d)]
    mirrored = periodogram(np.mod(np.concatenate(images), 1.0), fmax).power
    f = np.indices(mirrored.shape) - fmax
    halves = (f != 0).sum(axis=0)
    quadrant = (slice(fmax, None),) * d
    expected = (mirrored * 2.0 ** (halves - d))[quadrant]
    assert cosine_power(x, fmax) == pytest.approx(expected, rel=1e-9, abs=1e-12)


def test_white_noise_has_power_one_at_every_mode():
    power = cosine_power(np.random.default_rng(0).random((3000, 20, 2)), 3)
    assert power[0, 0] == pytest.approx(20)
    rest = np.delete(power.ravel(), 0)
    assert np.abs(rest - 1).max() < 5 * 1.5 / np.sqrt(3000) * 1.5


def test_radial_means_are_over_equal_lengths():
    power = np.arange(16.0).reshape(4, 4)
    shells = cosine_radial(power, 25)
    assert shells.frequency == pytest.approx(np.sqrt([1, 2, 4, 5, 8, 9]) / 2)
    assert shells.nu == pytest.approx(shells.frequency / 5)
    assert shells.power == pytest.approx([2.5, 5, 5, 7.5, 10, 7.5])
    assert shells.count.tolist() == [2, 1, 2, 2, 1, 2]


@pytest.mark.parametrize("fmax", [0, 1.5, 10**5])
def test_reaches_that_make_no_sense_are_refused(fmax):
    with pytest.raises(InputError, match="fmax"):
        cosine_power(np.zeros((1, 2)), fmax)
