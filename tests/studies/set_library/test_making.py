"""A library is made in parts to the same bits; refused sets are told, and spoilt files made again."""

from __future__ import annotations

import json
import shutil
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np
import pandas as pd
import pytest

import gbnbench
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.io.set_library.places import Folder, manifest_of, open_place
from gbnbench.io.set_library.set_file import faults
from gbnbench.studies.set_library.making import MadeLibrary, finished_files, make_library
from gbnbench.studies.set_library.request import LibraryRequest, RequestedSets, library_request

pytestmark = pytest.mark.slow

NAMES = ("jittered", "random")


def made(out: Path, names=NAMES, n=(16, 64), d=(2, 3), realizations=3, **options) -> MadeLibrary:
    return make_library(library_request(names, n, d, realizations), out, jobs=1, **options)


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> MadeLibrary:
    """A library in a folder, made once; tests that change it take a copy."""
    return made(tmp_path_factory.mktemp("whole") / "sets")


@pytest.fixture
def copy(whole: MadeLibrary, tmp_path: Path) -> Path:
    """A copy of it."""
    return Path(shutil.copytree(whole.place, tmp_path / "sets"))


def contents(folder: Path) -> dict[str, bytes]:
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*.npy")}


def test_files_hold_what_generate_draws_and_the_manifest_what_measures_says(whole):
    # jittered grids have m**d points: 64 = 8**2 = 4**3, 16 = 4**2
    assert sorted(contents(whole.place)) == [
        "jittered/2d/jittered-2d-16.npy",
        "jittered/2d/jittered-2d-64.npy",
        "jittered/3d/jittered-3d-64.npy",
        "random/2d/random-2d-16.npy",
        "random/2d/random-2d-64.npy",
        "random/3d/random-3d-16.npy",
        "random/3d/random-3d-64.npy",
    ]
    assert (whole.made, whole.found) == (7, 0)
    x = np.load(whole.place / "jittered/3d/jittered-3d-64.npy")
    assert np.array_equal(x, gbnbench.generate("jittered", n=64, d=3, realizations=3))
    entry = whole.manifest.entry("jittered", 64, 3)
    measured = gbnbench.measures(x)
    assert entry.measures == {name: value for name, value in measured.items() if np.isfinite(value)}
    assert entry.undefined == measured.reasons
    assert entry.standard_errors["noise_floor"] == measured.standard_error["noise_floor"]
    (refused,) = whole.manifest.refused
    assert (refused.generator, refused.n, refused.d, refused.tried) == ("jittered", 16, 3, 0)
    assert "nearest" in refused.reason
    assert not (whole.place / "pieces").exists()


def test_the_manifest_reads_back_and_its_table_has_a_row_a_file(whole):
    assert manifest_of(Folder(whole.place)).record() == whole.manifest.record()
    record = json.loads((whole.place / "manifest.json").read_text())
    assert record["seed"] == 0
    assert record["gbnbench"] == gbnbench.__version__
    assert record["files"][0]["shape"] == [3, 16, 2]
    assert record["files"][0]["dtype"] == "float64"
    table = pd.read_csv(whole.place / "manifest.csv")
    assert table.file.tolist() == [entry.file for entry in whole.manifest.files]
    assert table.noise_floor.tolist() == [entry.measures["noise_floor"] for entry in whole.manifest.files]


def test_made_in_parts_it_is_the_library_made_at_once(whole, tmp_path):
    made(tmp_path / "parts", d=(3,), n=(16,))
    done = made(tmp_path / "parts")
    assert (done.made, done.found) == (6, 1)
    assert contents(tmp_path / "parts") == contents(whole.place)


def test_more_realizations_begin_with_those_that_were_there_and_fewer_change_nothing(tmp_path):
    made(tmp_path / "sets", ("random",), (16,), (2,), 2)
    file = tmp_path / "sets" / "random/2d/random-2d-16.npy"
    two = np.load(file)
    assert made(tmp_path / "sets", ("random",), (16,), (2,), 5).made == 1
    five = np.load(file)
    assert five.shape == (5, 16, 2)
    assert np.array_equal(five[:2], two)
    assert made(tmp_path / "sets", ("random",), (16,), (2,), 3).found == 1
    assert np.array_equal(np.load(file), five)


def test_a_file_that_was_changed_or_lost_is_made_again_and_only_that(copy, tmp_path):
    before = contents(tmp_path / "sets")
    spoilt, lost = sorted(before)[:2]
    data = bytearray(before[spoilt])
    data[-1] ^= 1
    (tmp_path / "sets" / spoilt).write_bytes(data)
    (tmp_path / "sets" / lost).unlink()
    place = Folder(tmp_path / "sets")
    assert set(faults(place, manifest_of(place))) == {spoilt, lost}
    assert made(tmp_path / "sets").made == 2
    assert contents(tmp_path / "sets") == before


def test_another_seed_or_another_folder_is_refused_and_left_alone(copy, tmp_path):
    before = contents(tmp_path / "sets")
    with pytest.raises(InputError, match="seed is 0 there, 1 here"):
        made(tmp_path / "sets", seed=1)
    assert contents(tmp_path / "sets") == before
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "letter.txt").write_text("precious")
    with pytest.raises(InputError, match="not empty and is not a library"):
        made(tmp_path / "other")
    assert [path.name for path in (tmp_path / "other").iterdir()] == ["letter.txt"]


