"""FINUFFT against integer phases and long double cosines, on scattered, clustered and coincident points."""

from __future__ import annotations

import subprocess
import sys
import time

import numpy as np
import pytest

from gbnbench.analysis.spectrum.evaluators.nufft import transform as nufft
from gbnbench.analysis.spectrum.evaluators.nufft.cost import nufft_bytes, nufft_seconds
from gbnbench.analysis.spectrum.evaluators.nufft.errors import nufft_errors, nufft_tolerance
from gbnbench.analysis.spectrum.evaluators.nufft.limits import LOOSEST
from gbnbench.analysis.spectrum.evaluators.nufft.transform import available, nufft_power
from gbnbench.core.errors import InputError
from tests.oracles.power import roots

needs_finufft = pytest.mark.skipif(not available(), reason="finufft is not installed")
CASES = ((300, 1, 40), (5000, 1, 40), (257, 1, 4001), (200, 2, 17), (1000, 2, 64), (2000, 2, 7), (150, 3, 8))


def points(n, d, seed=0):
    """Draw points on the 2^-53 grid, whose phases are then exact in 64 bits."""
    return np.floor(np.random.default_rng(seed).random((n, d)) * 2.0**53) / 2.0**53


def drawn(fmax, d, count=40):
    f = np.random.default_rng(count).integers(-fmax, fmax + 1, (count, d))
    f[:2] = [[fmax] * d, [-fmax] * d]
    return f[f.any(axis=1)]


@needs_finufft
@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12, 1e-14])
@pytest.mark.parametrize(("n", "d", "fmax"), CASES)
def test_scattered_points_are_as_typical_and_within_the_bound(n, d, fmax, tolerance):
    x, f = points(n, d), drawn(fmax, d)
    for weights in (None, np.random.default_rng(1).standard_normal(n) * 1e200):
        cube = nufft_power(x, fmax, tolerance, weights, threads=1)
        assert cube.shape == (2 * fmax + 1,) * d
        met = np.abs(np.sqrt(cube[tuple((f + fmax).T)]) - roots(x, f, weights)).astype(float)
        errors = nufft_errors(n, d, fmax, tolerance, weights)
        assert met.max() <= errors.bound
        rms = np.sqrt(np.mean(met**2))
        assert rms < 5 * errors.rms
        if fmax > 16:
            assert rms > 0.02 * errors.rms


@needs_finufft
@pytest.mark.parametrize("tolerance", [1e-3, 1e-7, 1e-12, 1e-14])
@pytest.mark.parametrize(("n", "d", "fmax"), CASES)
def test_coincident_and_clustered_points_are_within_the_bound(n, d, fmax, tolerance):
    bound = nufft_errors(n, d, fmax, tolerance).bound
    for seed in range(3):
        place = points(1, d, seed)
        met = np.abs(
            np.sqrt(nufft_power(np.repeat(place, n, axis=0), fmax, tolerance, threads=1)) - np.sqrt(n)
        )
        assert met.max() <= bound
        cluster = np.floor((place + 2.0**-9 * points(n, d)) % 1 * 2.0**53) / 2.0**53
        f = drawn(fmax, d)
        power = nufft_power(cluster, fmax, tolerance, threads=1)[tuple((f + fmax).T)]
        assert np.abs(np.sqrt(power) - roots(cluster, f)).max() <= bound


@needs_finufft
@pytest.mark.parametrize(("d", "fmax"), [(1, 50), (1, 51), (2, 12), (2, 13), (3, 4), (3, 5)])
def test_half_a_grid_is_the_whole_one_and_exactly_symmetric(monkeypatch, d, fmax):
    x = points(90, d)
    half = nufft_power(x, fmax, 1e-12)
    monkeypatch.setattr(nufft, "half_grid_pays", lambda *_: False)
    whole = nufft_power(x, fmax, 1e-12)
    np.testing.assert_allclose(np.sqrt(half), np.sqrt(whole), atol=1e-10)
    for cube in (half, whole):
        assert np.array_equal(cube, cube[(slice(None, None, -1),) * d])


