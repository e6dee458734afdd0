"""Non-uniform FFTs against integer phases and long double cosines on scattered, crowded and equal points."""

from __future__ import annotations

import math
import subprocess
import sys
from dataclasses import replace

import mpmath
import numpy as np
import pytest

from gbnbench.analysis.spectrum.evaluators.nufft import transform as transform_module
from gbnbench.analysis.spectrum.evaluators.nufft.cost import cheapest_layout, nufft_seconds
from gbnbench.analysis.spectrum.evaluators.nufft.ducc import DUCC0
from gbnbench.analysis.spectrum.evaluators.nufft.errors import nufft_errors, nufft_tolerance
from gbnbench.analysis.spectrum.evaluators.nufft.finufft import FINUFFT
from gbnbench.analysis.spectrum.evaluators.nufft.transform import LIBRARIES, nufft_power, shifted
from gbnbench.analysis.spectrum.evaluators.nufft.transform_library import LOOSEST
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.errors import InputError
from tests.analysis.spectrum.evaluators.nufft_truth import (
    EDGE,
    at,
    each_library,
    hard_sets,
    heavy,
    points,
    truth,
)

CASES = ((300, 1, 40), (5000, 1, 40), (257, 1, 4001), (200, 2, 17), (1000, 2, 64), (2000, 2, 7), (150, 3, 8))
SLACK = 100  # a bound may exceed the largest error met at its sizes by so much


@each_library
@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9, 1e-12, 2e-14])
@pytest.mark.parametrize(("n", "d", "fmax"), CASES)
def test_scattered_points_are_as_typical_and_within_the_bound(library, n, d, fmax, tolerance):
    x = points(n, d)
    for weighted in (False, True):
        weights = heavy(n) if weighted else None
        f, exact = truth(n, d, fmax, 0, 40, weighted=weighted)
        cube = nufft_power(library, x, fmax, tolerance, weights)
        assert cube.shape == (2 * fmax + 1,) * d
        met = np.abs(at(cube, f, fmax) - exact).astype(float)
        errors = nufft_errors(library, n, d, fmax, tolerance, weights)
        assert met.max() <= errors.bound
        rms = np.sqrt(np.mean(met[EDGE:] ** 2))
        assert rms < 5 * errors.rms
        if fmax > 16:
            assert rms > 0.02 * errors.rms


@each_library
@pytest.mark.parametrize("tolerance", [1e-3, 1e-7, 1e-12, 2e-14])
@pytest.mark.parametrize(("n", "d", "fmax"), CASES)
def test_coincident_clustered_and_lattice_points_are_within_a_bound_that_is_not_idle(
    library, n, d, fmax, tolerance
):
    bound = nufft_errors(library, n, d, fmax, tolerance).bound
    largest = 0.0
    for seed in range(3):
        same = np.repeat(points(1, d, seed), n, axis=0)
        met = np.abs(np.sqrt(nufft_power(library, same, fmax, tolerance)) - np.sqrt(n))
        largest = max(largest, float(met.max()))
    f, sets = hard_sets(n, d, fmax)
    for x, exact in sets:
        met = np.abs(at(nufft_power(library, x, fmax, tolerance), f, fmax) - exact)
        largest = max(largest, float(met.max()))
    assert largest <= bound
    assert bound <= SLACK * largest


@each_library
@pytest.mark.parametrize(
    ("n", "d", "fmax"), [(60_000, 1, 6), (60_000, 2, 2), (60_000, 3, 2), (9, 1, 300_000)]
)
def test_crowds_and_far_frequencies_are_within_the_stated_errors(library, n, d, fmax):
    f, exact = truth(n, d, fmax, 0, 24)
    tolerance = library.tightest[d - 1]
    errors = nufft_errors(library, n, d, fmax, tolerance)
    met = np.abs(at(nufft_power(library, points(n, d), fmax, tolerance), f, fmax) - exact).astype(float)
    assert met.max() <= errors.bound
    assert np.sqrt(np.mean(met[EDGE:] ** 2)) < 5 * errors.rms
    same = nufft_power(library, np.repeat(points(1, d), n, axis=0), fmax, tolerance)
    assert np.abs(np.sqrt(same) - np.sqrt(n)).max() <= errors.bound


@each_library
@pytest.mark.parametrize(
    ("n", "d", "fmax", "tolerance"),
    [(20_000, 1, 60_000, 1e-11), (20_000, 2, 300, 1e-10), (20_000, 2, 400, 2e-8), (10_000, 3, 40, 1e-9)],
)
def test_rounding_that_a_small_grid_magnifies_is_within_the_bound(library, n, d, fmax, tolerance):
    bound, largest = nufft_errors(library, n, d, fmax, tolerance).bound, 0.0
    for place in (points(1, d, 5), (np.round(points(1, d, 6) * fmax) + 0.5) / (fmax + 1)):
        cube = nufft_power(library, np.repeat(place, n, axis=0), fmax, tolerance)
        largest = max(largest, float(np.abs(np.sqrt(cube) - np.sqrt(n)).max()))
    assert largest <= bound
    assert bound <= SLACK * largest


def test_the_shift_is_exact_to_five_units():
    x = np.array([0.0, 2.0**-70, 1e-9, 0.1, 0.25, 0.5, 1 / 3, 0.9, 1 - 2.0**-53])
    with mpmath.workdps(60):
        for shift in (1, 7, 2**20 + 1, 10**9 + 7):
            found = shifted(x, np.full(len(x), 0.75), shift)
            for value, one in zip(x, found, strict=True):
                exact = 0.75 * mpmath.expjpi(-2 * shift * mpmath.mpf(float(value)))
                lost = 0 if value == 0 or value >= 2.0**-12 else shift * 2.0**-65  # turns
                assert abs(mpmath.mpc(complex(one)) - exact) <= 5 * 2.0**-53 + 2 * math.pi * lost


