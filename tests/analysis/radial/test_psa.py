"""PSA's effective Nyquist frequency and oscillations against their definition and published figures."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.special import jv

from gbnbench.analysis.radial.psa import spectral_statistics
from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import wrap
from tests.oracles.lattices import grid
from tests.published_sets import published


@pytest.mark.parametrize("m", [8, 10])
def test_the_power_of_a_grid_against_forty_digits(m: int) -> None:
    """Its pairs are known in integers; 1 and the integral of g - 1, ten times as large, cancel to 1e-13."""
    n, total = m * m, 100 * m
    pairs = [0] * (total // 2 + 1)
    half = range(-(m // 2) + 1, m // 2 + 1)
    for i in half:
        for j in half:
            bin_ = math.isqrt(40_000 * (i * i + j * j))
            if 0 < bin_ < len(pairs):
                pairs[bin_] += 1
    chosen = [1, 17, 200, 411, 1500 * m // 20]
    found = spectral_statistics(grid(m, 2)).power[0, chosen]
    with mpmath.workdps(40):
        dr = mpmath.mpf(1) / (2 * total)
        for k, power in zip(chosen, found, strict=True):
            v = k * mpmath.mpf(n) / (2 * total)
            edge = min(max(4 * v / m, mpmath.mpf(1) / 5), mpmath.mpf(1) / 2) / 2
            integral = mpmath.mpf(0)
            for b, count in enumerate(pairs):
                r = b * dr
                if r > edge:
                    break
                g = (
                    mpmath.mpf(count)
                    * n
                    / 2
                    / (n * (n - 1) / mpmath.mpf(2) * mpmath.pi * dr**2 * (2 * b + 1))
                )
                turns = mpmath.pi * r / edge
                window = (
                    mpmath.mpf("0.43") + mpmath.cos(turns) / 2 + mpmath.mpf("0.08") * mpmath.cos(2 * turns)
                )
                integral += (g - 1) * mpmath.besselj(0, 2 * mpmath.pi * v * r) * r * window * dr
            assert power == pytest.approx(float(abs(1 + 2 * mpmath.pi * n * integral)), rel=0, abs=1e-12), k


def slow(sets: np.ndarray) -> tuple[float, float, np.ndarray]:
    """The definition read aloud: whole distribution function, whole power, loops."""
    n = sets.shape[1]
    total = int(100 * math.sqrt(n))
    dr, dv = 0.5 / total, 0.5 * n / total
    r = [k * dr for k in range(total)]
    mean = np.zeros(total)
    for x in sets:
        i, j = np.triu_indices(n, 1)
        gap = np.abs(x[i] - x[j])
        distance = np.sqrt((np.minimum(gap, 1 - gap) ** 2).sum(axis=1))
        counts = np.histogram(distance, bins=total, range=(0, 0.5))[0]
        g = counts / (n * (n - 1) / 2 * math.pi * dr**2 * (2 * np.arange(total) + 1))
        for k in range(total):
            v = k * dv
            edge = 0.5 * min(max(4 * v / math.sqrt(n), 0.2), 0.5)
            inside = int(sum(value <= edge for value in r)) if k < 60 else total // 2 + 1
            q = np.array(r[:inside])
            w = 0.43 + 0.5 * np.cos(np.pi * q / edge) + 0.08 * np.cos(2 * np.pi * q / edge)
            f = np.zeros(total)
            f[:inside] = (g[:inside] - 1) * jv(0, 2 * np.pi * v * q) * q * w
            mean[k] += abs(1 + 2 * np.pi * n * np.trapezoid(f, dx=dr)) / len(sets)
    running, c = 0.0, [0.0]
    for k in range(1, total):
        running += 2 * k * dv * mean[k] * dv
        c.append(running / (k * dv) ** 2)
    nyquist = 0.0
    for k in range(int(math.sqrt(n) / 2 / dv), total):
        if c[k] > 0.5:
            nyquist = next((m * dv / 2 for m in range(k, 0, -1) if c[m] < 0.1), 0.0) * 2 / math.sqrt(n)
            break
    first = next(k for k in range(total) if mean[k] >= 0.98)
    v0 = first * dv
    v1 = min(v0 + 5 * math.sqrt(n), n / 2)
    last = min(int((v1 + dv) / dv), total - 1)
    departure = [(mean[k] - 1) ** 2 * k * dv for k in range(first, last + 1)]
    area = math.pi * (v1**2 - v0**2)
    return nyquist, 10 * math.sqrt(2 * math.pi * np.trapezoid(departure, dx=dv) / area), mean


@pytest.mark.parametrize("n", [49, 289])  # all frequencies are needed; the first 8 sqrt(n) are enough
def test_against_the_definition(n: int) -> None:
    rng = np.random.default_rng(n)
    m = math.isqrt(n)
    sets = (np.repeat(grid(m, 2)[None], 2, axis=0) + (0.15 + 0.7 * rng.random((2, n, 2))) / m) % 1
    made = spectral_statistics(sets)
    nyquist, omega, power = slow(sets)
    np.testing.assert_allclose(made.power.mean(axis=0), power[: len(made.frequency)], atol=1e-10)
    assert made.effective_nyquist == pytest.approx(nyquist, abs=1e-12)
    assert made.oscillations == pytest.approx(omega, abs=2e-3)
    for k in range(2):
        one = spectral_statistics(sets[k])
        assert made.effective_nyquist_by_set[k] == one.effective_nyquist
        assert made.oscillations_by_set[k] == pytest.approx(one.oscillations, rel=1e-9)


def test_a_lattice_needs_frequencies_beyond_the_first() -> None:
    x = grid(18, 2) + 1e-3
    made = spectral_statistics(x)
    nyquist, omega, _ = slow(x[None])
    assert made.effective_nyquist == pytest.approx(nyquist, abs=1e-12)
    assert made.oscillations == pytest.approx(omega, rel=1e-3)


@pytest.mark.parametrize(
    ("name", "nyquist", "low", "high"),
    [
        ("bnot-1024/bnot-1.txt", 0.855, 2.035, 2.045),
        ("step-1024/step-1.txt", 0.570, 0.105, 0.155),
        ("step-1024/step-2.txt", 0.570, 0.105, 0.155),
    ],
)
def test_figures_of_psa(name: str, nyquist: float, low: float, high: float) -> None:
    made = spectral_statistics(published(name))
    assert made.effective_nyquist == pytest.approx(nyquist, abs=1e-9)
    assert low < made.oscillations < high


def test_random_points_as_psa_has_them() -> None:
    made = spectral_statistics(np.random.default_rng(5).random((4, 1024, 2)))
    assert made.effective_nyquist == 0
    assert made.oscillations_by_set == pytest.approx([0.2] * 4, abs=0.15)
    high = made.power[:, made.frequency > 32]
    assert high.mean() == pytest.approx(1, abs=0.02)


@pytest.mark.parametrize("n", [2, 3, 5])
def test_few_points_still_have_statistics(n: int) -> None:
    made = spectral_statistics(np.random.default_rng(n).random((n, 2)))
    assert math.isfinite(made.effective_nyquist)
    assert made.oscillations >= 0


def test_errors_are_the_jackknife_of_the_mean_power() -> None:
    sets = np.random.default_rng(7).random((5, 300, 2))
    made = spectral_statistics(sets)
    left_out = [spectral_statistics(np.delete(sets, k, axis=0)) for k in range(5)]
    omega = np.array([each.oscillations for each in left_out])
    nyquist = np.array([each.effective_nyquist for each in left_out])
    assert made.oscillations_error == pytest.approx(
        np.sqrt(0.8 * np.sum((omega - omega.mean()) ** 2)), rel=1e-9
    )
    assert made.effective_nyquist_error == pytest.approx(
        np.sqrt(0.8 * np.sum((nyquist - nyquist.mean()) ** 2)), abs=1e-12
    )
    assert made.oscillations < made.oscillations_by_set.mean()
    assert math.isnan(spectral_statistics(sets[0]).oscillations_error)


def test_refusals() -> None:
    rng = np.random.default_rng(6)
    with pytest.raises(RefusalError, match="at most 200000"):
        spectral_statistics(np.full((200_001, 2), 0.5))
    with pytest.raises(RefusalError, match="d=3"):
        spectral_statistics(rng.random((20, 3)))
    with pytest.raises(RefusalError, match="n >= 2"):
        spectral_statistics([[0.1, 0.2]])


@settings(deadline=None, max_examples=10)
@given(st.integers(0, 2**32 - 1))
def test_statistics_do_not_know_the_origin_or_the_order(seed: int) -> None:
    rng = np.random.default_rng(seed)
    x = rng.random((150, 2))
    y = wrap(x + rng.random(2))[rng.permutation(150)]
    one, two = spectral_statistics(x), spectral_statistics(y)
    # a distance may round into the next bin of the distribution function
    assert two.oscillations == pytest.approx(one.oscillations, rel=1e-3)
    assert two.effective_nyquist == pytest.approx(one.effective_nyquist, abs=0.0051)
