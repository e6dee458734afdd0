"""Void-and-cluster masks: ranks, blue patterns at every grey level and in every frame, and refusals."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.core.errors import InputError
from gbnbench.generators.kernel_based.dither_mask import dither_mask
from gbnbench.generators.kernel_based.raster_energy import RasterEnergy
from gbnbench.generators.kernel_based.raster_kernel import spatiotemporal

LEVELS = (1 / 32, 1 / 16, 1 / 8, 1 / 4, 1 / 2, 3 / 4, 7 / 8, 15 / 16, 31 / 32)


def low_power(ones: np.ndarray, part: float = 0.5) -> float:
    """Mean power up to a part of the principal frequency, over that of as many pixels at random."""
    pixels, count = ones.size, int(ones.sum())
    centres = (np.argwhere(ones) + 0.5) / ones.shape
    principal = min(
        math.sqrt(min(count, pixels - count)), len(ones) / 2
    )  # a raster has no more along an axis
    spectrum = shells(centres, math.ceil(principal * part))
    low = spectrum.frequency <= principal * part
    mean = np.average(spectrum.power[low], weights=spectrum.count[low])
    return float(mean / ((pixels - count) / (pixels - 1)))


@pytest.mark.parametrize("shape", [64, (32, 48), (3, 8, 16)])
def test_each_rank_comes_once(shape):
    ranks = dither_mask(shape, seed=5)
    assert sorted(ranks.ravel()) == list(range(ranks.size))
    assert ranks.shape == ((64, 64) if shape == 64 else shape)
    assert np.array_equal(ranks, dither_mask(shape, seed=5))
    assert not np.array_equal(ranks, dither_mask(shape, seed=6))


def test_every_grey_level_is_blue():
    """Ulichney 1993: homogeneous at all grey levels g, little power below the principal frequency sqrt(g).

    Of four seeds the largest at half that frequency was 0.14 of white dither, at a quarter 0.11.
    """
    ranks = dither_mask(64)
    levels = [ranks < share * ranks.size for share in LEVELS]
    assert max(low_power(level) for level in levels) < 0.16
    assert max(low_power(level, 0.25) for level in levels) < 0.13
    white = np.random.default_rng(1).permutation(ranks.size).reshape(ranks.shape)
    assert min(low_power(white < share * ranks.size) for share in LEVELS) > 0.5


def test_every_level_has_little_energy():
    """Above that of an even grey, over what as many random pixels have in expectation.

    Ones that do not meet leave their own heights, the least of a sparse level: 0.56 of chance at 1/32.
    """
    ranks = dither_mask(32)
    f = np.fft.fftfreq(32) * 32
    kernel = np.fft.fft2(np.exp(-(f[:, None] ** 2 + f**2) / (2 * 1.5**2))).real
    beyond_grey = kernel.sum() - kernel[0, 0]
    for share, most in zip(LEVELS, (0.65, 0.37, 0.16, 0.1, 0.1, 0.1, 0.18, 0.37, 0.65), strict=True):
        ones = (ranks < share * ranks.size).astype(float)
        energy = np.sum(kernel * np.abs(np.fft.fft2(ones)) ** 2) - kernel[0, 0] * ones.sum() ** 2
        chance = beyond_grey * 1024 * share * (1 - share) * 1024 / 1023
        assert energy < most * chance


def test_frames_are_blue_and_so_is_a_pixel_over_time():
    ranks = dither_mask((16, 32, 32), seed=1)
    level = ranks < ranks.size / 8
    assert level.sum(axis=(1, 2)).std() < 2.5  # of 128, where random pixels would have 10
    assert max(low_power(frame) for frame in level) < 0.12
    over_time = np.mean(np.abs(np.fft.fft(level, axis=0)[1]) ** 2) / (16 * 1 / 8 * 7 / 8)
    assert over_time < 0.5  # 0.41 of white noise at half the principal frequency of two a turn


def test_the_spatiotemporal_sum_is_that_of_all_pairs():
    shape, rng = (5, 6, 7), np.random.default_rng(4)
    energy = RasterEnergy(shape, spatiotemporal(shape, 1.2, 0.9), rng)
    ones = rng.choice(210, 20, replace=False)
    for pixel in ones:
        energy.add(int(pixel))
    energy.remove(int(ones[0]))
    grid, turns = np.stack(np.unravel_index(np.arange(210), shape), axis=1), np.arange(-8, 9)
    between = grid[:, None] - grid[ones[1:]][None]
    near = [
        np.exp(-((between[..., a, None] + turns * shape[a]) ** 2) / (2 * (0.9, 1.2, 1.2)[a] ** 2)).sum(-1)
        for a in range(3)
    ]
    same_frame = between[..., 0] == 0
    same_pixel = (between[..., 1:] == 0).all(axis=-1)
    expected = (near[1] * near[2] * same_frame + near[0] * same_pixel).sum(axis=1)
    assert [energy.at(pixel) for pixel in range(210)] == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"shape": 1}, "2 to 65,536 pixels; got 1"),
        ({"shape": (8, 0)}, "2 to 65,536 pixels"),
        ({"shape": 8.5}, "in whole numbers; got 8.5"),
        ({"shape": (2, 2, 2, 2)}, "rows and columns"),
        ({"shape": 4096}, "at most 262,144 pixels"),
        ({"sigma": 0.0}, "sigma"),
        ({"sigma_time": 21.0}, "sigma_time"),
        ({"seed": -1}, "seed must be a whole number >= 0; got -1"),
    ],
)
def test_wrong_arguments_are_named(arguments, said):
    with pytest.raises(InputError, match=said):
        dither_mask(**arguments)


def test_progress_ends_at_the_last_rank():
    told = []
    dither_mask((16, 24), progress=lambda done, total, doing: told.append((done, total, doing)))
    assert told[-1] == (384, 384, "ranks of the mask")