@each_library
@pytest.mark.parametrize(("d", "fmax"), [(1, 1), (1, 50), (1, 51), (2, 1), (2, 12), (2, 13), (3, 4), (3, 5)])
def test_half_a_grid_is_the_whole_one_and_exactly_symmetric(monkeypatch, library, d, fmax):
    x = points(90, d)
    layout = cheapest_layout(library, 90, d, fmax, 1e-12)
    cubes = []
    for halved in (True, False):
        monkeypatch.setattr(
            transform_module, "cheapest_layout", lambda *_, halved=halved: replace(layout, halved=halved)
        )
        cube = nufft_power(library, x, fmax, 1e-12)
        assert np.array_equal(cube, cube[(slice(None, None, -1),) * d])
        assert np.array_equal(nufft_power(library, x, fmax, 1e-12, half=True), cube[fmax:])
        cubes.append(cube)
    np.testing.assert_allclose(np.sqrt(cubes[0]), np.sqrt(cubes[1]), atol=1e-10)


@each_library
@pytest.mark.parametrize(("n", "d", "fmax"), [(1000, 2, 64), (5000, 2, 10), (1000, 3, 12), (500, 1, 500)])
@pytest.mark.parametrize("rms", [1e-2, 1e-5, 1e-8, 1e-11, 3e-13])
def test_the_tolerance_for_an_error_reaches_it(library, n, d, fmax, rms):
    (f, exact), x = truth(n, d, fmax, 3, 300), points(n, d, 3)
    tolerance = nufft_tolerance(library, rms, n, d, fmax)
    found = at(nufft_power(library, x, fmax, tolerance), f, fmax)
    met = (found - exact).astype(float)
    assert np.sqrt(np.mean(met[EDGE:] ** 2)) <= rms


@pytest.mark.parametrize("one", LIBRARIES, ids=lambda one: one.name)
def test_an_error_out_of_reach_is_refused_with_what_can_be_reached(one):
    with pytest.raises(
        InputError, match=rf"{one.name} reaches an error of sqrt\(power\) of .*e-1\d .* exact"
    ):
        nufft_tolerance(one, 1e-15)
    assert nufft_tolerance(one, 1e-12, 1000, 2, 64) < 1e-12
    with pytest.raises(InputError, match=r"\|f\| <= 20000000"):
        nufft_tolerance(one, 1e-12, 1000, 1, 20_000_000)
    for rms in (0.0, -1.0, float("nan")):
        with pytest.raises(InputError, match="reaches"):
            nufft_tolerance(one, rms)
    assert nufft_tolerance(one, 10.0) == LOOSEST


@pytest.mark.parametrize("one", LIBRARIES, ids=lambda one: one.name)
@pytest.mark.parametrize("tolerance", [1e-15, 0.0, -1.0, 1.0, float("nan")])
def test_tolerances_out_of_range_are_refused(one, tolerance):
    x = points(5, 2)
    for call in (
        lambda: nufft_power(one, x, 3, tolerance),
        lambda: nufft_errors(one, 5, 2, 3, tolerance),
        lambda: nufft_seconds(one, 5, 2, 3, tolerance),
    ):
        with pytest.raises(InputError, match=f"tolerance of {one.name} must lie in"):
            call()


@each_library
@pytest.mark.parametrize("d", [1, 2, 3])
def test_the_tightest_tolerance_is_one_that_the_library_takes(library, d):
    tightest = library.tightest[d - 1]
    assert nufft_power(library, points(9, d), 2, tightest).shape == (5,) * d
    if library is DUCC0:
        import ducc0

        best = ducc0.nufft.bestEpsilon(ndim=d, singleprec=False)
        assert best <= tightest <= 1.1 * best


def test_four_dimensions_are_refused():
    with pytest.raises(InputError, match="at most 3 dimensions; got d=4"):
        nufft_power(FINUFFT, points(5, 4), 3, 1e-6)
    with pytest.raises(InputError, match="up to 3 dimensions; got d=4"):
        periodogram(points(5, 4), 3, method="nufft")


def test_without_a_library_it_says_so(monkeypatch):
    absent = replace(FINUFFT, package="no_such_package")
    with pytest.raises(InputError, match=r"FINUFFT is not installed here: .*pip install finufft"):
        nufft_power(absent, points(5, 2), 3, 1e-6)
    monkeypatch.setattr(transform_module, "LIBRARIES", (absent,))
    with pytest.raises(InputError, match=r"needs ducc0 or FINUFFT: pip install gbnbench\[fast\]"):
        periodogram(points(5, 2), 3, method="nufft")


def test_libraries_are_loaded_only_when_asked():
    code = (
        "import sys, gbnbench.analysis.spectrum.evaluators.nufft.transform\n"
        "print('finufft' in sys.modules, 'ducc0' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False False"


@each_library
def test_nothing_is_printed(library, capfd):
    for tolerance in (1e-1, 1e-2, 1e-6, 1e-7, 1e-9, 2e-14):
        for d in (1, 2, 3):
            nufft_power(library, points(40, d), 9, tolerance)
    assert capfd.readouterr() == ("", "")
