"""Radices and twiddles of transforms: their product is the length, and the passes make numpy's transform."""

from __future__ import annotations

import mpmath
import numpy as np
import pytest

from gbnbench.analysis.spectrum.evaluators.gridded_fft.fourier_tables import radices, turns, twiddles


@pytest.mark.parametrize("length", [1, 2, 3, 4, 5, 8, 16, 32, 60, 144, 360, 1152, 2000])
def test_passes_in_plain_python_are_the_transform(length):
    order = radices(length)
    assert np.prod(order) == length
    assert order.count(2) <= 1
    x = np.random.default_rng(length).random(length) + 0j
    table = iter(twiddles(length, order) @ [1, 1j])
    found, done = x, 1
    for radix in order:
        step = length // (done * radix)
        turn = np.exp(-2j * np.pi * np.outer(np.arange(radix), np.arange(radix)) / radix)
        part = np.einsum("jq,kqi->jki", turn, found.reshape(done, radix, step))
        for i in range(step):
            for j in range(1, radix):
                part[j, :, i] *= next(table)
        found, done = part.reshape(-1), done * radix
    assert next(table, None) is None
    assert found == pytest.approx(np.fft.fft(x), abs=1e-12)


def test_turns_are_within_half_a_unit_or_so():
    numerator = np.arange(0, 3000, 7)
    found = turns(numerator, 1155)
    with mpmath.workdps(40):
        exact = [mpmath.expjpi(mpmath.mpf(-2 * int(k)) / 1155) for k in numerator]
        off = [max(abs(f[0] - e.real), abs(f[1] - e.imag)) for f, e in zip(found, exact, strict=True)]
    assert max(off) <= 1.5 * 2.0**-53
    assert turns(np.array([0, 1, 2, 3]), 4).tolist() == [[1, 0], [0, -1], [-1, 0], [0, 1]]
