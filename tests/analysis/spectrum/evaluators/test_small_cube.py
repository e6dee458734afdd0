"""Small cubes in one launch: the same bits as in several, and one launch where one will do."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench import periodogram
from gbnbench.analysis.precision import precision_of
from gbnbench.analysis.spectrum.digits import cheapest_division
from gbnbench.analysis.spectrum.evaluators import small_cube
from gbnbench.analysis.spectrum.evaluators.cube_product import cube_powers
from gbnbench.analysis.spectrum.evaluators.frequency_group import Group
from gbnbench.analysis.spectrum.evaluators.kept_memory import forget
from gbnbench.analysis.spectrum.evaluators.point_slots import tile_rows
from gbnbench.analysis.spectrum.evaluators.small_cube import is_small
from gbnbench.analysis.spectrum.evaluators.two_group_product import TwoGroupProduct
from gbnbench.opencl import Launch, Program, runtime
from tests.analysis.spectrum.evaluators.cube_truth import check
from tests.devices import gpu_form
from tests.oracles.power import on_grid

SMALL = [(1, 1, 1), (16, 2, 4), (7, 3, 2), (100, 1, 300), (33, 2, 12), (50, 4, 1), (9, 8, 1), (300, 1, 5)]


def product_of(p, n, d, fmax, sets):
    divided = cheapest_division(d, fmax, tile_rows(p))
    return TwoGroupProduct(p, n, d, sets, Group(divided.leading), Group(divided.trailing))


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize(("n", "d", "fmax"), SMALL)
@pytest.mark.parametrize("sets", [1, 3])
def test_one_launch_gives_the_bits_of_several(monkeypatch, n, d, fmax, sets, precision):
    p, rng = precision_of(precision), np.random.default_rng(n)
    assert is_small(product_of(p, n, d, fmax, sets), sets)
    x = rng.random((sets, n, d))
    forms = [
        (w, half, mean)
        for w in (None, rng.random((1, n)), rng.random((sets, n)))
        for half in (False, True)
        for mean in (False, True)
    ]
    at_once = [cube_powers(p, x, fmax, *form) for form in forms]
    forget()
    monkeypatch.setattr(small_cube, "MOST_WORK", 0)
    for form, (power, errors) in zip(forms, at_once, strict=True):
        in_turn, of_turns = cube_powers(p, x, fmax, *form)
        assert np.array_equal(power, in_turn)
        assert errors == of_turns


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize(("n", "d", "fmax"), SMALL)
def test_small_cubes_are_right(n, d, fmax, precision):
    check(precision_of(precision), on_grid((2, n, d), n), fmax)


def test_a_small_request_is_one_launch(monkeypatch):
    x, launches = np.random.default_rng(1).random((16, 2)), []
    expected = periodogram(x, 4).power
    launch, run = Launch.__call__, Program.run

    def prepared(self, *buffers):
        launches.append("one")
        launch(self, *buffers)

    def enqueued(self, name, *arguments):
        launches.append(name)
        run(self, name, *arguments)

    monkeypatch.setattr(Launch, "__call__", prepared)
    monkeypatch.setattr(Program, "run", enqueued)
    assert np.array_equal(periodogram(x, 4).power, expected)
    assert launches == ["one"]
    launches.clear()
    periodogram(np.random.default_rng(2).random((1024, 3)), 8, method="product")
    assert [name for name in launches if name != "digits"] == ["slot_sums", "cube_power"]


def test_large_ones_and_those_of_a_gpu_are_not_small():
    p = precision_of("double")
    assert not is_small(product_of(p, 1024, 3, 8, 1), 1)
    assert not is_small(product_of(p, 16, 2, 4, 10**4), 10**4)
    assert not is_small(product_of(gpu_form(), 16, 2, 4, 1), 1)


def test_rows_beyond_the_last_frequency_repeat_it_and_are_not_what_the_memory_held():
    p = precision_of("double")
    product = product_of(p, 20, 2, 4, 1)
    tables = product.frequencies
    assert tables.a.count < tables.tiles * tables.rows
    list(product.batches(np.random.default_rng(0).random((1, 20, 2))))
    leading = runtime().download(product.tables[0], np.empty(product.sizes[0], p.real))
    by_row = leading.reshape(tables.tiles, product.slots.pitch // p.lanes, tables.rows, 2, p.lanes)
    by_row = by_row[:, : product.slots.length // p.lanes]
    beyond = by_row[-1, :, tables.a.count - tables.tiles * tables.rows :]
    last = by_row[-1, :, tables.a.count - tables.tiles * tables.rows - 1]
    assert last.any()
    assert np.array_equal(beyond, np.broadcast_to(last[:, None], beyond.shape))
