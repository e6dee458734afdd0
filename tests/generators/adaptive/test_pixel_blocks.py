"""Pixels summed in blocks: moments are kept, and the energy is that of all pixels to the error stated."""

from __future__ import annotations

import numpy as np
import pytest
from scipy import ndimage

from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.gbn.energy import BLOCK_RESOLUTION, AdaptiveEnergy
from gbnbench.generators.adaptive.gbn.generator import AdaptiveGaussianBlueNoise
from gbnbench.generators.adaptive.gbn.pixel_blocks import block_side, in_blocks
from gbnbench.generators.adaptive.hilbert_start import hilbert_start
from gbnbench.opencl import runtime


def _picture(side, seed=0):
    """Edges between flat tones, with texture finer than any block."""
    rng = np.random.default_rng(seed)
    smooth = ndimage.gaussian_filter(rng.normal(size=(side, side)), side / 20)
    return np.where(smooth > 0, 1.0, 0.2) * (0.7 + 0.3 * rng.random((side, side)))


@pytest.mark.parametrize("toroidal", [False, True])
def test_blocks_keep_the_mass_its_centre_and_its_variance(toroidal):
    values = np.zeros((60, 48))
    values[33, 22] = 2.0
    found = in_blocks(as_density(values, toroidal=toroidal), 4).values
    assert found.shape == (15, 12)
    assert found.sum() == pytest.approx(1, rel=1e-12)  # of a density whose largest pixel is 1
    rows, columns = found.sum(axis=1), found.sum(axis=0)
    for line, at in ((rows, 33.5 / 4), (columns, 22.5 / 4)):
        centres = np.arange(len(line)) + 0.5
        assert (line * centres).sum() == pytest.approx(at, rel=1e-12)
        assert (line * (centres - at) ** 2).sum() == pytest.approx(1 / 3, rel=1e-12)
        assert (line * (centres - at) ** 3).sum() == pytest.approx(0, abs=1e-12)


def test_a_constant_density_stays_constant_up_to_its_borders():
    assert in_blocks(as_density(np.ones((24, 36))), 3).values == pytest.approx(9, rel=1e-12)
    assert in_blocks(as_density(np.ones((8, 12, 4))), 4).values == pytest.approx(64, rel=1e-12)


def test_blocks_divide_the_sides_and_resolve_kernels():
    wide = as_density(np.ones((48, 60)))
    assert block_side(wide, 10, 2.5) == 4
    assert block_side(wide, 9.9, 2.5) == 3
    assert block_side(wide, 2, 2.5) == 1
    assert block_side(as_density(np.ones((47, 60))), 100, 2.5) == 1


@pytest.mark.parametrize("toroidal", [False, True])
@pytest.mark.parametrize(
    ("sigma", "smoothing", "spread"), [(0.78, 0.5, 0.3), (1.0, 1.0, 1.0)], ids=["pictures", "samples"]
)
def test_the_gradient_is_that_of_all_pixels(sigma, smoothing, spread, toroidal):
    density, n = as_density(_picture(360), toroidal=toroidal), 200
    narrowest = sigma / np.sqrt(2 * density.of_points(n).max())
    side = block_side(density, narrowest, BLOCK_RESOLUTION)
    assert side > 2
    x = hilbert_start(density, n, np.random.default_rng(1))
    x = np.clip(x, side, np.array(density.shape) - side)  # nearer to a border widths are continued otherwise
    given = {"sigma": sigma, "smoothing": smoothing, "spread": spread, "precision": "double"}
    exact = AdaptiveEnergy(runtime(), density, n, **given)(x)
    found = AdaptiveEnergy(runtime(), density, n, blocks=side, **given)(x)
    scale = np.sqrt((exact.gradient**2).mean())
    assert np.sqrt(((found.gradient - exact.gradient) ** 2).mean()) < (3e-3 if toroidal else 1e-2) * scale
    assert found.widths == pytest.approx(exact.widths, rel=1e-3 if toroidal else 4e-3)
    assert found.energy == pytest.approx(exact.energy, rel=2e-4)
    assert found.stiffness == pytest.approx(exact.stiffness, rel=2e-2)


def test_sets_are_as_good_as_those_of_all_pixels():
    density, n = as_density(_picture(360)), 200
    generator = AdaptiveGaussianBlueNoise()
    assert generator.blocks(density, n) > 1
    by_pixels = AdaptiveGaussianBlueNoise(precision="double")
    assert by_pixels.blocks(density, n) == 1
    energy = by_pixels._energy(density, n)
    ends = [energy(one(density, n, np.random.default_rng(2))).energy for one in (generator, by_pixels)]
    start = energy(hilbert_start(density, n, np.random.default_rng(2))).energy
    assert ends[0] - ends[1] < 0.01 * (start - ends[1])


def test_starts_on_large_images_have_the_share_of_each_part():
    values = np.zeros((1100, 1003))
    values[:550, 7:] = 3.0
    values[550:, 400:401] = 1.0
    density, n = as_density(values), 2000
    x = hilbert_start(density, n, np.random.default_rng(0))
    assert (density.values[tuple(x.astype(int).T)] > 0).all()
    expected = [values[550:].sum(), values[:275].sum(), values[:550, :500].sum()]
    counted = [(x[:, 0] >= 550).sum(), (x[:, 0] < 275).sum(), ((x[:, 1] < 500) & (x[:, 0] < 550)).sum()]
    assert counted == pytest.approx(np.array(expected) * n / values.sum(), abs=25)
