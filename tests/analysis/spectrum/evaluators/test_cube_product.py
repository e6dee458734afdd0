"""Cubes of power against long double sums over exact phases, in the CPU's form and in a GPU's."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gbnbench.analysis.precision import Precision, precision_of
from gbnbench.analysis.spectrum.digits import cheapest_division, half_size
from gbnbench.analysis.spectrum.evaluators import cube_product, point_slots
from gbnbench.analysis.spectrum.evaluators.cube_product import cube_powers, row_blocks
from gbnbench.analysis.spectrum.evaluators.cube_writer import covered
from gbnbench.analysis.spectrum.evaluators.frequency_group import Group
from gbnbench.analysis.spectrum.evaluators.point_slots import COMPENSATED_FROM
from gbnbench.analysis.spectrum.evaluators.two_group_product import TwoGroupProduct
from gbnbench.opencl import runtime
from tests.devices import gpu_form
from tests.oracles.power import lattice_of, mean_power, on_grid, root_distance, roots

UNIT = {"double": 1e-15, "float": 1e-6}  # typical error allowed, the coordinates' rounding apart


def seen(fmax, d, most=240):
    """All frequencies of a small cube, some of a large one: index in the flattened cube, (m, d)."""
    size = (2 * fmax + 1) ** d
    if size <= most:
        return np.arange(size), lattice_of(fmax, d)
    index = np.unique(np.random.default_rng(size).integers(0, size, most // 4))
    index = np.concatenate([index, [0, size // 2, size // 2 + 1, size - 1]])
    return index, np.stack(np.unravel_index(index, (2 * fmax + 1,) * d), axis=1) - fmax


def check(p, x, fmax, weights=None):
    """Compare a cube with the truth; return it."""
    w = None if weights is None else np.atleast_2d(weights)
    power, errors = cube_powers(p, x, fmax, w)
    d = x.shape[2]
    assert power.shape == (2 * fmax + 1,) * d
    assert power.dtype == np.float64
    assert np.array_equal(power, np.flip(power))
    index, f = seen(fmax, d)
    met = root_distance(power.ravel()[index], mean_power(x, f, weights))
    assert met.max() <= errors.bound
    assert np.sqrt(np.mean(met**2)) <= max(UNIT[p.name], 4 * errors.rms)
    return power


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
                monkeypatch.setattr(cube_product, "cheapest_division", lambda *_, found=found: found)
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


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize(("n", "fmax", "sets"), [(100, 20, 23), (400, 6, 7), (9, 3, 200)])
def test_sets_in_batches_that_they_do_not_fill(monkeypatch, precision, n, fmax, sets):
    monkeypatch.setattr(point_slots, "TABLE_BYTES", 1 << 15)
    p = precision_of(precision)
    divided = cheapest_division(2, fmax, point_slots.tile_rows(p))
    slots = point_slots.choose_slots(p, n, sets, half_size(divided.leading), half_size(divided.trailing))
    assert slots.sets < sets
    assert slots.sets == 1 or sets % slots.sets
    x = on_grid((sets, n, 2), n)
    weights = np.random.default_rng(3).random((sets, n))
    power = check(p, x, fmax, weights)
    each, _ = cube_powers(p, x, fmax, weights, mean=False)
    assert each.shape == (sets, 2 * fmax + 1, 2 * fmax + 1)
    assert np.allclose(each.mean(axis=0), power, rtol=1e-14)
    for k in (0, 4, sets - 1):
        alone, _ = cube_powers(p, x[k : k + 1], fmax, weights[k : k + 1])
        assert np.allclose(np.sqrt(each[k]), np.sqrt(alone), atol=10 * UNIT[precision])


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize("n", [1, 2, 3, 4, 5, 7, 8, 9, 127, 513, 1025, 2047])
def test_points_that_fill_no_lanes_and_no_run(precision, n):
    check(precision_of(precision), on_grid((2, n, 2), n), 2, np.random.default_rng(n).random(n) + 0.1)


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize("form", ["cpu", "gpu", "float sums"])
def test_many_points_take_several_launches_and_keep_their_rounding(monkeypatch, precision, form):
    if form == "float sums" and precision == "double":
        pytest.skip("such a device has no double")
    p = precision_of(precision) if form == "cpu" else gpu_form(precision == "double", form == "gpu")
    monkeypatch.setattr(point_slots, "TABLE_BYTES", 1 << 17)
    n, fmax = 128 * p.lanes * (COMPENSATED_FROM + 5) * (1 if form == "cpu" else 2) + 3, 12
    divided = cheapest_division(2, fmax, point_slots.tile_rows(p))
    slots = TwoGroupProduct(p, n, 2, 1, Group(divided.leading), Group(divided.trailing)).slots
    assert slots.sums(n, p.lanes) > COMPENSATED_FROM
    assert slots.launches(n) > 1
    x = on_grid((1, n, 2), n)
    x[0, : n // 2] = x[0, : n // 2] / 8 + 0.25  # half of them in a cluster, so that the sums are large
    power, errors = cube_powers(p, x, fmax)
    f = np.array([[0, 0], [1, -1], [0, 1], [12, -12], [-7, 5]])
    met = root_distance(power[tuple((f + fmax).T)], mean_power(x, f))
    assert met.max() <= errors.bound
    at_most = {"double": 4e-16, "float": 1e-6}[precision] * np.sqrt(n)
    assert met.max() < at_most


@pytest.mark.parametrize(("d", "fmax"), [(1, 400), (2, 9), (3, 4), (5, 1)])
@pytest.mark.parametrize("form", ["cpu", "gpu"])
def test_rows_in_blocks_change_nothing(monkeypatch, d, fmax, form):
    p = precision_of("double") if form == "cpu" else gpu_form()
    x = on_grid((3, 33, d), d)
    weights = np.random.default_rng(d).random((3, 33))
    whole = [cube_powers(p, x, fmax, weights, half, mean)[0] for half in (0, 1) for mean in (0, 1)]
    monkeypatch.setattr(cube_product, "AMPLITUDE_BYTES", 1 << 10)
    divided = cheapest_division(d, fmax, point_slots.tile_rows(p))
    assert len(list(row_blocks(p, divided))) > 1
    parts = [cube_powers(p, x, fmax, weights, half, mean)[0] for half in (0, 1) for mean in (0, 1)]
    for one, other in zip(whole, parts, strict=True):
        assert np.allclose(np.sqrt(one), np.sqrt(other), rtol=0, atol=1e-13)
    check(p, x, fmax, weights)


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


@pytest.mark.parametrize(("n", "sets"), [(1, 3000), (2, 700), (16, 100)])
def test_many_small_sets_do_not_ask_for_more_than_the_room_of_amplitudes(n, sets):
    p = precision_of("double")
    divided = cheapest_division(2, 1023, point_slots.tile_rows(p))
    rows, columns = half_size(divided.leading), half_size(divided.trailing)
    slots = point_slots.choose_slots(p, n, sets, rows, columns)
    assert slots.count * rows * columns * 4 * 8 <= cube_product.AMPLITUDE_BYTES


def test_the_cover_is_the_cube_with_a_few_beyond_on_one_axis():
    for d, fmax in ((1, 10), (2, 6), (3, 2)):
        shape = covered(cheapest_division(d, fmax, 3), d)
        assert sum(have != 2 * fmax + 1 for have in shape) <= 1
        assert all(have >= 2 * fmax + 1 for have in shape)


def test_a_device_named_otherwise_is_a_runtime_of_its_own():
    assert gpu_form().runtime.group == 64
    assert gpu_form().runtime.device == replace(runtime().device, is_cpu=False)


@pytest.mark.parametrize("precision", ["double", "float"])
def test_no_frequency_gathers_the_rounding_of_two_pi(precision):
    # 2 pi rounded once turns every angle by the same share, which added up at multiples of 4.
    n = 65_536
    x = np.random.default_rng(12).integers(0, 2**32, (1, n, 1)) / 2.0**32
    power, errors = cube_powers(precision_of(precision), x, 200)
    f = np.arange(4, 201, 4)[:, None]
    away = np.sqrt(power[f[:, 0] + 200]) - roots(x[0], f)
    assert np.abs(away).max() <= 6 * errors.rms
