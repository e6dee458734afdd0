"""``gbnbench.export_sets``: real files, read back by their own formats, and the words on what was done."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import gbnbench
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import toroidal_distance
from gbnbench.io.points import read_sets
from gbnbench.io.points.options import reading_options
from gbnbench.io.points.writer import WRITTEN

X = np.random.default_rng(7).random((2, 30, 2))


def export(path: Path, source: object = X, **settings: object) -> gbnbench.ExportedSets:
    return gbnbench.export_sets(path, source, **settings)


@pytest.mark.parametrize("suffix", [".bin", ".raw"])
@pytest.mark.parametrize("number_type", ["float32", "float64", "uint32"])
def test_binary_numbers_are_what_their_description_says(tmp_path: Path, suffix: str, number_type: str):
    path = tmp_path / f"sets{suffix}"
    made = export(path, number_type=number_type)
    beside = tmp_path / f"sets{suffix}.json"
    assert made.files == (path, beside)
    about = json.loads(beside.read_text())
    values = np.fromfile(path, np.dtype(about["dtype"]).newbyteorder("<")).reshape(about["shape"])
    assert about["dtype"] == number_type
    assert about["byte_order"] == "little"
    found = values / 2.0**32 if number_type == "uint32" else values.astype(float)
    assert np.array_equal(found, made.points)
    assert toroidal_distance(found, X).max() <= 2.0**-24
    if number_type != "uint32":
        raw = reading_options(raw=f"{number_type},2")
        assert np.array_equal(read_sets(path, raw).sets[0], made.points.reshape(-1, 2))


def test_json_is_read_back_and_tells_its_origin(tmp_path: Path):
    export(tmp_path / "sets.json")
    assert np.array_equal(gbnbench.load(tmp_path / "sets.json"), X)
    about = json.loads((tmp_path / "sets.json").read_text())
    assert about["gbnbench"] == gbnbench.__version__
    assert about["quality"][0]["axes"] == "0+1"


@pytest.mark.parametrize("suffix", [suffix for suffix in WRITTEN if suffix not in (".json", ".ply")])
def test_the_other_formats_keep_every_bit(tmp_path: Path, suffix: str):
    x = np.random.default_rng(1).random((20, 3))
    made = export(tmp_path / f"sets{suffix}", x, copies=2)
    assert np.array_equal(np.stack(read_sets(tmp_path / f"sets{suffix}").sets), made.points)


def test_a_generator_draws_what_generate_does(tmp_path: Path):
    made = export(tmp_path / "sets.json", "jittered", n=27, d=3, realizations=2, seed=4)
    assert np.array_equal(made.points, gbnbench.generate("jittered", n=27, d=3, realizations=2, seed=4))
    header = export(tmp_path / "sets.h", "jittered", n=27, d=3, seed=4)
    text = (tmp_path / "sets.h").read_text()
    assert "sets_points[set][point][axis]: 1 set of 27 points of the unit torus, d=3, float32" in text
    assert "On axes 0+2: noise floor" in text
    assert len(header.projections) == 6


def test_copies_differ_and_keep_the_spectrum(tmp_path: Path):
    made = export(tmp_path / "sets.json", X[0], copies=9, seed=3)
    assert np.array_equal(made.points[0], X[0])
    power = [
        np.sort(gbnbench.periodogram(x, 2).power.ravel()) for x in made.points
    ]  # flips and swaps move it within a shell
    assert all(one == pytest.approx(power[0], abs=1e-10) for one in power)
    assert len({x.tobytes() for x in made.points}) == 9
    assert [copy.of for copy in made.copies] == [0] * 9
    again = export(tmp_path / "again.json", X[0], copies=9, seed=3)
    assert np.array_equal(again.points, made.points)


def test_what_is_done_is_done_in_its_order_and_told(tmp_path: Path):
    made = export(
        tmp_path / "sets.h", X[0], swap=[(0, 1)], flip=[0], shift=[0.5, 0.25], number_type="float64"
    )
    expected = np.stack([(1.5 - X[0, :, 1]) % 1, (X[0, :, 0] + 0.25) % 1], axis=1)
    assert toroidal_distance(made.points[0], expected).max() < 1e-15
    words = "set 0 of the source; axes in the order 1,0; flipped on 0; shifted by 0.5,0.25"
    assert made.copies[0].words() == words
    assert f"Set 0: {words}." in (tmp_path / "sets.h").read_text()


def test_a_random_shift_is_drawn_from_the_seed(tmp_path: Path):
    shifts = [
        export(tmp_path / "sets.json", X, shift="random", seed=seed).copies[0].done[0].shift
        for seed in (1, 1, 2)
    ]
    assert shifts[0] == shifts[1] != shifts[2]


def test_a_repeated_tile_has_its_own_box(tmp_path: Path):
    made = export(tmp_path / "sets.json", X[0], repeat=(2, 1))
    assert made.points.shape == (1, 60, 2)
    assert made.sides == (2.0, 1.0)
    found = read_sets(tmp_path / "sets.json")
    assert found.sides == (2.0, 1.0)
    assert np.stack(found.sets)[0] == pytest.approx(made.points[0], abs=1e-15)
    assert sorted((made.points[0] * (2, 1) % 1).round(9).tolist()) == sorted([*X[0].round(9).tolist()] * 2)
    with pytest.raises(InputError, match="text cannot hold a box of unequal sides, 2 x 1"):
        export(tmp_path / "sets.txt", X[0], repeat=(2, 1))
    assert export(tmp_path / "sets.txt", X[0], repeat=(2, 2)).sides is None


def test_rounding_that_costs_is_remarked_upon(tmp_path: Path):
    made = export(tmp_path / "sets.h", "stealthy", n=256)
    assert made.unrounded.noise_floor < 1e-27
    assert 1e-14 < made.quality.noise_floor < 1e-12
    (remark,) = made.remarks
    assert remark.startswith("rounding to float32 raises the noise floor from ")
    assert remark.endswith("; float64 keeps it")
    assert remark in (tmp_path / "sets.h").read_text()
    assert export(tmp_path / "sets.h", "stealthy", n=256, number_type="float64").remarks == ()
    near = np.array([[0.5, 0.5], [0.5 + 1e-9, 0.5], [0.1, 0.1]])
    assert "rounding to float32 makes points coincide" in export(tmp_path / "sets.h", near).remarks
    last = np.concatenate([np.random.default_rng(0).random((9, 3, 2)), near[None]])  # beyond those measured
    assert "rounding to float32 makes points coincide" in export(tmp_path / "sets.h", last).remarks
    twice = np.array([[0.5, 0.5], [0.5, 0.5], [0.1, 0.1]])  # not by rounding
    assert export(tmp_path / "sets.h", twice).remarks == ()


def test_whole_numbers_of_numpy_are_whole_numbers(tmp_path: Path):
    made = export(tmp_path / "sets.json", X[0], copies=np.int64(2), seed=np.uint8(3), repeat=np.array([2, 1]))
    same = export(tmp_path / "same.json", X[0], copies=2, seed=3, repeat=(2, 1))
    assert np.array_equal(made.points, same.points)
    assert (tmp_path / "sets.json").read_text() == (tmp_path / "same.json").read_text()


def test_a_header_says_of_which_sets_its_noise_floor_is(tmp_path: Path):
    for sets, said in ((8, "(1 for random points): "), (9, "(1 for random points, of the first 8 sets): ")):
        made = export(tmp_path / "sets.h", np.random.default_rng(4).random((sets, 5, 2)))
        assert made.measured == 8
        assert f"Noise floor {said}" in (tmp_path / "sets.h").read_text()


def test_sets_of_several_files_go_together(tmp_path: Path):
    for k, x in enumerate(X):
        gbnbench.save(tmp_path / f"{k}.txt", x)
    gbnbench.save(tmp_path / "other.txt", X[0, :20])
    made = export(tmp_path / "sets.json", [tmp_path / "0.txt", tmp_path / "1.txt"])
    assert np.array_equal(made.points, X)
    with pytest.raises(InputError, match="one n and d; got n=30, d=2 of 0 and n=20, d=2 of other"):
        export(tmp_path / "sets.json", [tmp_path / "0.txt", tmp_path / "other.txt"])


@pytest.mark.parametrize(
    ("name", "settings", "said"),
    [
        ("sets.docx", {}, r"sets are exported as .h, .bin, .raw, .*; got extension '.docx'"),
        ("sets.png", {}, "pictures hold masks"),
        ("sets.json", {"number_type": "uint32"}, "uint32 is written to .h, .bin and .raw"),
        ("sets.xyz", {}, "XYZ holds points of three dimensions; got d=2"),
        ("sets.ply", {}, "a PLY file holds one set; got several, which .npz and .txt hold"),
        ("sets.h", {"number_type": "half"}, "type must be one of"),
        ("sets.h", {"copies": 0}, "copies must be a whole number >= 1; got 0"),
        ("sets.h", {"seed": -1}, "seed must be a whole number >= 0; got -1"),
        ("sets.h", {"seed": 1.5}, "seed must be a whole number >= 0; got 1.5"),
        ("sets.h", {"swap": [0, 1]}, "swap must name two axes of 0 to 1, each once; got 0"),
        ("sets.h", {"flip": 0}, "flip must name axes of 0 to 1, each once; got 0"),
        ("sets.h", {"repeat": 2}, "repeat must be 2 whole numbers of at least 1, one for each axis; got 2"),
        ("sets.h", {"flip": [2]}, "flip must name axes of 0 to 1"),
        ("sets.h", {"swap": [(0,)]}, "swap must name two axes"),
        ("sets.h", {"shift": "far"}, "shift must be random or 2 numbers"),
        ("sets.h", {"shift": [0.1]}, "shift must be 2 finite numbers"),
        ("sets.h", {"repeat": (2,)}, "repeat must be 2 whole numbers"),
        ("nowhere/sets.h", {}, "there is no folder"),
        ("sets.h", {"source": np.full((3, 2), np.nan)}, r"points must lie in \[0, 1\)"),
        ("sets.h", {"source": np.zeros((0, 2))}, "no empty axis"),
        ("sets.h", {"source": "jittered", "n": 10}, "nearest is 9"),
    ],
)
def test_what_cannot_be_is_refused_before_the_work(tmp_path: Path, name, settings, said):
    with pytest.raises(InputError, match=said):
        export(tmp_path / name, **settings)
    assert list(tmp_path.iterdir()) == []


def test_more_than_memory_holds_is_refused(tmp_path: Path):
    with pytest.raises(RefusalError, match="export fewer"):
        export(tmp_path / "sets.h", X[0], repeat=(2**20, 2**20))
