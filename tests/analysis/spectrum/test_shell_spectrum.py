"""Shells without the cube against those of the whole cube, and their memory."""

from __future__ import annotations

import json
import math
import re

import numpy as np
import pandas as pd
import pytest

from gbnbench.analysis.radial.anisotropy import anisotropy
from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spectrum import request
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.request import shell_request
from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.core.errors import InputError
from tests.oracles.power import lattice_of, mean_power, on_grid
from tests.processes import NO_DEVICE, python


def of_cube(spectrum, low, high):
    """Counts, means and deviations of a cube's shells low <= |f|^2 <= high."""
    f = lattice_of(spectrum.fmax, spectrum.d)
    square = (f**2).sum(axis=1)
    power = spectrum.power.ravel()
    wanted = np.unique(square[(square >= max(low, 1)) & (square <= high)])
    held = [power[square == s] for s in wanted]
    return (
        np.sqrt(wanted),
        [len(p) for p in held],
        [p.mean() for p in held],
        [((p - p.mean()) ** 2).sum() / 2 for p in held],
    )


@pytest.mark.parametrize(
    ("d", "fmax", "options", "low", "high"),
    [
        *((d, f, {}, 1, f * f) for d, f in ((1, 9), (2, 12), (3, 5), (5, 2), (8, 1))),
        *((d, f, {"corners": True}, 1, d * f * f) for d, f in ((1, 4), (2, 7), (3, 3), (7, 1))),
        *((d, 6, {"band": (2, 5)}, 4, 25) for d in (1, 2, 3)),
        (2, 10, {"band": (0, math.sqrt(13))}, 1, 13),
        (2, 10, {"band": (math.sqrt(13), math.sqrt(13))}, 13, 13),
        (3, 3, {"band": (3.5, 4.9), "corners": True}, 13, 24),
        (2, 10, {"band": (math.sqrt(50) + 1e-9, 10)}, 51, 100),
    ],
)
@pytest.mark.parametrize("precision", ["double", "float"])
def test_shells_are_those_of_the_cube(d, fmax, options, low, high, precision):
    x, weights = on_grid((3, 60, d), d), np.random.default_rng(d).standard_normal((3, 60))
    for w in (None, weights):
        got = shells(x, fmax, precision, weights=w, **options)
        radius, count, mean, deviation = of_cube(periodogram(x, fmax, weights=w), low, high)
        relative = 1e-12 if precision == "double" else 1e-5
        assert np.array_equal(got.frequency, radius)
        assert got.count.tolist() == count
        assert np.allclose(got.power, mean, rtol=relative, atol=0)
        assert np.allclose(got.deviation, deviation, rtol=10 * relative, atol=10 * relative)
        assert np.allclose(got.nu, radius * 60 ** (-1 / d))
        assert (got.n, got.d, got.realizations, got.fmax, got.precision) == (60, d, 3, fmax, precision)
        assert 0 < got.error_rms < got.error_bound < 1e-3


@pytest.mark.parametrize(("d", "fmax", "n"), [(1, 20, 30), (2, 20, 200), (3, 6, 100), (6, 2, 50)])
def test_radial_and_anisotropy_are_those_of_the_cube(d, fmax, n):
    x = on_grid((2, n, d), d)
    cube, got = periodogram(x, fmax), shells(x, fmax)
    for one, other in (
        (radial(cube).to_frame(), got.radial().to_frame()),
        (anisotropy(cube), anisotropy(got)),
    ):
        pd.testing.assert_frame_equal(one, other, rtol=1e-9)
    pd.testing.assert_frame_equal(anisotropy(periodogram(x, fmax, half=True)), anisotropy(cube))
    assert got.to_frame().columns.tolist() == ["frequency", "nu", "power", "count", "deviation"]


@pytest.mark.parametrize(("n", "d", "fmax"), [(5, 12, 1), (3, 10, 2), (4, 20, 1)])
def test_high_dimensions_by_brute_force(n, d, fmax):
    """Sums over shells as coefficients of polynomials, without any list of frequencies.

    The sum of P(f) over |f|^2 = s is the coefficient of z^s in the sum over pairs (j, k), over n, of the
    product over axes of sum_f z^(f^2) cos 2 pi f (x_ja - x_ka).
    """
    x = on_grid((n, d), n)
    total = np.zeros(d * fmax**2 + 1)
    counted = np.zeros_like(total)
    for j in range(n):
        for k in range(n):
            polynomial = plain = np.ones(1)
            for a in range(d):
                factor, ones = np.zeros(fmax**2 + 1), np.zeros(fmax**2 + 1)
                for f in range(-fmax, fmax + 1):
                    factor[f * f] += math.cos(2 * math.pi * f * (x[j, a] - x[k, a]))
                    ones[f * f] += 1
                polynomial, plain = np.convolve(polynomial, factor), np.convolve(plain, ones)
            total += polynomial / n
            counted = plain
    for corners in (False, True) if (2 * fmax + 1) ** d < 1e8 else (False,):
        got = shells(x, fmax, corners=corners)
        square = np.rint(got.frequency**2).astype(int)
        assert square.tolist() == [s for s in range(1, (d if corners else 1) * fmax**2 + 1) if counted[s]]
        assert got.count.tolist() == counted[square].tolist()
        assert np.allclose(got.power * got.count, total[square], rtol=1e-10, atol=1e-9 * n)