@needs_finufft
@pytest.mark.parametrize(("n", "d", "fmax"), [(1000, 2, 64), (5000, 2, 10), (1000, 3, 12), (500, 1, 500)])
@pytest.mark.parametrize("rms", [1e-2, 1e-5, 1e-8, 1e-11, 3e-13])
def test_the_tolerance_for_an_error_reaches_it(n, d, fmax, rms):
    x, f = points(n, d, 3), drawn(fmax, d, 100)
    tolerance = nufft_tolerance(rms, n, d, fmax)
    power = nufft_power(x, fmax, tolerance)[tuple((f + fmax).T)]
    assert np.sqrt(np.mean((np.sqrt(power) - roots(x, f)).astype(float) ** 2)) <= rms


def test_an_error_out_of_reach_is_refused_with_what_can_be_reached():
    with pytest.raises(InputError, match=r"reaches an error of sqrt\(power\) of .*e-1\d .* exact method"):
        nufft_tolerance(1e-15)
    assert nufft_tolerance(1e-12, 1000, 2, 64) < 1e-12
    with pytest.raises(InputError, match=r"\|f\| <= 20000"):
        nufft_tolerance(1e-12, 1000, 1, 20_000)
    for rms in (0.0, -1.0, float("nan")):
        with pytest.raises(InputError, match="reaches"):
            nufft_tolerance(rms)
    assert nufft_tolerance(10.0) == LOOSEST


@pytest.mark.parametrize("tolerance", [1e-15, 0.0, -1.0, 1.0, float("nan")])
def test_tolerances_out_of_range_are_refused(tolerance):
    x = points(5, 2)
    for call in (
        lambda: nufft_power(x, 3, tolerance),
        lambda: nufft_errors(5, 2, 3, tolerance),
        lambda: nufft_seconds(5, 2, 3, tolerance),
    ):
        with pytest.raises(InputError, match="tolerance of FINUFFT must lie in"):
            call()


def test_four_dimensions_are_refused():
    with pytest.raises(InputError, match="at most 3 dimensions; got d=4"):
        nufft_power(points(5, 4), 3, 1e-6)


def test_without_finufft_it_says_so(monkeypatch):
    monkeypatch.setattr(nufft, "available", lambda: False)
    with pytest.raises(InputError, match="pip install finufft"):
        nufft_power(points(5, 2), 3, 1e-6)


def test_finufft_is_loaded_only_when_asked():
    code = (
        "import sys, gbnbench.analysis.spectrum.evaluators.nufft.transform\nprint('finufft' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"


@needs_finufft
def test_finufft_prints_nothing(capfd):
    for tolerance in (1e-1, 1e-2, 1e-6, 1e-7, 1e-9, 1e-14):
        for d in (1, 2, 3):
            nufft_power(points(40, d), 9, tolerance)
    assert capfd.readouterr() == ("", "")


def test_expected_seconds_grow_with_every_part_of_the_work():
    base = nufft_seconds(10_000, 2, 128, 1e-6)
    assert base < nufft_seconds(100_000, 2, 128, 1e-6)
    assert base < nufft_seconds(10_000, 2, 512, 1e-6)
    assert base < nufft_seconds(10_000, 2, 128, 1e-12)
    assert base < nufft_seconds(10_000, 3, 128, 1e-6)
    assert 8 * 257**2 < nufft_bytes(10_000, 2, 128, 1e-6) < 40e6


@needs_finufft
@pytest.mark.parametrize(("n", "d", "fmax"), [(1000, 1, 5000), (1000, 2, 64), (4000, 3, 16)])
def test_expected_seconds_are_of_the_right_order(n, d, fmax):
    x = points(n, d)
    taken = []
    for _ in range(8):
        began = time.process_time()
        nufft_power(x, fmax, 1e-9, threads=1)
        taken.append(time.process_time() - began)
    assert 0.05 < min(taken) / nufft_seconds(n, d, fmax, 1e-9) < 20
