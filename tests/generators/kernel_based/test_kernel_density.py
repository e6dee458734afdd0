"""The kernel density model: its raster against a slow sum, its groups, its steps one after another."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.core.errors import InputError
from gbnbench.generators.kernel_based.density_raster import REACH, DensityRaster
from gbnbench.generators.kernel_based.kernel_density import (
    DRIFT,
    KernelDensityModel,
    initial_points,
    langevin_step,
    split_points,
)
from gbnbench.generators.protocol import realization_rng


@pytest.mark.parametrize(("n", "d"), [(20, 1), (60, 2), (40, 3)])
def test_what_lacks_is_one_less_the_kernels(n: int, d: int) -> None:
    raster = DensityRaster(n, d)
    x = realization_rng(0, 0).random((n, d)) * raster.side
    raster.add(x)
    grid = np.stack(np.unravel_index(np.arange(raster.side**d), (raster.side,) * d), axis=1)
    apart = grid[:, None] - x[None]
    apart = (apart - raster.side * np.round(apart / raster.side)) / raster.spacing
    square = np.sum(apart**2, axis=2)
    expected = 1 - np.sum(np.where(square < REACH**2, np.exp(-math.pi * square), 0), axis=1)
    assert raster.lack == pytest.approx(expected, abs=1e-12)


def test_kernels_have_unit_mass_but_for_what_is_cut_off() -> None:
    """In 2D the part beyond the reach is exp(-pi REACH**2); pixels are coarse."""
    raster = DensityRaster(400, 2)
    _, heights, _ = raster.kernels(realization_rng(0, 0).random((50, 2)) * raster.side)
    mass = heights.sum(axis=1) / raster.spacing**2
    assert mass.mean() == pytest.approx(1 - math.exp(-math.pi * REACH**2), rel=2e-3)
    assert mass == pytest.approx(np.full(50, mass.mean()), rel=1e-2)


@pytest.mark.parametrize(("n", "d"), [(7, 2), (300, 1), (500, 2), (300, 3)])
def test_groups_hold_each_point_once_and_do_not_overlap(n: int, d: int) -> None:
    raster = DensityRaster(n, d)
    x = realization_rng(1, 0).random((n, d)) * raster.side
    groups = list(raster.apart(x))
    assert np.array_equal(np.sort(np.concatenate(groups)), np.arange(n))
    for group in groups:
        windows = [np.unique(pixels) for pixels in raster.kernels(x[group])[0]]
        together = np.concatenate(windows)
        assert len(np.unique(together)) == len(together)


def test_a_step_is_that_of_one_point_after_another() -> None:
    n = 200
    raster = DensityRaster(n, 2)
    x = initial_points(raster, realization_rng(2, 0))
    noise = 0.2 * realization_rng(3, 0).standard_normal(x.shape)
    single, alone = x.copy(), DensityRaster(n, 2)
    alone.add(x)
    for index in np.concatenate(list(raster.apart(x))):
        pixels, heights, away = alone.kernels(single[index, None])
        over = np.where(alone.lack[pixels] <= 0, 1, -1) * heights
        slope = (over * away).sum(axis=2)[:, 0] / alone.spacing**2
        np.add.at(alone.lack, pixels[0], heights[0])
        single[index] = (single[index] - DRIFT * alone.spacing * slope + noise[index]) % alone.side
        alone.add(single[index, None])
    langevin_step(raster, x, noise)
    assert x == pytest.approx(single, abs=1e-9)
    assert raster.lack == pytest.approx(alone.lack, abs=1e-9)


def test_steps_without_noise_lower_the_energy() -> None:
    raster = DensityRaster(200, 2)
    x = initial_points(raster, realization_rng(2, 0))
    before = np.abs(raster.lack).sum()
    for _ in range(10):
        langevin_step(raster, x, np.zeros_like(x))
    assert np.abs(raster.lack).sum() < 0.8 * before


def test_a_split_keeps_the_number_asked_for() -> None:
    raster = DensityRaster(61, 2)
    x = split_points(realization_rng(0, 0).random((16, 2)) * raster.side, raster, realization_rng(0, 1))
    assert x.shape == (61, 2)
    assert raster.lack.sum() == pytest.approx(raster.lack.size * math.exp(-math.pi * REACH**2), rel=0.1)


@pytest.mark.parametrize(
    "wrong", [{"iterations": 0}, {"temperature": -1.0}, {"temperature": math.inf}, {"levels": 0}]
)
def test_wrong_settings_are_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(InputError, match=next(iter(wrong))):
        KernelDensityModel(**wrong)  # type: ignore[arg-type]
