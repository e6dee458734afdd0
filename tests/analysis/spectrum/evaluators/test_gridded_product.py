"""The gridded product against the plain one and long double, on scattered points and on hard ones."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.precision import Precision, precision_of
from gbnbench.analysis.spectrum.evaluators.cube_product import cube_powers
from gbnbench.analysis.spectrum.evaluators.gridded import grid
from gbnbench.analysis.spectrum.evaluators.gridded import product as gridded_product
from gbnbench.analysis.spectrum.evaluators.gridded.cells import sorted_by_cell
from gbnbench.analysis.spectrum.evaluators.gridded.evaluator import GriddedProduct
from gbnbench.analysis.spectrum.evaluators.gridded.node_tables import node_turns
from gbnbench.analysis.spectrum.evaluators.gridded.product import griddable, gridded_powers
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.request import SpectrumRequest
from gbnbench.core.errors import InputError
from tests.devices import gpu_form
from tests.oracles.power import direct_power

UNIT = {"double": 2.0**-53, "float": 2.0**-24}


def on_grid(rng, shape):
    return rng.integers(0, 2**32, shape) / 2.0**32


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize(
    ("n", "d", "fmax", "sets"),
    [(300, 2, 40, 1), (1, 2, 12, 1), (131, 3, 10, 3), (4099, 2, 33, 2), (57, 2, 12, 70)],
)
def test_it_is_the_two_group_product(n, d, fmax, sets, precision):
    rng = np.random.default_rng(n)
    x = on_grid(rng, (sets, n, d))
    exact, _ = cube_powers(precision_of("double"), x, fmax)
    power, errors = gridded_powers(precision_of(precision), x, fmax)
    away = np.abs(np.sqrt(power) - np.sqrt(exact))
    assert away.max() <= errors.bound
    assert np.sqrt(np.mean(away**2)) <= 10 * errors.rms <= 80 * UNIT[precision]
    assert power[(fmax,) * d] == pytest.approx(n, rel=1e-15)


@pytest.mark.parametrize("weighting", ["shared", "own"])
def test_weights_halves_and_single_sets(weighting):
    rng = np.random.default_rng(1)
    p = precision_of("double")
    x = on_grid(rng, (5, 200, 2))
    w = rng.normal(size=(1 if weighting == "shared" else 5, 200))
    w[:, :3] = 0
    exact, _ = cube_powers(p, x, 20, w, mean=False)
    power, errors = gridded_powers(p, x, 20, w, mean=False)
    assert np.abs(np.sqrt(power) - np.sqrt(exact)).max() <= errors.bound
    half, _ = gridded_powers(p, x, 20, w, half=True)
    assert half == pytest.approx(exact.mean(axis=0)[20:], rel=1e-9, abs=1e-13)


def test_against_long_double_where_the_first_frequency_is_largest():
    rng = np.random.default_rng(2)
    x = rng.random((1, 1500, 2))
    power, errors = gridded_powers(precision_of("double"), x, 50)
    f = np.column_stack([rng.choice([-50, -49, 50], 40), rng.integers(-50, 51, 40)])
    exact = direct_power(x[0], f)
    found = power[f[:, 0] + 50, f[:, 1] + 50]
    assert np.sqrt(np.mean((np.sqrt(found) - np.sqrt(exact)) ** 2)) <= 1.5e-15
    assert errors.rms <= 1.5e-15


@pytest.mark.parametrize("kept_from", [gridded_product.KEPT_FROM, 16])
def test_coincident_points_and_their_bound(kept_from, monkeypatch):
    monkeypatch.setattr(gridded_product, "KEPT_FROM", kept_from)
    rng = np.random.default_rng(3)
    n = 3000
    x = np.repeat(rng.random((1, 1, 2)), n, axis=1)
    power, errors = gridded_powers(precision_of("double"), x, 30)
    worst = np.abs(np.sqrt(power) - np.sqrt(n)).max()
    assert worst <= errors.bound <= 100 * worst


def test_points_on_the_border_and_in_one_chunk_after_another(monkeypatch):
    monkeypatch.setattr(grid, "CHUNK_BYTES", 1 << 15)
    rng = np.random.default_rng(4)
    x = rng.random((1, 2000, 2))
    x[0, :4, 0] = [0, 1 - 2.0**-53, 2.0**-60, 5e-324]
    exact, _ = cube_powers(precision_of("double"), x, 31)
    power, errors = gridded_powers(precision_of("double"), x, 31)
    assert np.abs(np.sqrt(power) - np.sqrt(exact)).max() <= errors.bound


def test_a_dyadic_lattice_has_nothing_off_its_harmonics():
    lattice = np.stack(np.meshgrid(*[np.arange(32) / 32] * 2, indexing="ij"), axis=-1).reshape(1, -1, 2)
    power, _ = gridded_powers(precision_of("double"), lattice, 70)
    f = np.indices(power.shape) - 70
    harmonic = (f % 32 == 0).all(axis=0)
    assert power[harmonic] == pytest.approx(1024, rel=1e-13)
    assert power[~harmonic].max() <= 1e-27


@pytest.mark.parametrize("precision", ["double", pytest.param("float", marks=pytest.mark.slow)])
def test_the_form_for_gpus_and_other_widths(precision):
    p = precision_of(precision)
    rng = np.random.default_rng(5)
    x = on_grid(rng, (3, 300, 2))
    exact, _ = cube_powers(precision_of("double"), x, 20)
    for other in (gpu_form(p.double), Precision(p.runtime, p.double, 2)):
        power, errors = gridded_powers(other, x, 20)
        assert np.abs(np.sqrt(power) - np.sqrt(exact)).max() <= errors.bound


def test_cells_and_places_are_exact():
    rng = np.random.default_rng(6)
    x = rng.random((2, 50, 2))
    held = sorted_by_cell(x, 323, 64)
    for s in range(2):
        for k in range(50):
            turns = int(held.x[s, k, 0] * 2**64) * 323
            cell, rest = divmod(turns, 2**64)
            assert held.starts[s, cell] <= k < held.starts[s, cell + 1]
            assert held.place[s, k] == pytest.approx(rest / 2**64, abs=2.0**-53)
        assert np.array_equal(held.x[s], x[s, held.order[s]])
    turns = node_turns(7, 32)
    assert [int(t) for t in turns] == [round(m * 2**32 / 7) for m in range(7)]


def test_it_is_offered_where_it_is_cheaper_than_the_product_and_taken_by_name():
    rng = np.random.default_rng(7)
    x = rng.random((4096, 2))
    assert GriddedProduct.offer(SpectrumRequest("cube", 4096, 2, 128, 1, 257**2), "double") is not None
    assert GriddedProduct.offer(SpectrumRequest("cube", 100, 2, 20, 1, 41**2), "double") is None
    assert periodogram(x[:100], 20).method == "product"
    assert periodogram(x[:100], 20, method="gridded").method == "gridded"
    assert not griddable(1, 1000, "double")
    with pytest.raises(InputError, match="product"):
        periodogram(x[:100], 20, method="FFT")


def test_frequencies_along_the_gridded_axis_alone_are_as_exact_as_the_others():
    rng = np.random.default_rng(8)
    n = 65_536
    x = rng.random((1, n, 2))
    power, errors = gridded_powers(precision_of("double"), x, 40)
    f = np.column_stack([np.arange(1, 41), np.zeros(40, int)])
    exact = direct_power(x[0], f)
    away = np.sqrt(power[f[:, 0] + 40, 40]) - np.sqrt(exact)
    assert np.sqrt(np.mean(away**2)) <= 4 * errors.rms
