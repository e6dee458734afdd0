"""Grid, jittered and Latin hypercube sets, against their closed-form spectra and strata."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.generators.lattices.regular_grid import grid_refusal, grid_side
from gbnbench.generators.registry import generate
from tests.oracles.power import direct_power, half_space


def mean_power(
    name: str, n: int, d: int, frequencies: np.ndarray, sets: int
) -> tuple[np.ndarray, np.ndarray]:
    """Mean power over realizations and its standard error."""
    power = np.array([direct_power(x, frequencies) for x in generate(name, n=n, d=d, realizations=sets)])
    return power.mean(axis=0), power.std(axis=0) / np.sqrt(sets)


def test_white_noise_has_power_one() -> None:
    mean, error = mean_power("random", 20, 2, half_space(2, 2), 600)
    assert np.all(np.abs(mean - 1) < 5 * error)
    assert abs(mean.mean() - 1) < 0.05


@pytest.mark.parametrize(("n", "d", "fmax"), [(8, 1, 12), (16, 2, 3), (27, 3, 1)])
def test_jittered_power_is_one_less_the_cells_own(n: int, d: int, fmax: int) -> None:
    f = half_space(fmax, d)
    mean, error = mean_power("jittered", n, d, f, 600)
    expected = 1 - np.prod(np.sinc(f / round(n ** (1 / d))) ** 2, axis=1)
    assert np.all(np.abs(mean - expected) < 5 * error)


@pytest.mark.parametrize(("n", "d"), [(7, 1), (100, 2), (27, 3), (81, 4)])
def test_jittered_has_one_point_a_cell(n: int, d: int) -> None:
    x = generate("jittered", n=n, d=d)
    assert len(np.unique(np.floor(x * round(n ** (1 / d))), axis=0)) == n


@pytest.mark.parametrize(("n", "d", "fmax"), [(7, 1, 21), (25, 2, 6), (27, 3, 3)])
def test_grid_power_is_n_on_its_harmonics_and_nothing_elsewhere(n: int, d: int, fmax: int) -> None:
    f = half_space(fmax, d)
    harmonic = np.all(f % round(n ** (1 / d)) == 0, axis=1)
    assert harmonic.any()
    for shift in (True, False):
        power = direct_power(generate("grid", n=n, d=d, shift=shift), f)
        assert np.allclose(power[harmonic], n, rtol=1e-12, atol=0)
        assert power[~harmonic].max() < 1e-26


def test_unshifted_grid_is_the_cells_centres() -> None:
    assert generate("grid", n=3, d=1, shift=False).tolist() == [[1 / 6], [0.5], [5 / 6]]


def test_shifts_are_uniform() -> None:
    corner = generate("grid", n=4, d=2, realizations=1000)[:, 0] * 2
    assert np.all(np.abs(corner.mean(axis=0) - 0.5) < 5 * np.sqrt(1 / 12 / 1000))
    assert np.all(np.abs(corner.var(axis=0) - 1 / 12) < 0.01)
    assert abs(np.corrcoef(corner.T)[0, 1]) < 5 / np.sqrt(1000)


@pytest.mark.parametrize(("n", "d"), [(1, 3), (2, 1), (11, 2), (30, 5)])
def test_latin_has_one_point_a_stratum_of_every_axis(n: int, d: int) -> None:
    strata = np.sort(np.floor(generate("latin", n=n, d=d) * n), axis=0)
    assert np.array_equal(strata, np.repeat(np.arange(n)[:, None], d, axis=1))


@pytest.mark.parametrize(("n", "d", "fmax"), [(4, 1, 6), (5, 2, 3), (4, 3, 1)])
def test_latin_power_follows_its_closed_form(n: int, d: int, fmax: int) -> None:
    f = half_space(fmax, d)
    mean, error = mean_power("latin", n, d, f, 800)
    factor = np.where(f == 0, 1, -(np.sinc(f / n) ** 2) / (n - 1))
    assert np.all(np.abs(mean - (1 + (n - 1) * np.prod(factor, axis=1))) < 5 * error)


@pytest.mark.parametrize("name", ["grid", "jittered"])
def test_one_point_is_a_grid_in_any_dimension(name: str) -> None:
    assert generate(name, n=1, d=100).shape == (1, 100)


def test_whole_roots_survive_rounding() -> None:
    for d in range(1, 9):
        for m in (1, 2, 3, 7, 10, 31):
            assert grid_side(m**d, d) == m
            if d > 1 and m > 1:
                assert grid_side(m**d + 1, d) is None
                assert grid_side(m**d - 1, d) is None


@pytest.mark.parametrize(
    ("n", "d", "near"), [(1000, 2, 1024), (2, 2, 1), (3, 2, 4), (300, 8, 256), (1000, 10, 1024)]
)
def test_nearest_size_is_the_nearest(n: int, d: int, near: int) -> None:
    reason = grid_refusal("it", n, d)
    assert reason is not None
    assert reason.endswith(f"got n={n}, nearest is {near}")