def test_an_archive_holds_the_same_files_and_can_be_added_to(whole, tmp_path):
    archive = tmp_path / "sets.zip"
    made(archive, ("random",), (64,))
    done = made(archive)
    assert (done.made, done.found) == (5, 2)
    assert [path.name for path in tmp_path.iterdir()] == ["sets.zip"]
    with open_place(archive) as place:
        assert not faults(place, manifest_of(place))
        assert {entry.file: place.read(entry.file) for entry in done.manifest.files} == contents(whole.place)


def test_an_archive_of_another_seed_or_one_that_is_damaged_is_refused_and_left_alone(tmp_path):
    archive = tmp_path / "sets.zip"
    made(archive, ("random",), (16,), (2,))
    whole = archive.read_bytes()
    with pytest.raises(InputError, match=r"sets\.zip holds a library .*seed is 0 there, 1 here"):
        made(archive, ("random",), (16,), (2,), seed=1)
    assert archive.read_bytes() == whole
    archive.write_bytes(whole[: len(whole) // 2])
    with pytest.raises(InputError, match=r"sets\.zip: is no archive that can be read"):
        made(archive, ("random",), (16,), (2,))
    assert [path.name for path in tmp_path.iterdir()] == ["sets.zip"]


def test_an_archive_is_not_replaced_by_a_folder_that_lacks_its_sets(tmp_path):
    archive = tmp_path / "sets.zip"
    made(archive, ("random",), (16,), (2, 3))
    whole = archive.read_bytes()
    made(tmp_path / "sets.zip.unfinished", ("random",), (16,), (2,))
    with pytest.raises(InputError, match=r"sets\.zip has sets of random/3d/random-3d-16\.npy that "):
        made(archive, ("random",), (64,), (2,))
    assert archive.read_bytes() == whole
    shutil.rmtree(tmp_path / "sets.zip.unfinished")
    made(tmp_path / "sets.zip.unfinished", ("random",), (16,), (2, 3), realizations=2)
    with pytest.raises(InputError, match=r"sets\.zip has sets of random/2d/random-2d-16\.npy that "):
        made(archive, ("random",), (64,), (2,))
    assert archive.read_bytes() == whole


@pytest.mark.parametrize("gone", ["manifest.json", "settings.json", "random"])
def test_killed_while_the_folder_of_an_archive_is_deleted_nothing_is_lost(tmp_path, monkeypatch, gone):
    archive, rmtree = tmp_path / "sets.zip", shutil.rmtree

    def half(path: Path, **options: object) -> None:
        """Delete one file of the finished folder, and then be killed."""
        found = Path(path) / gone
        if not found.exists():
            return
        rmtree(found) if found.is_dir() else found.unlink()
        raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr("gbnbench.studies.set_library.making.shutil.rmtree", half)
        with pytest.raises(KeyboardInterrupt):
            made(archive, ("random",), (16,), (2, 3))
    done = made(archive, ("random",), (64,), (2,))
    assert [(entry.n, entry.d) for entry in done.manifest.files] == [(16, 2), (64, 2), (16, 3)]
    assert [path.name for path in tmp_path.iterdir()] == ["sets.zip"]


@dataclass(frozen=True)
class Moody:
    """Random points, but none from the streams that begin below a half."""

    name: ClassVar[str] = "moody"
    summary: ClassVar[str] = "random points, at times"

    def refusal(self, n: int, d: int) -> str | None:
        return None

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> np.ndarray:
        if n < 10 or rng.random() < 0.5:
            raise RefusalError("not today")
        return rng.random((n, d))


def test_a_set_that_its_generator_cannot_make_is_told_and_not_tried_again(tmp_path):
    requested = RequestedSets("moody/2d/moody-2d-16", Moody(), 16, 2, 8)
    hopeless = RequestedSets("moody/2d/moody-2d-8", Moody(), 8, 2, 8)
    done = make_library(LibraryRequest((hopeless, requested), ()), tmp_path / "sets", jobs=1)
    (entry,) = done.manifest.files
    drawn = [k for k in range(8) if first_number(k) >= 0.5]
    assert 0 < len(drawn) < 8
    assert entry.realizations == tuple(drawn)
    assert entry.refused == {str(k): "not today" for k in range(8) if k not in drawn}
    assert np.load(tmp_path / "sets" / entry.file).shape == (len(drawn), 16, 2)
    (refused,) = done.manifest.refused
    assert (refused.n, refused.reason, refused.tried) == (8, "not today", 8)
    again = make_library(LibraryRequest((hopeless, requested), ()), tmp_path / "sets", jobs=1)
    assert (again.made, again.found) == (0, 2)


def first_number(k: int) -> float:
    return float(np.random.default_rng(np.random.SeedSequence(0, spawn_key=(k,))).random())


def test_what_is_there_is_known_before_the_work(whole, tmp_path):
    request = library_request([*NAMES, "grid"], (16, 64), (2, 3), 3)
    assert finished_files(request, tmp_path / "sets") == []
    assert {sets.text for sets in finished_files(request, whole.place)} == set(NAMES)
    assert finished_files(library_request(NAMES, (16,), (2,), 4), whole.place) == []
