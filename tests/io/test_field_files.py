"""Files as other programs write them: each gives the right points or the whole sentence stated here."""

from __future__ import annotations

import re

import numpy as np
import pytest

from gbnbench.core.errors import FormatError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points import load
from tests.paths import ROOT

FIELD = ROOT / "tests" / "data" / "field"


def numbers(name: str) -> FloatArray:
    """Every decimal number of a text that is one, in a row as long as the first line that holds two."""
    rows = [
        [float(token.replace(",", ".")) for token in re.findall(r"[01][.,]\d+(?:e-?\d+)?", line)]
        for line in (FIELD / name).read_text("utf-8-sig").splitlines()
    ]
    return np.array([row for row in rows if len(row) > 1])


X = numbers("f10_quoted.csv")  # the points that most of these files hold

RIGHT = {
    "f01_excel_de.csv": X.round(6),
    "f04_pandas_index.csv": X,
    "f06_r_writetable.txt": X,
    "f09_trailing_comma.csv": X,
    "f10_quoted.csv": X,
    "f22_ply.ply": numbers("f22_ply.ply"),
    "f24_json.json": X,
    "b02_v3.npy": X,
    "dim20.csv": numbers("dim20.csv"),
    "d09_dup_pairs.txt": numbers("d09_dup_pairs.txt"),
}

REFUSED = {
    "f07_weight_col.csv": ", line 1: column 'w' is no coordinate; the names are x, y, z or x0, x1, ..., "
    "once each; --columns x,y takes those wanted",
    "f14_pixels.txt": ", line 1: coordinate 115 is not in [0, 1]: all numbers are whole, as those of pixels "
    "are; give the image's size, such as --period 512,512 (period= in Python)",
    "f16_edge_rounding.txt": ", line 6: coordinate 1.0000001 is not in [0, 1], but no further outside than "
    "rounding takes it: --wrap (wrap=True) brings it in",
    "b07_transposed.npy": ": 2 points of 64 dimensions: is it transposed? Rows are points and columns "
    "coordinates; save its transpose, or say that its rows are points, by --columns 1-64",
    "b21_raw_f32_3d.dat": ": is binary, in no format known here; where it is numbers alone, say of what "
    "layout, such as --raw float32,3 (raw= in Python): the type, and how many a point has",
    "b23_rps_bigendian.rps": ": its floats are big-endian, the highest byte first, and an .rps has the "
    "lowest first: --raw '>float32,2' reads it",
    "b26_pos_box.npz": ": holds the arrays pos, box: say which are the points, such as --array pos",
}


def test_every_file_is_here_and_described() -> None:
    here = {path.name for path in FIELD.iterdir()} - {"README.md"}
    assert here == {*RIGHT, *REFUSED}
    assert {*re.findall(r"`(\w+_\w+\.\w+|dim20\.csv)`", (FIELD / "README.md").read_text())} == here


def test_the_points_to_compare_with_are_those_of_a_file() -> None:
    assert X.shape == (64, 2)
    assert X[0].tolist() == [0.2255759265496854, 0.734672310041916]
    assert RIGHT["dim20.csv"].shape == (32, 20)
    assert len(np.unique(RIGHT["d09_dup_pairs.txt"], axis=0)) == 32


@pytest.mark.parametrize("name", RIGHT)
def test_right(name: str) -> None:
    found = load(FIELD / name)
    assert isinstance(found, np.ndarray)
    assert np.array_equal(found, RIGHT[name])


@pytest.mark.parametrize("name", REFUSED)
def test_refused_in_words(name: str) -> None:
    with pytest.raises(FormatError) as caught:
        load(FIELD / name)
    assert str(caught.value) == f"{FIELD / name}{REFUSED[name]}"


def test_what_the_sentences_say_helps() -> None:
    """Each file that was refused is read once the user says what its error asks for."""
    assert np.array_equal(load(FIELD / "f07_weight_col.csv", columns="x,y"), X)
    assert np.array_equal(load(FIELD / "f09_trailing_comma.csv", columns="x,y"), X)
    assert np.shape(load(FIELD / "b07_transposed.npy", columns="1-64")) == (2, 64)
    pixels = np.loadtxt(FIELD / "f14_pixels.txt")
    assert np.array_equal(load(FIELD / "f14_pixels.txt", period=512), pixels / 512)
    rounded = np.loadtxt(FIELD / "f16_edge_rounding.txt")
    wrapped = np.where(rounded == -3e-17, 0, rounded % 1)
    assert np.array_equal(load(FIELD / "f16_edge_rounding.txt", wrap=True), wrapped)
    triples = np.fromfile(FIELD / "b21_raw_f32_3d.dat", "<f4").reshape(-1, 3)
    assert triples.shape == (1000, 3)
    assert np.array_equal(load(FIELD / "b21_raw_f32_3d.dat", raw="float32,3"), triples)
    pairs = np.fromfile(FIELD / "b23_rps_bigendian.rps", ">f4").reshape(-1, 2)
    assert np.array_equal(load(FIELD / "b23_rps_bigendian.rps", raw=">float32,2"), pairs)
    positions = np.load(FIELD / "b26_pos_box.npz")["pos"]
    assert np.array_equal(load(FIELD / "b26_pos_box.npz", array="pos"), positions)
