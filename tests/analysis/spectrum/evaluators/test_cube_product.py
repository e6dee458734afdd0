"""Cubes of power against long double sums over exact phases, in the CPU's form and in a GPU's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gbnbench.analysis.precision import Precision, precision_of
from gbnbench.analysis.spectrum.digits import cheapest_division, half_size, zero_apart
from gbnbench.analysis.spectrum.evaluators import kept_memory, prepared_cube
from gbnbench.analysis.spectrum.evaluators.cube_product import cube_powers
from gbnbench.analysis.spectrum.evaluators.cube_writer import covered
from gbnbench.analysis.spectrum.evaluators.point_slots import tile_columns, tile_rows
from gbnbench.opencl import runtime
from tests.analysis.spectrum.evaluators.cube_truth import UNIT, check
from tests.devices import gpu_form
from tests.oracles.power import lattice_of, mean_power, on_grid, root_distance, roots


@pytest.mark.parametrize(
    ("n", "d", "fmax"),
    [
        *((1, 1, 1), (2, 1, 2), (3, 1, 7), (100, 1, 3), (77, 1, 52), (60, 1, 1000), (9, 1, 2**17)),
        *((1, 2, 3), (2, 2, 1), (33, 2, 2), (50, 2, 9), (129, 2, 40)),
        *((3, 3, 1), (21, 3, 2), (64, 3, 3), (65, 3, 5), (40, 3, 11)),
        *((31, 4, 2), (30, 5, 1), (10, 5, 2), (17, 5, 3), (12, 6, 2)),
        *((11, 7, 1), (5, 7, 2), (19, 9, 1), (6, 12, 1)),
    ],
)  # fmt: skip
@pytest.mark.parametrize("precision", ["double", "float"])
def test_every_division_and_axis_split(n, d, fmax, precision):
    check(precision_of(precision), on_grid((1, n, d), n), fmax)


def test_every_place_that_the_axis_can_be_divided_at_gives_the_same_cube(monkeypatch):
    from gbnbench.analysis.spectrum.digits import division, whole_axes

    for d, fmax in ((1, 5), (2, 4), (3, 2)):
        x = on_grid((2, 37, d), d)
        truth = mean_power(x, lattice_of(fmax, d))
        for at in range(d):
            for fine in range(fmax + 1):
                found = division(whole_axes(d, fmax), at, fine)
                monkeypatch.setattr(prepared_cube, "cheapest_division", lambda *_, found=found: found)
                kept_memory.forget()
                for half in (False, True):
                    power, errors = cube_powers(precision_of("double"), x, fmax, half=half)
                    wanted = truth[len(truth) // (2 * fmax + 1) * fmax :] if half else truth
                    assert root_distance(power.ravel(), wanted).max() <= errors.bound, (
                        d,
                        fmax,
                        at,
                        fine,
                        half,
                    )


@pytest.mark.parametrize("shared", [True, False])
@pytest.mark.parametrize("precision", ["double", "float"])
def test_weights_of_any_sign_and_zero(precision, shared):
    rng = np.random.default_rng(1)
    x = on_grid((5, 75, 3), 2)
    weights = rng.standard_normal((1 if shared else 5, 75))
    weights[:, ::7] = 0
    weights[:, 1] = 1e-30
    weights /= np.abs(weights).max(axis=1, keepdims=True)
    power = check(precision_of(precision), x, 3, weights)
    each, _ = cube_powers(precision_of(precision), x, 3, weights, mean=False)
    assert np.allclose(each.mean(axis=0), power, rtol=1e-14)
    assert np.allclose(
        check(precision_of(precision), x, 3, np.ones((1, 75))), check(precision_of(precision), x, 3)
    )


@pytest.mark.parametrize(("d", "fmax"), [(1, 1), (1, 33), (2, 6), (3, 2), (3, 5), (5, 1), (7, 1)])
@pytest.mark.parametrize("mean", [False, True])
def test_half_is_the_half_with_f_0_from_0_up(d, fmax, mean):
    p = precision_of("double")
    x = on_grid((3, 50, d), d)
    weights = np.random.default_rng(d).random((3, 50))
    whole, errors = cube_powers(p, x, fmax, weights, mean=mean)
    half, errors_of_half = cube_powers(p, x, fmax, weights, half=True, mean=mean)
    assert errors == errors_of_half
    wanted = whole[fmax:] if mean else whole[:, fmax:]
    assert half.shape == wanted.shape
    assert np.array_equal(half, wanted)


FORMS = {
    "gpu, double": lambda: gpu_form(True),
    "gpu, float": lambda: gpu_form(False),
    "gpu, float sums": lambda: gpu_form(False, has_double=False),
    "one lane": lambda: Precision(runtime(), True, 1),
    "two lanes": lambda: Precision(runtime(), True, 2),
    "four floats": lambda: Precision(runtime(), False, 4),
    "one float": lambda: Precision(runtime(), False, 1),
}


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(
    ("n", "d", "fmax"),
    [(1, 1, 1), (300, 1, 90), (700, 2, 7), (129, 2, 33), (50, 3, 3), (20, 5, 1), (9, 7, 1)],
)
def test_every_form_of_the_kernels_agrees_with_the_truth(form, n, d, fmax):
    p = FORMS[form]()
    x = on_grid((3, n, d), n)
    weights = np.random.default_rng(n).standard_normal((3, n))
    weights /= np.abs(weights).max(axis=1, keepdims=True)
    power = check(p, x, fmax, weights)
    half, _ = cube_powers(p, x, fmax, weights, half=True)
    assert np.array_equal(half, power[fmax:])
    each, _ = cube_powers(p, x, fmax, weights, mean=False)
    assert np.allclose(each.mean(axis=0), power, rtol=1e-6 if p.sum is np.float32 else 1e-13)


@pytest.mark.parametrize("form", ["gpu", "four lanes", "eight floats", "double", "float"])
@pytest.mark.parametrize("points", [45, 5001])
def test_frequency_zero_is_summed_apart_behind_whole_parts_of_blocks(form, points):
    forms = {
        "gpu": gpu_form,
        "four lanes": lambda: Precision(runtime(), True, 4),
        "eight floats": lambda: Precision(runtime(), False, 8),
    }
    p = forms[form]() if form in forms else precision_of(form)
    part = tile_columns(p)
    weights = np.random.default_rng(points).uniform(-1, 1, (2, points))
    apart = 0
    for d, fmax in ((1, 12), (2, 4), (2, 8), (3, 4), (4, 1), (4, 4), (8, 1)):
        columns = half_size(cheapest_division(d, fmax, tile_rows(p), part).trailing)
        apart += zero_apart(columns, part)
        check(p, on_grid((2, points, d), fmax), fmax, weights)
    assert apart >= (0 if part == 1 else 2)


@settings(max_examples=15, deadline=None, derandomize=True)
@given(st.integers(1, 4), st.integers(1, 90), st.integers(0, 2**32 - 1), st.sampled_from(["double", "float"]))
def test_power_keeps_under_reordering_shifts_and_exchanged_axes(d, n, seed, precision):
    rng = np.random.default_rng(seed)
    p, fmax = precision_of(precision), 3
    grid = rng.integers(0, 2**30, (1, n, d))
    x, weights = grid / 2.0**30, rng.random((1, n))
    order, axes, shift = rng.permutation(n), rng.permutation(d), rng.integers(0, 2**30, d)
    power, errors = cube_powers(p, x, fmax, weights)
    same = [
        cube_powers(p, x[:, order], fmax, weights[:, order])[0],
        cube_powers(p, (grid + shift) % 2**30 / 2.0**30, fmax, weights)[0],
        np.transpose(cube_powers(p, np.ascontiguousarray(x[..., axes]), fmax, weights)[0], np.argsort(axes)),
        cube_powers(p, (-grid) % 2**30 / 2.0**30, fmax, weights)[0],
        cube_powers(p, x, fmax, -weights)[0],
    ]
    for other in same:
        assert np.abs(np.sqrt(other) - np.sqrt(power)).max() <= 2 * errors.bound
        assert np.sqrt(np.mean((np.sqrt(other) - np.sqrt(power)) ** 2)) <= 6 * UNIT[precision]


def test_a_product_of_one_dimensional_sets_has_the_product_of_their_powers():
    one, other = on_grid((13, 1), 1), on_grid((17, 1), 2)
    x = np.array([[[a, b] for a in one[:, 0] for b in other[:, 0]]])
    p = precision_of("double")
    parts = [cube_powers(p, part[None], 9)[0] for part in (one, other)]
    assert np.allclose(cube_powers(p, x, 9)[0], np.outer(*parts), rtol=1e-11, atol=1e-26)


def test_the_cover_is_the_cube_with_a_few_beyond_on_one_axis():
    for d, fmax in ((1, 10), (2, 6), (3, 2)):
        shape = covered(cheapest_division(d, fmax, 3), d)
        assert sum(have != 2 * fmax + 1 for have in shape) <= 1
        assert all(have >= 2 * fmax + 1 for have in shape)


def test_a_device_named_otherwise_is_a_runtime_of_its_own():
    assert gpu_form().runtime.group == 64
    assert gpu_form().runtime.device == replace(runtime().device, is_cpu=False)


@pytest.mark.parametrize("precision", ["double", pytest.param("float", marks=pytest.mark.slow)])
def test_no_frequency_gathers_the_rounding_of_two_pi(precision):
    # 2 pi rounded once turns every angle by the same share, which added up at multiples of 4.
    n = 65_536
    x = np.random.default_rng(12).integers(0, 2**32, (1, n, 1)) / 2.0**32
    power, errors = cube_powers(precision_of(precision), x, 200)
    f = np.arange(4, 201, 4)[:, None]
    away = np.sqrt(power[f[:, 0] + 200]) - roots(x[0], f)
    assert np.abs(away).max() <= 6 * errors.rms
