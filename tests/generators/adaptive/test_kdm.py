"""Adaptive KDM: a raster keeps what kernels leave of the density, and steps make that less."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from gbnbench import measures
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.hilbert_start import hilbert_start
from gbnbench.generators.adaptive.kernel_density.kdm import cell_side, initial_points, langevin_step
from gbnbench.generators.adaptive.kernel_density.kernel_raster import KernelRaster
from gbnbench.generators.adaptive.registry import adaptive_generator, adaptive_points
from gbnbench.generators.kernel_based.density_raster import REACH

RAMP = np.linspace(0.2, 1, 40)[:, None] * np.ones(30)


def plain_lack(density, n, x):
    """Density less kernels at every pixel, by plain sums over the images of points; pixels are cells."""
    rho, shape = density.of_points(n), np.array(density.shape)
    spacing = KernelRaster(density, n, 1.0).spacings(x)
    centres = np.argwhere(rho >= 0)[:, None] + 0.5
    kernels = np.zeros((len(centres), n))
    for k, m in itertools.product((-1, 0, 1), repeat=2):
        image = x + np.array([k, m]) * shape
        if not density.toroidal:  # mirrored: -x, x and 2 shape - x
            image = np.where([k, m], shape * (1 + np.array([k, m])) - x, x)
        r = (centres - image) / spacing[:, None]
        kernels += np.where(np.abs(r).max(axis=2) <= REACH, np.exp(-np.pi * (r**2).sum(axis=2)), 0.0)
    # a kernel ends where it and its images add up to less than it has at its reach
    kernels[kernels < np.exp(-np.pi * REACH**2)] = 0.0
    return rho.ravel() - (kernels / spacing**2).sum(axis=1)


@pytest.mark.parametrize("toroidal", [False, True])
def test_the_raster_keeps_the_plain_sum_while_points_move(toroidal):
    density = as_density(RAMP, toroidal=toroidal)
    rng = np.random.default_rng(0)
    x = hilbert_start(density, 60, rng)
    raster = KernelRaster(density, 60, 1.0)
    raster.add(x)
    assert raster.lack == pytest.approx(plain_lack(density, 60, x), abs=1e-12)
    for _ in range(3):
        langevin_step(density, raster, x, 0.1 * rng.standard_normal(x.shape))
    assert raster.lack == pytest.approx(plain_lack(density, 60, x), abs=1e-12)


def test_groups_hold_each_point_once_and_do_not_overlap():
    for toroidal in (False, True):
        density = as_density(np.random.default_rng(1).random((64, 90)) ** 4, toroidal=toroidal)
        x = hilbert_start(density, 200, np.random.default_rng(2))
        raster = KernelRaster(density, 200, 1.0)
        spacing = raster.spacings(x)
        seen = []
        for group, reach in raster.apart(x, raster.reaches(spacing)):
            seen += group.tolist()
            cells, heights, _ = raster.kernels(x[group], spacing[group], reach)
            used = np.concatenate([np.unique(c[h > 0]) for c, h in zip(cells, heights, strict=True)])
            assert len(np.unique(used)) == len(used)
        assert sorted(seen) == list(range(200))


def test_steps_without_noise_leave_less():
    density = as_density(RAMP)
    raster = KernelRaster(density, 60, cell_side(density, 60))
    x = initial_points(raster, 60, np.random.default_rng(3))
    left = [np.abs(raster.lack).sum()]
    for _ in range(20):
        langevin_step(density, raster, x, np.zeros_like(x))
        left.append(np.abs(raster.lack).sum())
    assert left[20] < left[5] < left[0]
    assert max(left[1:]) < left[0]


def test_the_raster_shares_pixels_among_its_cells():
    density = as_density(np.random.default_rng(4).random((7, 10)))
    for cell in (0.4, 1.0, 1.7, 3.0):
        raster = KernelRaster(density, 12, cell)
        assert raster.lack.sum() * raster.area == pytest.approx(12)
    coarse = KernelRaster(as_density([[1.0, 2, 3, 4]]), 10, 2.0)
    assert (coarse.lack * coarse.area).tolist() == pytest.approx([3, 7])


def test_kernels_keep_their_mass_and_slope_at_borders():
    density = as_density(np.ones((40, 40)))
    raster = KernelRaster(density, 16, 1.0)
    x = np.array([[0.3, 1.2], [39.5, 20.3], [20.3, 38.4]])
    raster.add(x)
    # of a kernel, exp(-pi 1.19^2) = 1.2% lie beyond its reach
    assert raster.lack.sum() == pytest.approx(16 - 3, abs=3 * 0.015)
    spacing = raster.spacings(x)
    reach = int(raster.reaches(spacing).max())
    cells, heights, away = raster.kernels(x, spacing, reach)
    for axis in range(2):
        step = 1e-5 * np.eye(2)[axis]
        up, down = (raster.kernels(x + sign * step, spacing, reach)[1] for sign in (1, -1))
        moved = (up - down) / 2e-5  # d heights / d x, which is 2 pi heights away / spacing
        held = (heights > 0) & (up > 0) & (down > 0)
        slope = 2 * np.pi * heights * away[axis] / spacing[:, None]
        assert slope[held] == pytest.approx(moved[held], abs=1e-7)
    assert cells.min() >= 0


@pytest.mark.slow
def test_borders_hold_no_more_points_than_they_are_to():
    x = adaptive_points("kdm[iterations=30]", as_density(np.ones((64, 64))), 1000)
    near = np.minimum(x, 64 - x).min(axis=1)  # pixels; the spacing is 2
    for inner in range(2):
        share = (64 - 2 * inner) ** 2 - (62 - 2 * inner) ** 2
        held = ((near >= inner) & (near < inner + 1)).sum()
        assert held == pytest.approx(1000 * share / 64**2, rel=0.35)


def test_tones_get_their_shares():
    tones = np.ones((64, 64))
    tones[:, 32:] = 4.0
    x = adaptive_points("kdm[iterations=4]", as_density(tones), 250)
    # A fifth are 50 points, 10 of them along the edge between the tones: half of these may be beyond it.
    assert (x[:, 1] < 32).sum() == pytest.approx(50, abs=5)


def test_what_the_model_cannot_do_is_refused_in_words():
    with pytest.raises(RefusalError, match="3 axes"):
        adaptive_points("kdm", as_density(np.ones((4, 4, 4))), 5)
    with pytest.raises(RefusalError, match="n must be at most 100000"):
        adaptive_points("kdm", as_density(np.ones((4, 4))), 1_000_000)
    with pytest.raises(RefusalError, match="4,194,304 are the most"):
        adaptive_points("kdm", as_density(np.pad([[1.0]], 200)), 10_000)
    with pytest.raises(InputError, match="levels must lie"):
        adaptive_generator("kdm[levels=0]")


@pytest.mark.slow
def test_a_constant_density_has_the_spectrum_of_the_uniform_method():
    flat = as_density(np.ones((128, 128)), toroidal=True)
    found = [measures(adaptive_points("kdm", flat, 1024, seed=seed) / 128) for seed in range(3)]
    # Of the uniform method, mean of three sets: floor 2.9e-3, peak 3.54, mean distance 0.876.
    assert np.mean([m["noise_floor"] for m in found]) == pytest.approx(3e-3, rel=0.2)
    assert np.mean([m["peak"] for m in found]) == pytest.approx(3.5, rel=0.15)
    assert np.mean([m["mean_distance"] for m in found]) == pytest.approx(0.876, abs=0.01)