def test_high_dimensions_against_the_sum_itself():
    x = on_grid((9, 12), 1)
    got = shells(x, 1)
    assert got.count.tolist() == [24]
    assert got.power[0] == pytest.approx(float(mean_power(x[None], np.eye(12, dtype=int)).mean()), rel=1e-13)
    assert shells(on_grid((4, 10)), 2).count.tolist() == [20, 180, 960, 3380]


@pytest.mark.slow
def test_every_frequency_of_twelve_dimensions_in_little_memory():
    code = """
import json, pathlib, re, numpy as np, gbnbench.analysis.spectrum.shell_spectrum
x = np.random.default_rng(0).integers(0, 2**53, (32, 12)) / 2.0**53
s = gbnbench.analysis.spectrum.shell_spectrum.shells(x, 2, corners=True)
memory = int(re.search(r"VmHWM:\\s+(\\d+)", pathlib.Path("/proc/self/status").read_text())[1])
print(json.dumps([s.count.tolist(), float(s.power @ s.count), memory]))
"""
    done = python(code)
    count, total, memory = json.loads(done.stdout)
    plain = np.ones(1)
    for _ in range(12):
        plain = np.convolve(plain, [1, 2, 0, 0, 2])
    assert count == [int(c) for c in plain[1:] if c]
    x = np.random.default_rng(0).integers(0, 2**53, (32, 12)) / 2.0**53
    away = x[:, None] - x
    kernel = (1 + 2 * np.cos(2 * np.pi * away) + 2 * np.cos(4 * np.pi * away)).prod(axis=2)
    assert total == pytest.approx(kernel.sum() / 32 - 32, rel=1e-9)  # all but zero frequency
    assert memory * 1024 < 1e9


@pytest.mark.parametrize(
    ("d", "arguments", "says"),
    [
        (2, {"fmax": 0}, "at least 1"),
        (2, {"fmax": 2.5}, "integer"),
        (30, {"fmax": 2, "corners": True}, "more than 2^63"),
        (100, {"fmax": 4}, "cannot be listed"),
        (2, {"fmax": 5, "band": (1.2, 1.3)}, "no integer frequency"),
        (2, {"fmax": 5, "band": (0, 0)}, "no integer frequency"),
        (2, {"fmax": 5, "band": (1.7, 1.75)}, "no integer frequency"),  # 3 is no sum of two squares
        (1, {"fmax": 5, "band": (1.7, 1.75)}, "no integer frequency"),
        (2, {"fmax": 5, "band": (3, 2)}, "low <= high"),
        (2, {"fmax": 5, "band": (-1, 2)}, "low <= high"),
        (2, {"fmax": 5, "band": (1, math.nan)}, "low <= high"),
        (2, {"fmax": 5, "band": (1, 5.5)}, "fmax=6"),
        (2, {"fmax": 5, "band": (1, 9), "corners": True}, "beyond"),
        (2, {"fmax": 5, "band": 3}, "two numbers"),
        (2, {"fmax": 5, "band": (1, 2, 3)}, "two numbers"),
        (2, {"fmax": 5, "band": "ab"}, "two numbers"),
        (2, {"fmax": 5, "precision": "half"}, "double"),
        (2, {"fmax": 5, "weights": [1, 2]}, "weights must be"),
        (2, {"fmax": 5, "floor": 1e-60}, "out of reach"),
        (2, {"fmax": 70000}, "32 bits"),
        (2, {"fmax": 60000}, "memory"),  # 3.6e9 shells, 86 GB
    ],
)
def test_bad_requests_are_refused_in_words(d, arguments, says):
    with pytest.raises(InputError) as refusal:
        shells(on_grid((7, d)), **arguments)
    assert says in str(refusal.value)


@pytest.mark.parametrize(("d", "corners"), [(1, False), (1, True), (2, False), (2, True)])
def test_the_largest_harmonic_of_32_bits_is_the_one_that_is_named(d, corners):
    with pytest.raises(InputError, match="32 bits") as refusal:
        shell_request(10, d, 70_000, 1, (69_000, 70_000), corners)
    named = int(re.findall(r"fmax here is (\d+)", str(refusal.value))[0])
    assert shell_request(10, d, named, 1, (named - 1, named), corners).fmax == named
    assert d * (named + 1) ** 2 >= 1 << 32 if corners else (named + 1) ** 2 >= 1 << 32


@pytest.mark.parametrize(("d", "fmax"), [(2, 8000), (3, 300)])
def test_shells_and_groups_that_would_fill_the_memory_are_refused(monkeypatch, d, fmax):
    # There are 6.4e7 shells, or 2.8e5 frequencies in a group's ball.
    monkeypatch.setattr(request, "memory_limit", lambda: 8 << 20)
    with pytest.raises(InputError, match="memory"):
        shell_request(10, d, fmax, 1, None, False)


def test_without_a_device_a_cube_that_cannot_fit_is_refused():
    code = """
import numpy as np
from gbnbench.analysis.spectrum.shell_spectrum import shells
x = np.random.default_rng(0).random((5, 12))
try:
    shells(x, 3)
except Exception as error:
    print(type(error).__name__, error)
"""
    done = python(code, **NO_DEVICE)
    assert done.stdout.startswith("InputError")
    assert "memory" in done.stdout


def test_by_default_shells_go_as_far_as_nu_2_or_is_affordable():
    rng = np.random.default_rng(20)
    assert shells(rng.random((64, 2))).nu[-1] >= 2
    assert shells(rng.random((64, 2)), band=(2.5, 3.5)).fmax == 4
    deep = shells(rng.random((20, 10)))
    assert 2 <= deep.fmax <= 4
