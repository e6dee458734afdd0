"""Sums over points against the definition in long double, and against differences."""

from __future__ import annotations

import math
import os
import subprocess
import sys

import numpy as np
import pytest

from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.generators.gauss_newton.axis_waves import axis_waves
from gbnbench.generators.gauss_newton.gram_matrix import Convolutions, PointSums, gram_product
from gbnbench.generators.gauss_newton.modes import modes_below
from gbnbench.generators.gauss_newton.wave_sums import WaveSums
from tests.oracles.gauss_newton import scaled_jacobian
from tests.oracles.power import amplitudes

CASES = [(30, 1, 0.4), (40, 2, 0.7), (60, 3, 0.8), (40, 4, 0.85), (40, 5, 0.9)]


def complex_normal(rng, size):
    return rng.normal(size=size) + 1j * rng.normal(size=size)


@pytest.mark.parametrize(("n", "d", "edge"), CASES)
class TestSums:
    def test_amplitudes_are_exact_to_rounding(self, n, d, edge):
        x = np.random.default_rng(n).random((n, d))
        below = modes_below(n, d, edge)
        expected = amplitudes(x, below.f)
        assert np.abs(WaveSums(x, below.f).amplitudes() - expected).max() < 3e-15 * math.sqrt(n)
        assert np.abs(WaveSums(x, below.f, single=True).amplitudes() - expected).max() < 1e-6 * math.sqrt(n)

    def test_gradient_is_the_jacobians_transpose(self, n, d, edge):
        rng = np.random.default_rng(n)
        x, below = rng.random((n, d)), modes_below(n, d, edge)
        y, side = complex_normal(rng, len(below)), n ** (1 / d)
        scale = 1 / (math.sqrt(n) * below.length)
        move = WaveSums(x, below.f).gradient(scale * y, side)
        expected = (scaled_jacobian(x, below.f).conj().T @ y).real.reshape(n, d)
        assert move == pytest.approx(expected, abs=1e-13)

    def test_divergence_is_the_change_of_the_amplitudes(self, n, d, edge):
        rng = np.random.default_rng(n)
        x, below = rng.random((n, d)), modes_below(n, d, edge)
        move, side, step = rng.normal(size=(n, d)), n ** (1 / d), 1e-5
        change = -1j * WaveSums(x, below.f).divergence(move, side)
        ahead, behind = (amplitudes(x + s * step * move / side, below.f) for s in (1, -1))
        assert change == pytest.approx((ahead - behind) / (2 * step), abs=1e-7 * math.sqrt(n))

    def test_both_products_are_those_of_the_matrix(self, n, d, edge):
        rng = np.random.default_rng(n)
        x, below = rng.random((n, d)), modes_below(n, d, edge)
        y = complex_normal(rng, len(below))
        jacobian = scaled_jacobian(x, below.f)
        expected = jacobian @ (jacobian.conj().T @ y).real
        waves = WaveSums(x, below.f)
        assert PointSums(below, waves)(y) == pytest.approx(expected, abs=1e-13)
        assert Convolutions(x, below)(y) == pytest.approx(expected, abs=2e-6)


def test_the_cheaper_product_is_made():
    for n, d, edge, kind in ((1024, 2, 0.72, Convolutions), (256, 5, 0.949, PointSums)):
        x, below = np.random.default_rng(0).random((n, d)), modes_below(n, d, edge)
        assert isinstance(gram_product(x, below, WaveSums(x, below.f)), kind)


@pytest.mark.slow
def test_bits_do_not_depend_on_the_number_of_threads():
    program = """
import hashlib, numpy as np
from gbnbench.generators.gauss_newton.modes import modes_below
from gbnbench.generators.gauss_newton.wave_sums import WaveSums
for n, d, edge in ((5000, 2, 0.72), (3000, 3, 0.8), (700, 5, 0.95)):
    x, below = np.random.default_rng(0).random((n, d)), modes_below(n, d, edge)
    waves = WaveSums(x, below.f)
    f = waves.amplitudes()
    single = WaveSums(x, below.f, single=True).amplitudes()
    for a in (f, single, waves.gradient(f, 9.0), waves.divergence(x, 9.0)):
        print(hashlib.sha256(np.ascontiguousarray(a).tobytes()).hexdigest())
"""
    printed = {
        subprocess.run(
            [sys.executable, "-c", program],
            env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path), "OPENBLAS_NUM_THREADS": threads},
            capture_output=True,
            check=True,
        ).stdout
        for threads in ("1", "2", "3")
    }
    assert len(printed) == 1
    assert len(printed.pop().split()) == 12


def test_blocks_of_points_add_up(monkeypatch):
    x, below = np.random.default_rng(3).random((300, 2)), modes_below(300, 2, 0.7)
    y = complex_normal(np.random.default_rng(4), len(below))
    whole = WaveSums(x, below.f)
    monkeypatch.setattr("gbnbench.generators.gauss_newton.wave_sums.BLOCK", 1)
    monkeypatch.setattr("gbnbench.generators.gauss_newton.wave_sums.HELD", 1)
    parts = WaveSums(x, below.f)
    assert parts.amplitudes() == pytest.approx(whole.amplitudes(), abs=1e-13)
    assert parts.gradient(y, 17.0) == pytest.approx(whole.gradient(y, 17.0), abs=1e-11)


def test_amplitudes_agree_with_the_periodogram():
    x = np.random.default_rng(5).random((200, 2))
    below, fmax = modes_below(200, 2, 0.7), 10
    power = periodogram(x, fmax).power[tuple((below.f + fmax).T)]
    assert np.abs(WaveSums(x, below.f).amplitudes()) ** 2 / 200 == pytest.approx(power, rel=1e-11)


def test_harmonics_of_both_signs_at_high_frequency():
    x = np.random.default_rng(6).random(20)
    table = axis_waves(x, 1000)
    f = np.array([0, 1, 31, 32, 999, 1000, -1000, -999, -1])
    turns = np.asarray(x, np.longdouble)[:, None] * f
    phase = 8 * np.arctan(np.longdouble(1)) * (turns - np.rint(turns))
    assert np.abs(table[:, f] - (np.cos(phase) + 1j * np.sin(phase))).max() < 2e-15
