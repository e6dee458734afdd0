"""``gbnbench.export_mask``: every format holds the ranks, and refusals come before the work."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import gbnbench
from gbnbench.core.errors import InputError
from tests.compilers import built, said


@pytest.mark.parametrize("shape", [16, (2, 8, 12)])
def test_numbers_hold_the_ranks(tmp_path: Path, shape):
    ranks = gbnbench.dither_mask(shape, seed=3)
    made = gbnbench.export_mask(tmp_path / "mask.bin", shape, seed=3)
    assert np.array_equal(made.ranks, ranks)
    about = json.loads((tmp_path / "mask.bin.json").read_text())
    assert (about["dtype"], about["shape"]) == ("uint16", [*ranks.shape])
    assert np.array_equal(np.fromfile(tmp_path / "mask.bin", "<u2").reshape(ranks.shape), ranks)
    gbnbench.export_mask(tmp_path / "mask.json", shape, seed=3)
    assert np.array_equal(json.loads((tmp_path / "mask.json").read_text())["ranks"], ranks)


@pytest.mark.parametrize(("bits", "default"), [(None, 16), (8, 8)])
def test_pictures_hold_the_ranks(tmp_path: Path, bits, default):
    made = gbnbench.export_mask(tmp_path / "mask.png", 32, bits=bits)
    values = np.asarray(Image.open(tmp_path / "mask.png"))
    assert made.bits == default
    assert np.array_equal(values, made.ranks * 2**default // 1024)
    assert made.remarks == (("1,024 ranks share the 256 values of 8 bits",) if bits == 8 else ())


@pytest.mark.parametrize("standard", ["c99", "c++11"])
def test_a_compiled_header_holds_the_ranks(tmp_path: Path, standard):
    ranks = gbnbench.export_mask(tmp_path / "m.h", (2, 8, 12)).ranks
    source = tmp_path / ("main.c" if standard == "c99" else "main.cpp")
    source.write_text(
        '#include <stdio.h>\n#include "m.h"\nint main(void) {\n    int f, r, c;\n'
        "    for (f = 0; f < M_FRAMES; ++f) for (r = 0; r < M_ROWS; ++r) for (c = 0; c < M_COLUMNS; ++c)\n"
        '        printf("%d ", m_ranks[f][r][c]);\n    return M_PIXELS == 192 ? 0 : 1;\n}\n'
    )
    assert list(map(int, said(built(source, standard, tmp_path)).stdout.split())) == ranks.ravel().tolist()


def test_numbers_of_numpy_are_described(tmp_path: Path):
    given = {"seed": np.int64(3), "sigma": np.float32(1.5), "sigma_time": np.float32(2)}
    gbnbench.export_mask(tmp_path / "m.json", (2, 8, 8), **given)
    described = json.loads((tmp_path / "m.json").read_text())
    assert described["settings"] == {"seed": 3, "sigma": 1.5, "sigma_time": 2.0}


def test_its_picture_shows_the_patterns(tmp_path: Path):
    made = gbnbench.export_mask(tmp_path / "mask.png", (24, 32), picture=tmp_path / "look.png")
    assert made.files == (tmp_path / "mask.png", tmp_path / "look.png")
    with Image.open(tmp_path / "look.png") as picture:
        width, height = picture.size
    assert width > 1000 > height > 500


def test_levels_of_a_mask_with_frames_are_said_to_be_those_of_the_first(tmp_path: Path):
    gbnbench.export_mask(tmp_path / "mask.h", (2, 8, 8))
    assert "Level 0.25, first frame: power below" in (tmp_path / "mask.h").read_text()
    gbnbench.export_mask(tmp_path / "mask.json", (2, 8, 8))
    assert json.loads((tmp_path / "mask.json").read_text())["levels_of"] == "the first frame"


def test_all_levels_are_measured_and_blue(tmp_path: Path):
    table = gbnbench.export_mask(tmp_path / "mask.h", 64).to_frame()
    assert len(table) == 9
    assert table.low.max() < 0.16
    assert "Level 0.25: power below half the principal frequency" in (tmp_path / "mask.h").read_text()


@pytest.mark.parametrize(
    ("name", "settings", "said"),
    [
        ("mask.gif", {}, "masks are exported as .png, .exr, .h, .bin, .raw, .json; got extension '.gif'"),
        ("mask.png", {"bits": 12}, "bits must be 8 or 16; got 12"),
        ("mask.png", {"bits": 8.0}, "bits must be 8 or 16; got 8.0"),
        ("mask.h", {"bits": 8}, "bits are those of a .png"),
        ("mask.png", {"shape": 1}, "2 to 65,536 pixels"),
        ("mask.png", {"picture": "look.gif"}, "the picture of a mask is a .png or .pdf"),
        ("mask.png", {"shape": (40, 2), "picture": "look.png"}, "16 times as long as wide; got 2 x 40"),
        ("mask.png", {"picture": "mask.png"}, "needs a file of its own"),
        ("nowhere/mask.png", {}, "there is no folder"),
    ],
)
def test_what_cannot_be_is_refused_before_the_work(tmp_path: Path, monkeypatch, name, settings, said):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InputError, match=said):
        gbnbench.export_mask(Path(name), **settings)
    assert list(tmp_path.iterdir()) == []
