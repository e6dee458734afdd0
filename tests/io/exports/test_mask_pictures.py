"""Pictures of masks: read by other programs, they give every rank back."""

from __future__ import annotations

import importlib.util
import io
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from gbnbench.core.errors import InputError
from gbnbench.io.exports import mask_pictures
from gbnbench.io.exports.mask_pictures import check_exr, mask_exr, mask_png, png_levels, thresholds


def permutation(*shape: int) -> np.ndarray:
    return np.random.default_rng(0).permutation(int(np.prod(shape))).reshape(shape)


@pytest.mark.parametrize(("shape", "bits"), [((16, 16), 8), ((10, 13), 8), ((256, 256), 16), ((60, 70), 16)])
def test_a_png_holds_every_rank(shape, bits):
    ranks = permutation(*shape)
    picture = Image.open(io.BytesIO(mask_png(ranks, bits, "how", "gbnbench")))
    values = np.asarray(picture).astype(np.int64)
    assert picture.text == {"Comment": "how", "Software": "gbnbench"}
    assert values.max() < 2**bits
    assert np.array_equal(-(-values * ranks.size // 2**bits), ranks)


def test_more_ranks_than_values_share_them_evenly():
    levels = png_levels(permutation(64, 64), 8)
    assert np.bincount(levels.ravel(), minlength=256).tolist() == [16] * 256


def test_frames_lie_below_one_another():
    ranks = permutation(3, 4, 5)
    values = np.asarray(Image.open(io.BytesIO(mask_png(ranks, 16, "", ""))))
    assert values.shape == (12, 5)
    assert np.array_equal(values[4:8], png_levels(ranks, 16)[1])


@pytest.mark.skipif(importlib.util.find_spec("OpenEXR") is None, reason="OpenEXR is not installed")
@pytest.mark.parametrize("shape", [(24, 32), (3, 8, 8)])
def test_an_exr_holds_every_threshold(shape, tmp_path: Path):
    import OpenEXR

    ranks = permutation(*shape)
    (tmp_path / "mask.exr").write_bytes(mask_exr(ranks, "how", "gbnbench"))
    with OpenEXR.File(str(tmp_path / "mask.exr")) as file:
        assert list(file.channels()) == ["Y"]
        assert file.header()["comments"] == "how"
        pixels = file.channels()["Y"].pixels.copy()
    assert pixels.dtype == np.float32
    assert np.array_equal(pixels.reshape(shape), thresholds(ranks))
    assert np.array_equal(np.floor(pixels.astype(float) * ranks.size).reshape(shape), ranks)


def test_a_missing_library_is_named(monkeypatch):
    monkeypatch.setattr(mask_pictures, "find_spec", lambda name: None)
    with pytest.raises(InputError, match=r'mask.exr: EXR .* pip install "gbnbench\[exr\]", or write .png'):
        check_exr(Path("mask.exr"))
