"""The structure factor against quadrature, plain sums and laws that it obeys."""

from __future__ import annotations

import math

import numpy as np
import pytest

import gbnbench
from gbnbench.analysis.window.bin_covariance import interpolated
from gbnbench.analysis.window.box import check_window
from gbnbench.analysis.window.radial_structure_factor import radial_structure_factor
from gbnbench.analysis.window.structure_factor import structure_factor, tapered
from gbnbench.analysis.window.tapered_sums import GriddedSums, direct_sums
from gbnbench.analysis.window.wave_vectors import (
    bin_edges,
    every_wave_vector,
    in_half_space,
    some_wave_vectors,
)
from gbnbench.core.errors import InputError
from gbnbench.execution.progress import Progress

SIDES = np.array([3.0, 2.0])
K = np.array([[5.0, 1.0], [2 * math.pi / 3, 0.0], [0.4, -0.3], [0.0, 30.0]])


def _cells(count):
    middles = (np.arange(count) + 0.5) / count
    return np.stack([axis.ravel() for axis in np.meshgrid(middles, middles, indexing="ij")], axis=1) * SIDES


def test_masses_and_squares_are_the_integrals_of_g_and_its_gradient():
    """On a fine grid of points sums are integrals: J is 0, and g is what its definition says."""
    x = _cells(300)
    seen = tapered(*check_window(x, 0, SIDES))
    sums = direct_sums(seen.u, seen.values, K * SIDES / (2 * math.pi), Progress())
    powers, masses, squares = seen.powers(sums, K)
    assert powers.max() < 1e-4 * len(x)  # of n^2 where nothing drops out
    waves = np.exp(-1j * x @ K.T)
    c = (seen.values @ waves / len(x)) / seen.values[0].mean()
    g = seen.values[:, :, None] * waves - c[:, None, :] * seen.values[0][None, :, None]
    np.testing.assert_allclose(masses, (np.abs(g) ** 2).mean(axis=1), atol=1e-3)
    field = g.reshape(len(seen.values), 300, 300, len(K))
    slopes = [np.gradient(field, side / 300, axis=1 + axis) for axis, side in enumerate(SIDES)]
    found = sum((np.abs(slope) ** 2).mean(axis=(1, 2)) for slope in slopes)
    np.testing.assert_allclose(squares, found, rtol=0.02, atol=0.05)  # one-sided at the border


def test_any_wave_vectors_against_a_plain_sum():
    x = np.random.default_rng(0).random((50, 2)) * SIDES
    table = structure_factor(x, 0, SIDES, K, tapers=(1, 2))
    orders = [(1, 1), (1, 2)]
    h = np.array(
        [2 * np.sin(math.pi * p * x[:, 0] / 3) * np.sin(math.pi * q * x[:, 1] / 2) for p, q in orders]
    )
    fine = _cells(600)
    quadrature = np.array(
        [2 * np.sin(math.pi * p * fine[:, 0] / 3) * np.sin(math.pi * q * fine[:, 1] / 2) for p, q in orders]
    )
    for row, k in zip(table.itertuples(), K, strict=True):
        wave = np.exp(-1j * fine @ k)
        c = (quadrature @ wave) / quadrature[0].sum()
        g = quadrature * wave - c[:, None] * quadrature[0]
        power = np.abs(h @ np.exp(-1j * x @ k) - c * h[0].sum()) ** 2
        expected = power.sum() / ((h**2).sum() / 2 * (np.abs(g) ** 2).mean(axis=1).sum())
        assert pytest.approx(expected, rel=2e-3) == row.S


def test_uniform_points_have_one_in_expectation_at_every_wave_vector():
    """E |J|^2 = n (masses) exactly for independent points; 4,000 sets leave 2% of noise."""
    rng = np.random.default_rng(1)
    x = rng.random((4000 * 20, 2)) * SIDES
    seen = tapered(*check_window(x, 0, SIDES))
    waves = np.exp(-1j * x @ K.T)
    sums = (seen.values[:, :, None] * waves).reshape(6, 4000, 20, -1).sum(axis=2)
    first = seen.values[0].reshape(4000, 20).sum(axis=1)
    c = seen.tapers.transforms(K) / seen.tapers.first_mean
    mean = (np.abs(sums - c[:, None, :] * first[:, None]) ** 2).mean(axis=1)
    _, masses, _ = seen.powers(seen.tapers.transforms(K), K)
    assert (mean / (20 * masses))[masses > 1e-6] == pytest.approx(1, abs=0.1)


def test_gridded_sums_are_the_direct_ones():
    rng = np.random.default_rng(2)
    u = np.concatenate([rng.random((300, 2)), [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0]]])
    values = rng.normal(size=(1, len(u)))
    multiples = np.array([[3, 5], [-40, 20], [0, 1], [17, 0], [0, 0], [40, 20]])
    exact = (values[0] * np.exp(-2j * math.pi * multiples @ u.T)).sum(axis=1)
    (gridded,) = GriddedSums(u, np.array([40, 20])).of(values, multiples)
    np.testing.assert_allclose(gridded, exact, atol=2e-4)
    for precision, tolerance in (("double", 1e-11), ("float", 2e-4)):
        found = direct_sums(u, values, multiples.astype(float), Progress(), precision)
        np.testing.assert_allclose(found[0], exact, atol=tolerance)


