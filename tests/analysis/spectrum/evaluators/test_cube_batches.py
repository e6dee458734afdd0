"""Cubes of power in batches of sets, several launches and blocks of rows: none changes the power."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.precision import precision_of
from gbnbench.analysis.spectrum.coordinate_rounding import rounded_at_worst
from gbnbench.analysis.spectrum.digits import cheapest_division, half_size
from gbnbench.analysis.spectrum.evaluators import kept_memory, point_slots, prepared_cube, row_runs
from gbnbench.analysis.spectrum.evaluators.cube_product import cube_powers
from gbnbench.analysis.spectrum.evaluators.frequency_group import Group
from gbnbench.analysis.spectrum.evaluators.point_slots import COMPENSATED_FROM
from gbnbench.analysis.spectrum.evaluators.row_runs import row_blocks
from gbnbench.analysis.spectrum.evaluators.two_group_product import TwoGroupProduct, product_errors
from gbnbench.analysis.spectrum.request import SpectrumRequest
from tests.analysis.spectrum.evaluators.cube_truth import UNIT, check
from tests.devices import gpu_form
from tests.oracles.power import mean_power, on_grid, root_distance


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize(("n", "fmax", "sets"), [(100, 20, 23), (400, 6, 7), (9, 3, 199)])
def test_sets_in_batches_that_they_do_not_fill(monkeypatch, precision, n, fmax, sets):
    monkeypatch.setattr(point_slots, "TABLE_BYTES", 1 << 15)
    monkeypatch.setattr(point_slots, "OWN_BATCH", 1 << 12)
    monkeypatch.setattr(point_slots, "LEAST_ITEMS", 1)
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
    check(precision_of(precision), on_grid((2, n, 2), n), 4, np.random.default_rng(n).random(n) + 0.1)


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
    assert slots.sums(n) > COMPENSATED_FROM
    assert slots.launches(n) > 1
    x = on_grid((1, n, 2), n)
    x[0, : n // 2] = x[0, : n // 2] / 8 + 0.25  # half of them in a cluster, so that the sums are large
    power, errors = cube_powers(p, x, fmax)
    f = np.array([[0, 0], [1, -1], [0, 1], [12, -12], [-7, 5]])
    met = root_distance(power[tuple((f + fmax).T)], mean_power(x, f))
    assert met.max() <= errors.bound
    at_most = {"double": 4e-16, "float": 1e-6}[precision] * np.sqrt(n)
    assert met.max() < at_most


@pytest.mark.parametrize(("d", "fmax"), [(1, 400), (2, 9), (3, 4), (6, 1)])
@pytest.mark.parametrize("form", ["cpu", "gpu"])
def test_rows_in_blocks_change_nothing(monkeypatch, d, fmax, form):
    p = precision_of("double") if form == "cpu" else gpu_form()
    x = on_grid((3, 33, d), d)
    weights = np.random.default_rng(d).random((3, 33))
    whole = [cube_powers(p, x, fmax, weights, half, mean)[0] for half in (0, 1) for mean in (0, 1)]
    monkeypatch.setattr(row_runs, "AMPLITUDE_BYTES", 1 << 10)
    kept_memory.forget()
    divided = cheapest_division(d, fmax, point_slots.tile_rows(p))
    assert len(list(row_blocks(p, divided, 33))) > 1
    parts = [cube_powers(p, x, fmax, weights, half, mean)[0] for half in (0, 1) for mean in (0, 1)]
    for one, other in zip(whole, parts, strict=True):
        assert np.allclose(np.sqrt(one), np.sqrt(other), rtol=0, atol=1e-13)
    check(p, x, fmax, weights)


@pytest.mark.parametrize(("n", "sets"), [(1, 3000), (2, 700), (16, 100)])
def test_many_small_sets_do_not_ask_for_more_than_the_room_of_amplitudes(n, sets):
    p = precision_of("double")
    divided = cheapest_division(2, 1023, point_slots.tile_rows(p))
    rows, columns = half_size(divided.leading), half_size(divided.trailing)
    slots = point_slots.choose_slots(p, n, sets, rows, columns)
    assert slots.count * rows * columns * 4 * 8 <= point_slots.AMPLITUDE_BYTES


@pytest.mark.parametrize("form", ["cpu", "gpu"])
@pytest.mark.parametrize(
    ("n", "d", "fmax", "sets", "room"),
    [(300, 4, 2, 3, None), (5000, 4, 2, 1, None), (9000, 3, 3, 2, 1 << 12), (5000, 2, 30, 1, 1 << 14)],
)
def test_the_plan_foresees_the_memory_and_the_bound(monkeypatch, form, n, d, fmax, sets, room):
    p = precision_of("double") if form == "cpu" else gpu_form()
    if room is not None:
        monkeypatch.setattr(row_runs, "AMPLITUDE_BYTES", room)
    kept_memory.forget()
    x = np.random.default_rng(n).random((sets, n, d))
    request = SpectrumRequest("cube", n, d, fmax, sets, (2 * fmax + 1) ** d)
    runs = row_runs.planned_runs(p, request)
    cut = row_runs.row_blocks(
        p, cheapest_division(d, fmax, point_slots.tile_rows(p), point_slots.tile_columns(p)), n
    )
    assert sum(run.times for run in runs) == len(list(cut))
    assert (sum(run.times for run in runs) > 1) == (room is not None)
    _, errors = cube_powers(p, x, fmax)
    at = rounded_at_worst(n, d, p.name)
    planned = [product_errors(p, n, run.slots, fmax, at).bound for run in runs]
    assert errors.bound == pytest.approx(max(planned), rel=1e-12)
    cube = prepared_cube.PreparedCube(p, n, d, sets, fmax, half=False, mean=True)
    taken = cube.writer.nbytes + max(product.nbytes for _, _, product in cube._products())
    turns = 2 * 8 * sets * d * point_slots.padded(n, 4096)
    assert taken <= row_runs.held_bytes(p, request, runs) + turns
