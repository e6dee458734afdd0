"""Zone plates against every image of every point, weighed one by one."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gbnbench import generate
from gbnbench.analysis.spatial.zone_plate import zone_plate
from gbnbench.core.errors import InputError, RefusalError
from tests.oracles.lattices import grid
from tests.published_sets import published


def slow(x: np.ndarray, pixels: int) -> np.ndarray:
    """Every image of every point near a pixel, weighed one by one."""
    n = len(x)
    side = max(1, round(math.sqrt(n) / 2))
    spacing = side / math.sqrt(n)
    nu = (60 / 512) ** 2 * 512 * 0.5 / math.pi
    reach = range(-3, math.ceil(pixels / side) + 3)
    samples = [((p[0] + i) * side, (p[1] + j) * side) for p in x for i in reach for j in reach]
    picture = np.full((pixels, pixels), 0.5)
    for row in range(pixels):
        for column in range(pixels):
            top = bottom = 0.0
            for px, py in samples:
                dx, dy = column + 0.5 - px, row + 0.5 - py
                if abs(dx) <= 2 and abs(dy) <= 2:
                    weight = math.exp(-(dx * dx + dy * dy) / (2 * 0.6**2))
                    phase = math.pi * nu * (px * px + py * py) / (pixels * spacing)
                    top += weight * (1 + math.sin(phase)) / 2
                    bottom += weight
            if bottom > 0:
                picture[row, column] = top / bottom
    return picture


@pytest.mark.parametrize(("n", "pixels"), [(1, 5), (5, 6), (16, 9), (100, 12), (230, 8), (900, 7)])
def test_against_every_image_weighed(n: int, pixels: int) -> None:
    x = np.random.default_rng(n).random((n, 2))
    np.testing.assert_allclose(zone_plate(x, pixels=pixels), slow(x, pixels), atol=1e-11)


def test_x_runs_right_and_y_up() -> None:
    x = np.random.default_rng(1).random((64, 2))
    np.testing.assert_allclose(zone_plate(x[:, ::-1], pixels=40), zone_plate(x, pixels=40).T, atol=1e-12)
    corner = zone_plate(grid(32, 2), pixels=512)[:12, :12]
    assert corner[0, 0] == pytest.approx(0.5, abs=0.02)  # sine of 0 at the origin
    # first bright ring: (60/512 r)^2 = pi/2, r = 10.7 pixels
    assert int(np.argmax(corner[0])) in (9, 10, 11)


def test_noise_at_low_frequency_tells_sets_apart() -> None:
    rng = np.random.default_rng(2)
    jittered = (grid(32, 2) + rng.random((1024, 2)) / 32) % 1
    y, x = np.mgrid[:512, :512] + 0.5
    ring = (np.hypot(x, y) > 180) & (np.hypot(x, y) < 220)  # fringes finer than pixels, nu near 0.44
    noise = [zone_plate(points)[ring].std() for points in (grid(32, 2), jittered, rng.random((1024, 2)))]
    assert noise[0] < 0.01
    assert noise[1] < 0.75 * noise[2]


@pytest.mark.parametrize("made_by", ["the authors' program", "our generator"])
def test_a_gaussian_blue_noise_is_clean(made_by: str) -> None:
    ours = made_by == "our generator"
    blue = generate("gbn", n=1024) if ours else published("gbn-1024/official-10k-f32-1.txt")
    y, x = np.mgrid[:512, :512] + 0.5
    ring = (np.hypot(x, y) > 180) & (np.hypot(x, y) < 220)
    clean = zone_plate(blue)[ring].std()
    noisy = zone_plate(np.random.default_rng(3).random((1024, 2)))[ring].std()
    assert clean < 0.05 * noisy


def test_pixels_without_samples_are_grey() -> None:
    x = 0.5 + 1e-3 * np.random.default_rng(4).random((4096, 2))  # tiles of 32 pixels
    picture = zone_plate(x, pixels=64)
    assert picture[0, 0] == 0.5
    assert picture[4, 20] == 0.5


def test_chunks_of_points_add_up(monkeypatch: pytest.MonkeyPatch) -> None:
    x = np.random.default_rng(7).random((230, 2))
    whole = zone_plate(x, pixels=30)
    monkeypatch.setattr("gbnbench.analysis.spatial.zone_plate.CHUNK", 64 * 17)
    np.testing.assert_allclose(zone_plate(x, pixels=30), whole, atol=1e-12)


def test_draws_the_first_of_several_sets() -> None:
    x = np.random.default_rng(5).random((2, 64, 2))
    np.testing.assert_array_equal(zone_plate(x, pixels=30), zone_plate(x[0], pixels=30))


def test_refusals() -> None:
    with pytest.raises(RefusalError, match="d=3"):
        zone_plate(np.random.default_rng(6).random((10, 3)))
    with pytest.raises(InputError, match="pixels"):
        zone_plate(np.random.default_rng(6).random((10, 2)), pixels=0)


@settings(deadline=None, max_examples=20)
@given(st.integers(0, 2**32 - 1), st.integers(1, 3000), st.integers(1, 90))
def test_picture_has_its_size_and_range_in_any_order(seed: int, n: int, pixels: int) -> None:
    rng = np.random.default_rng(seed)
    x = rng.random((n, 2))
    picture = zone_plate(x, pixels=pixels)
    assert picture.shape == (pixels, pixels)
    assert picture.min() >= 0
    assert picture.max() <= 1
    np.testing.assert_allclose(zone_plate(rng.permutation(x), pixels=pixels), picture, atol=1e-9)
