"""Which evaluation is chosen and that it really does what it was chosen for."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.spectrum.error_model import rms_for
from gbnbench.analysis.spectrum.evaluators.nufft import transform as nufft
from gbnbench.analysis.spectrum.evaluators.registry import title_of
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.plan import plan
from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.core.errors import InputError
from gbnbench.opencl import runtime
from tests.oracles.power import mean_power, on_grid, root_distance

FLOORS = tuple(10.0**-k for k in range(0, 30, 2))
EXACT = ("product", "gridded", "fft")
REQUESTS = {
    "small square": {"n": 100, "d": 2, "fmax": 12},
    "square": {"n": 1024, "d": 2, "fmax": 64},
    "many sets": {"n": 256, "d": 2, "fmax": 30, "realizations": 16},
    "half": {"n": 500, "d": 3, "fmax": 8, "half": True},
    "line": {"n": 3000, "d": 1, "fmax": 5000},
    "large square": {"n": 20_000, "d": 2, "fmax": 200},
    "high dimension": {"n": 500, "d": 8, "fmax": 1},
    "listed": {"n": 500, "d": 3, "fmax": 10**5, "frequencies": 40},
    "shells": {"n": 64, "d": 10, "fmax": 2, "shells": True},
    "band": {"n": 64, "d": 3, "fmax": 9, "band": (3, 7)},
    "corners": {"n": 64, "d": 4, "fmax": 3, "corners": True},
}


@pytest.mark.parametrize("name", REQUESTS)
def test_without_a_floor_it_is_exact_in_the_precision_asked_for(name):
    for precision in ("double", "float"):
        found = plan(**REQUESTS[name], precision=precision)
        assert found.precision == precision
        expected = {"listed": ("direct",)}.get(name, EXACT)
        if name in ("shells", "band", "corners"):
            expected = ("shells",)
        assert found.method in expected
        assert found.flops > 0
        assert found.bytes > 0
        assert found.seconds > 0
        assert 0 < found.errors.rms < found.errors.bound
        assert found.chosen.against == ""
        assert all(other.against for other in found.others)


@pytest.mark.parametrize("name", REQUESTS)
def test_a_deeper_floor_is_never_answered_by_less(name):
    usual = plan(**REQUESTS[name])
    deepest = min(c.errors.resolvable for c in (usual.chosen, *usual.others))
    reached, seconds = math.inf, 0.0
    for floor in FLOORS:
        if floor < deepest:
            with pytest.raises(InputError, match="out of reach: the least power known to 1% here is"):
                plan(**REQUESTS[name], floor=floor)
            continue
        found = plan(**REQUESTS[name], floor=floor)
        assert found.errors.resolvable <= floor * (1 + 1e-6)
        assert found.errors.resolvable <= reached * (1 + 1e-6)
        assert found.seconds >= seconds * (1 - 1e-9)
        reached, seconds = found.errors.resolvable, found.seconds
        others = [c for c in found.others if c.against == "slower"]
        assert all(c.cost.seconds >= found.seconds for c in others)


@pytest.mark.parametrize("name", REQUESTS)
def test_it_says_what_why_and_at_what_cost(name):
    for options in ({}, {"precision": "float"}, {"floor": 1e-6}, {"floor": 1e-20}):
        found = plan(**REQUESTS[name], **options)
        text = found.explain()
        assert text == str(found)
        assert title_of(found.method) in text
        assert "because" in text
        assert "flop" in text
        assert "B, about" in text
        assert " s\n" in text
        assert runtime().device.name in text or "FINUFFT" in text or "ducc0" in text
        assert "is known to 1%" in text
        assert f"{found.request.n:,} points" in text
        if "floor" in options:
            assert f"{options['floor']:g}" in text
        for other in found.others:
            assert f"not {other.evaluator.label}" in text


def test_the_frequencies_it_counts_are_those_there_are():
    assert plan(10, 3, 4).request.frequencies == 9**3
    assert plan(10, 3, 4, frequencies=17).request.frequencies == 17
    cases = ((1, 7, {}), (1, 7, {"band": (2, 5)}), (2, 1, {}), (2, 9, {}), (3, 4, {"corners": True}))
    for d, fmax, options in (*cases, (6, 2, {}), (3, 5, {"band": (2, 4.5)})):
        counted = plan(10, d, fmax, shells=True, **options).request.frequencies
        assert counted == shells(on_grid((5, d)), fmax, **options).count.sum()


@pytest.mark.parametrize("name", ["small square", "square", "half", "line", "high dimension"])
@pytest.mark.parametrize("floor", [1e-3, 1e-8, 1e-11, 1e-18, 1e-24])
def test_what_is_chosen_has_the_error_that_the_floor_allows(name, floor):
    request = dict(REQUESTS[name])
    n, d, fmax, half = request["n"], request["d"], request["fmax"], request.get("half", False)
    x = on_grid((n, d), n)
    spectrum = periodogram(x, fmax, floor=floor, half=half)
    f = np.random.default_rng(n).integers(-fmax, fmax + 1, (100, d))
    f = f[f.any(axis=1)]
    cube = spectrum.whole().power
    met = root_distance(cube[tuple((f + fmax).T)], mean_power(x[None], f))
    assert np.sqrt(np.mean(met**2)) <= 1.3 * rms_for(floor)
    assert spectrum.resolvable <= floor * (1 + 1e-6)


@pytest.mark.parametrize("floor", [1e-3, 1e-6, 1e-9, 1e-12, 1e-16, 1e-20, 1e-24])
@pytest.mark.parametrize(("d", "m", "fmax"), [(1, 512, 200), (2, 32, 15)])
def test_a_power_as_low_as_the_floor_is_seen_to_1_percent(floor, d, m, fmax):
    """A lattice moved by a wave of small random size has powers near the floor off its harmonics."""
    rng = np.random.default_rng(m)
    lattice = np.stack(np.meshgrid(*[np.arange(m) / m] * d, indexing="ij"), axis=-1).reshape(-1, d)
    size = math.sqrt(floor) / (2 * math.pi * fmax)
    x = (lattice + size * rng.standard_normal(lattice.shape)) % 1
    f = rng.integers(-fmax, fmax + 1, (200, d))
    f = f[np.abs(f).max(axis=1) > fmax // 2]
    truth = mean_power(x[None], f)
    spectrum = periodogram(x, fmax, floor=floor)
    found = spectrum.power[tuple((f + fmax).T)]
    at_floor = (truth > floor / 2) & (truth < 20 * floor)
    assert at_floor.sum() > 10
    off = np.abs(found / truth - 1)[at_floor].astype(float) * np.sqrt(truth[at_floor].astype(float) / floor)
    assert np.sqrt(np.mean(off**2)) <= 0.015


def test_listed_frequencies_and_shells_take_float_where_it_suffices():
    assert plan(500, 3, 50, frequencies=40, floor=1e-6).precision == "float"
    assert plan(500, 3, 50, frequencies=40, floor=1e-20).precision == "double"
    assert plan(64, 10, 2, shells=True, floor=1e-6).precision == "float"
    assert plan(64, 10, 2, shells=True, floor=1e-20).precision == "double"
    x = on_grid((200, 4), 2)
    assert shells(x, 3, floor=1e-6).precision == "float"
    assert shells(x, 3, floor=1e-20).precision == "double"
    assert np.allclose(shells(x, 3, floor=1e-6).power, shells(x, 3).power, rtol=1e-4)


@pytest.mark.skipif(not nufft.installed(), reason="neither ducc0 nor finufft is installed")
def test_a_transform_to_a_tolerance_is_weighed_only_where_the_floor_allows():
    found = plan(100_000, 2, 300, floor=1e-6)
    assert "cheapest that knows" in found.why
    against = {c.evaluator.method: c.against for c in (found.chosen, *found.others)}
    assert against["nufft"] in ("", "slower")
    exact = plan(100_000, 2, 300)
    assert exact.method in EXACT
    assert {c.against for c in exact.others if c.evaluator.method == "nufft"} != {"slower"}
    assert plan(100_000, 4, 8, floor=1e-6).method in EXACT
    assert plan(100_000, 2, 300, "float", floor=1e-6).method in EXACT


@pytest.mark.parametrize("method", [*EXACT, "nufft", "numpy"])
@pytest.mark.parametrize("precision", ["double", "float"])
def test_a_method_by_name_is_taken_or_refused_in_words(method, precision):
    if method == "nufft" and not nufft.installed():
        pytest.skip("neither ducc0 nor finufft is installed")
    x = on_grid((90, 2), 3)
    f = np.indices((41, 41)).reshape(2, -1).T[::29] - 20
    if method == "nufft" and precision == "float":
        with pytest.raises(InputError, match="float"):
            periodogram(x, 20, precision, method=method)
        return
    spectrum = periodogram(x, 20, precision, method=method)
    assert spectrum.method == method
    assert spectrum.precision == precision
    met = root_distance(spectrum.power[tuple((f + 20).T)], mean_power(x[None], f))
    assert met.max() <= spectrum.error_bound


@pytest.mark.parametrize(("n", "d", "fmax"), [(4096, 3, 300), (10_000, 3, 390), (100_000, 2, 9000)])
def test_what_is_chosen_fits_in_the_devices_buffers(n, d, fmax):
    from gbnbench.analysis.spectrum.digits import half_size, whole_axes
    from gbnbench.analysis.spectrum.evaluators.kaiser_bessel import nodes_for

    try:
        found = plan(n, d, fmax)
    except InputError:
        return  # nor does the cube
    if found.method == "gridded":
        grid = nodes_for(fmax, 1) * half_size(whole_axes(d, fmax)[1:]) * 2 * 8
        assert grid <= runtime().largest_buffer
        assert found.bytes >= 8 * (2 * fmax + 1) ** d + 2 * grid  # the grid and it folded


def test_a_rectangle_is_planned_as_its_box_and_its_shells_as_they_are_listed() -> None:
    box = plan(64, 2, 20, sides=(3, 1))
    assert box.request.frequencies == periodogram(np.full((1, 2), 0.5), 20, sides=(3, 1)).power.size
    assert "box: 1,587 frequencies, |f_a| <= 34, 11" in box.explain()
    assert plan(64, 12, 2, shells=True, sides=(3, *(1,) * 11)).method == "direct"
    with pytest.raises(InputError, match="corners"):
        plan(64, 2, 20, corners=True, sides=(3, 1))
