"""Power of a mask's patterns, against numpy's transform of the picture."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.radial.pattern_power import pattern_power, pattern_spectrum
from gbnbench.core.errors import InputError


@pytest.mark.parametrize("level", [1 / 16, 1 / 4, 1 / 2, 7 / 8])
@pytest.mark.parametrize("shape", [(32, 32), (24, 48), (2, 512), (512, 4)])
def test_it_is_that_of_a_fourier_transform(shape, level):
    ranks = np.random.default_rng(1).permutation(shape[0] * shape[1]).reshape(shape)
    found = pattern_power(ranks, level)
    ones = ranks < level * ranks.size
    m, pixels = ones.sum(), ranks.size
    power = np.abs(np.fft.fft2(ones)) ** 2 / m / ((pixels - m) / (pixels - 1))
    f = [np.fft.fftfreq(side) for side in shape]  # cycles a pixel
    length = np.hypot(f[0][:, None], f[1])
    principal = min(np.sqrt(min(level, 1 - level)), 0.5)
    for part, value in ((0.5, found.low), (0.25, found.lowest)):
        low = (length <= principal * part + 1e-12) & (length > 0)
        assert value == pytest.approx(power[low].mean(), rel=1e-9)
    assert found.ones == m


def test_a_long_mask_needs_no_more_frequencies_than_a_square(monkeypatch):
    farthest = []

    def watched(ranks, ones, fmax):
        farthest.append(fmax)
        return pattern_spectrum(ranks, ones, fmax)

    monkeypatch.setattr("gbnbench.analysis.radial.pattern_power.pattern_spectrum", watched)
    ranks = np.random.default_rng(2).permutation(2 * 512).reshape(2, 512)
    assert pattern_power(ranks, 1 / 2) != pattern_power(ranks.reshape(32, 32), 1 / 2)
    assert farthest == [9, 9]


def test_a_level_without_ones_is_refused():
    with pytest.raises(InputError, match=r"level 0\.001 of 64 pixels has 0 ones"):
        pattern_power(np.arange(64).reshape(8, 8), 0.001)