def test_wave_vectors_of_a_shell_are_all_there_once():
    sides = np.array([3.0, 2.0, 1.0])
    found = every_wave_vector(20.0, sides)
    both = np.concatenate([found, -found])
    m = np.stack([a.ravel() for a in np.meshgrid(*[np.arange(-12, 13)] * 3, indexing="ij")], axis=1)
    length = np.linalg.norm(2 * math.pi / sides * m, axis=1)
    assert {*map(tuple, both.tolist())} == {*map(tuple, m[(length > 0) & (length < 20)].tolist())}
    assert len(both) == len({*map(tuple, both.tolist())})
    some = some_wave_vectors(10.0, 20.0, sides, 30, np.random.default_rng(0))
    assert len(some) == 30
    assert in_half_space(some).all()
    assert {*map(tuple, some.tolist())} <= {*map(tuple, found.tolist())}


def _radial(x, low, high, kmax, seed=0):
    seen = tapered(*check_window(x, low, high))
    return radial_structure_factor(seen, kmax, np.random.default_rng(seed), Progress())


def test_unit_place_and_order_of_axes_change_nothing():
    x = np.random.default_rng(3).random((300, 2)) * SIDES
    table, covariance = _radial(x, 0, SIDES, 80)
    scaled, _ = _radial(x * 100 + [7, -5], [7, -5], SIDES * 100 + [7, -5], 0.8)
    np.testing.assert_allclose(scaled["k"] * 100, table["k"], rtol=1e-6)
    np.testing.assert_allclose(scaled["S"], table["S"], rtol=1e-3)
    turned, _ = _radial(x[:, ::-1], 0, SIDES[::-1], 80)
    np.testing.assert_allclose(turned["S"], table["S"], rtol=1e-3)
    np.testing.assert_allclose(turned["degrees"], table["degrees"], rtol=0.05)
    assert np.linalg.eigvalsh(covariance).min() > -1e-3 * np.trace(covariance)


@pytest.mark.parametrize("unit", [1e-6, 0.1, 0.325, 3.0, 7.0, 1e9])
@pytest.mark.parametrize("sides", [(512, 256), (64, 16), (2, 1, 1), (4, 4, 4, 8)])
def test_bins_hold_the_same_wave_vectors_in_every_unit_and_order_of_axes(sides, unit):
    """Wave vectors of such windows are exactly as long as the edges of bins are called."""
    lengths = np.array(sides, float)

    def lists(lengths):
        edges = bin_edges(15 * math.pi / float(lengths.min()), lengths)
        found = every_wave_vector(float(edges[-1]), lengths)
        k = np.linalg.norm(2 * math.pi / lengths * found, axis=1)
        return np.histogram(k, edges)[0].tolist()

    assert lists(lengths * unit) == lists(lengths)
    assert lists(lengths[::-1] * unit) == lists(lengths)


def test_sampled_bins_agree_with_whole_ones(monkeypatch):
    x = np.random.default_rng(4).random((400, 3))
    whole, _ = _radial(x, 0, 1, 60)
    monkeypatch.setattr("gbnbench.analysis.window.radial_structure_factor.GRID_DIMENSIONS", 0)
    sampled, _ = _radial(x, 0, 1, 60)
    np.testing.assert_allclose(sampled["S"], whole["S"], rtol=1e-3)  # all of a bin, one by one
    monkeypatch.setattr("gbnbench.analysis.window.radial_structure_factor.PHASES", 400 * 100 * len(whole))
    part, _ = _radial(x, 0, 1, 60)
    assert part["count"].max() == 100
    z = (part["S"] - whole["S"]) / part["standard_error"]
    assert np.abs(z).max() < 3.5


def test_side_lobes_are_foreseen():
    """Gaussian blue noise has next to no power at low wave numbers but what side lobes bring."""
    x = gbnbench.generate("gbn[iterations=60]", n=400, d=2, seed=0)
    table, _ = _radial(x, 0, 1, 2 * 2 * math.pi * 20)
    low = table[table["nu"] < 0.4]
    assert ((low["S"] < 2 * low["leakage"]) & (low["S"] > low["leakage"] / 20)).all()
    assert not low["resolved"].any()


def test_power_laws_are_interpolated_exactly():
    k = np.array([1.0, 2.0, 5.0])
    np.testing.assert_allclose(interpolated(np.array([0.5, 3.0, 9.0]), k, 3 * k**2), [0.75, 27.0, 75.0])


@pytest.mark.parametrize(
    ("k", "tapers", "said"),
    [
        ([1.0, 2.0], None, "wave vectors"),
        ([[math.nan, 1.0]], None, "finite"),
        (K, (2,), "2 counts"),
        (K, (0, 1), "at least 1"),
    ],
)
def test_wrong_arguments_are_refused(k, tapers, said):
    with pytest.raises(InputError, match=said):
        structure_factor(np.random.default_rng(0).random((20, 2)), 0, 1, k, tapers=tapers)
