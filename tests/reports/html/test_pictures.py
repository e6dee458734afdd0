"""Pictures of the page: a palette of at most 256 colours, exact where a picture has no more."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image

from gbnbench.reports.html.pictures import COLOURS, small_picture


def _png(pixels: np.ndarray) -> bytes:
    stream = io.BytesIO()
    Image.fromarray(pixels).save(stream, format="png")
    return stream.getvalue()


def _packed(pixels: np.ndarray) -> Image.Image:
    packed = Image.open(io.BytesIO(small_picture(_png(pixels), "noise").content))
    assert packed.mode == "P"
    return packed


@pytest.mark.parametrize("count", [1, 2, 17, COLOURS])
def test_few_colours_are_kept(count: int) -> None:
    rng = np.random.default_rng(count)
    colours = rng.integers(0, 256, (count, 3), dtype=np.uint8)
    pixels = colours[rng.integers(0, count, (90, 70))]
    pixels.reshape(-1, 3)[:count] = colours
    np.testing.assert_array_equal(_packed(pixels).convert("RGB"), pixels)


def test_of_more_colours_the_nearest_are_taken() -> None:
    steps = np.arange(COLOURS, dtype=np.uint8)
    pixels = np.zeros((4, COLOURS, 3), np.uint8)
    pixels[...] = steps[:, None]
    pixels[:2, :, 2] = steps[::-1] // 128
    packed = np.asarray(_packed(pixels).convert("RGB"), int)
    assert 0 < np.abs(packed - pixels).max() <= 4
