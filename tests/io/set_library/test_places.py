"""A library is read from a folder and from archives alike, and what is damaged is named, never trusted."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import FormatError, InputError
from gbnbench.io.set_library import archive
from gbnbench.io.set_library.archive import pack, unpack
from gbnbench.io.set_library.manifest import Manifest
from gbnbench.io.set_library.places import Folder, manifest_of, open_place
from gbnbench.io.set_library.set_file import encoded, faults, read_sets
from tests.io.set_library.small_library import small_library

SUFFIXES = (".zip", ".tar", ".tar.gz", ".tgz")


@pytest.fixture
def library(tmp_path: Path) -> Path:
    small_library(tmp_path / "sets")
    return tmp_path / "sets"


def packed(library: Path, suffix: str) -> Path:
    path = library.parent / f"sets{suffix}"
    names = [entry.file for entry in manifest_of(Folder(library)).files]
    pack(library, ["manifest.json", *names], path)
    return path


@pytest.mark.parametrize("suffix", ["", *SUFFIXES])
def test_every_place_gives_the_same_sets(library, suffix):
    with open_place(packed(library, suffix) if suffix else library) as place:
        manifest = manifest_of(place)
        assert manifest.record() == manifest_of(Folder(library)).record()
        assert not faults(place, manifest)
        for entry in manifest.files:
            x = read_sets(place, entry)
            assert x.dtype == np.float64
            assert np.array_equal(x, np.random.default_rng(entry.n).random((2, entry.n, entry.d)))


def test_a_file_is_what_numpy_writes(library):
    name = "random/3d/random-3d-8.npy"
    assert encoded(np.load(library / name)) == (library / name).read_bytes()


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_an_archive_is_the_same_bytes_whenever_it_is_packed(library, suffix, monkeypatch):
    first = packed(library, suffix).read_bytes()
    for path in library.rglob("*"):
        if path.is_file():
            path.touch()
    monkeypatch.setattr("time.time", lambda: 2e9)
    assert packed(library, suffix).read_bytes() == first
    assert sorted(path.name for path in library.parent.iterdir()) == ["sets", f"sets{suffix}"]


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_unpacked_it_is_the_folder_again(library, suffix):
    before = {p.relative_to(library): p.read_bytes() for p in library.rglob("*") if p.is_file()}
    new = library.parent / "new"
    with open_place(packed(library, suffix)) as place:
        assert unpack(place, new) == 2
        with pytest.raises(InputError, match="new is not an empty folder"):
            unpack(place, new)
    assert {p.relative_to(new): p.read_bytes() for p in new.rglob("*") if p.is_file()} == before


def test_an_interrupted_unpacking_goes_on(library, monkeypatch):
    new, written = library.parent / "new", []

    def interrupted(path: Path, data: bytes) -> None:
        if written:
            path.parent.mkdir(parents=True, exist_ok=True)
            (path.parent / ".gbnbench-0123abcd-0000.tmp").write_bytes(data[:10])
            raise KeyboardInterrupt
        written.append(path)
        write_whole(path, data)

    monkeypatch.setattr(archive, "write_whole", interrupted)
    with pytest.raises(KeyboardInterrupt):
        unpack(Folder(library), new)
    monkeypatch.undo()
    before = written[0].stat().st_mtime_ns
    assert unpack(Folder(library), new) == 2
    assert written[0].stat().st_mtime_ns == before
    assert faults(Folder(new), manifest_of(Folder(new))) == {}


@pytest.mark.parametrize("name", ["thesis.tex", "first"])
def test_unpacking_touches_no_file_of_somebody_else(library, name):
    new = library.parent / "new"
    name = manifest_of(Folder(library)).files[0].file if name == "first" else name
    path = new / name
    path.parent.mkdir(parents=True)
    path.write_text("precious")
    with pytest.raises(InputError, match=f"new is not an empty folder: its {name} is not of this library"):
        unpack(Folder(library), new)
    assert [p for p in new.rglob("*") if p.is_file()] == [path]
    assert path.read_text() == "precious"


def test_a_file_that_is_missing_or_changed_is_named(library):
    place, manifest = Folder(library), manifest_of(Folder(library))
    first, second = manifest.files
    (library / first.file).unlink()
    data = bytearray((library / second.file).read_bytes())
    data[200] ^= 1
    (library / second.file).write_bytes(data)
    assert faults(place, manifest) == {
        first.file: "is missing",
        second.file: "was changed: its SHA-256 is not that of the manifest",
    }
    with pytest.raises(FormatError, match=f"{first.file}: is missing"):
        read_sets(place, first)


@pytest.mark.parametrize(
    ("data", "says"),
    [
        (b"garbage", "holds no array of numbers"),
        (encoded(np.full((2, 8, 3), np.nan)), r"holds coordinates that do not lie in \[0, 1\)"),
        (encoded(np.ones((2, 8, 3))), r"holds coordinates that do not lie in \[0, 1\)"),
        (encoded(np.zeros((2, 8, 2))), r"holds float64 of shape \(2, 8, 2\)"),
    ],
)
def test_what_is_no_point_set_is_refused_whatever_the_manifest_says(library, data, says):
    name = "random/3d/random-3d-8.npy"
    (library / name).write_bytes(data)
    record = json.loads((library / "manifest.json").read_text())
    for entry in record["files"]:
        entry["sha256"] = hashlib.sha256(data).hexdigest() if entry["file"] == name else entry["sha256"]
    (library / "manifest.json").write_text(json.dumps(record))
    manifest = manifest_of(Folder(library))
    entry = next(entry for entry in manifest.files if entry.file == name)
    with pytest.raises(FormatError, match=says):
        read_sets(Folder(library), entry)


def test_a_file_in_the_place_of_a_folder_is_a_fault_of_those_in_it(library):
    manifest = manifest_of(Folder(library))
    (library / "random" / "3d" / "random-3d-8.npy").unlink()
    (library / "random" / "3d").rmdir()
    (library / "random" / "3d").write_text("")
    assert faults(Folder(library), manifest) == {"random/3d/random-3d-8.npy": "is missing"}


def read_all(path: Path) -> list[str]:
    """Read everything of a library; what is wrong with its files."""
    with open_place(path) as place:
        return list(faults(place, manifest_of(place)).values())


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_half_an_archive_is_told(library, suffix):
    path = packed(library, suffix)
    data = path.read_bytes()
    path.write_bytes(data[: len(data.rstrip(b"\0")) // 2])  # a .tar ends in zeros
    try:
        found = read_all(path)
    except FormatError as error:  # where the manifest itself is beyond the end
        found = [str(error)]
    assert "read" in found[-1] or found[-1] == "is missing"


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_an_empty_file_is_no_archive(library, suffix):
    path = packed(library, suffix)
    path.write_bytes(b"")
    with pytest.raises(InputError, match=path.name):
        read_all(path)


def test_a_flipped_bit_in_a_zip_is_a_fault_of_its_file(library):
    path = packed(library, ".zip")
    data = bytearray(path.read_bytes())
    data[data.index(b"random-3d-8.npy") + 60] ^= (
        16  # within the first copy: the packed content behind the name
    )
    path.write_bytes(data)
    with open_place(path) as place:
        assert set(faults(place, manifest_of(place))) == {"random/3d/random-3d-8.npy"}


@pytest.mark.parametrize(
    ("central", "local", "value", "says"),
    [(8, 6, 1, "password"), (10, 8, 99, "compression method")],
)
def test_a_zip_that_is_locked_or_of_another_method_is_told(library, central, local, value, says):
    path = packed(library, ".zip")
    data = bytearray(path.read_bytes())
    for mark, offset in ((b"PK\x01\x02", central), (b"PK\x03\x04", local)):
        at = data.find(mark)
        while at >= 0:
            data[at + offset] = value
            at = data.find(mark, at + 4)
    path.write_bytes(data)
    with pytest.raises(FormatError, match=rf"manifest\.json: cannot be read \(.*{says}"):
        read_all(path)


def damaged(library: Path, change: Callable[[dict[str, Any]], object]) -> Path:
    record = json.loads((library / "manifest.json").read_text())
    change(record)
    (library / "manifest.json").write_text(json.dumps(record))
    return library


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (lambda r: r.update(format=2), "has format 2; this version reads 1"),
        (lambda r: r.update(kind="run"), "is not the manifest of a library"),
        (lambda r: r["files"][0].update(file="../../etc/passwd"), "names no file below a library"),
        (lambda r: r["files"][0].update(file="/etc/passwd"), "names no file below a library"),
        (lambda r: r["files"][0].update(shape=[3, 16, 2]), "of shape"),
        (lambda r: r["files"][0].pop("sha256"), "KeyError"),
        (lambda r: r.update(files=None), "TypeError"),
    ],
)
def test_a_manifest_that_is_something_else_is_refused(library, change, says):
    with pytest.raises(FormatError, match=says):
        manifest_of(Folder(damaged(library, change)))


def test_a_manifest_that_is_no_json_is_refused(library):
    for data in (b"\xff{", b"[" * 200_000):
        (library / "manifest.json").write_bytes(data)
        with pytest.raises(FormatError, match=r"manifest\.json: is not what gbnbench wrote"):
            manifest_of(Folder(library))


def test_what_is_no_library_is_refused(library):
    with pytest.raises(
        InputError, match=r"there is no folder or archive nothing; gbnbench library -o nothing"
    ):
        read_all(Path("nothing"))
    text = library.parent / "sets.txt"
    text.write_text("0.5 0.5\n")
    with pytest.raises(InputError, match="a library is a folder or an archive"):
        read_all(text)
    with pytest.raises(InputError, match=r"is not a library of gbnbench: it has no manifest\.json"):
        manifest_of(Folder(library / "random"))


def test_an_entry_takes_the_place_of_that_of_the_same_sets():
    empty = Manifest("0.0", 0, None)
    assert empty.entry("random", 16, 2) is None
    assert empty.to_frame().empty
