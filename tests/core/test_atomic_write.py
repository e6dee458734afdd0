"""Files that are whole or absent, and what killed processes leave beside them."""

from __future__ import annotations

import errno
import os
import time
from pathlib import Path

import pytest

from gbnbench.core import atomic_write
from gbnbench.core.atomic_write import remove_leftovers_of, write_whole


def leftover(path: Path, age: float) -> Path:
    """A temporary file of path, as a killed process leaves it."""
    file = atomic_write._temporary(path)
    file.write_bytes(b"half")
    os.utime(file, (time.time() - age, time.time() - age))
    return file


def test_the_next_write_removes_what_a_killed_one_left_of_this_file_alone(tmp_path: Path) -> None:
    path = tmp_path / "x.txt"
    old, other = leftover(path, 60), leftover(tmp_path / "y.txt", 60)
    fresh = leftover(path, 0)  # its process may be about to lock it
    write_whole(path, b"whole")
    assert path.read_bytes() == b"whole"
    assert not old.exists()
    assert other.exists()
    assert fresh.exists()


@pytest.mark.skipif(os.name == "nt", reason="Windows keeps open files by itself")
def test_a_file_that_another_process_writes_is_no_leftover(tmp_path: Path) -> None:
    path = tmp_path / "x.txt"
    busy = leftover(path, 60)
    with busy.open("r+b") as file:
        atomic_write._hold(file)
        remove_leftovers_of(path)
        assert busy.exists()
    remove_leftovers_of(path)
    assert not busy.exists()


def test_a_write_that_fails_leaves_nothing_and_the_old_content(tmp_path: Path, monkeypatch) -> None:
    path = tmp_path / "x.txt"
    write_whole(path, b"old")

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        write_whole(path, b"new")
    assert [p.name for p in tmp_path.iterdir()] == ["x.txt"]
    assert path.read_bytes() == b"old"


def test_a_fault_names_the_file_that_was_meant(tmp_path: Path) -> None:
    place = tmp_path / "report.html"
    place.mkdir()
    with pytest.raises(OSError, match=r"report\.html'$") as caught:
        write_whole(place, b"content")
    assert caught.value.filename == str(place)
    assert list(tmp_path.iterdir()) == [place]


def test_a_full_disk_leaves_the_old_file_and_no_other(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    atomic_write.write_whole(tmp_path / "a", b"old")
    atomic_write.write_folder_whole(tmp_path / "f", {"x": b"old"})

    def full(_: int) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space left"):
        atomic_write.write_whole(tmp_path / "a", b"new")
    with pytest.raises(OSError, match="No space left"):
        atomic_write.write_folder_whole(tmp_path / "f", {"x": b"new"})
    assert sorted(p.name for p in tmp_path.rglob("*")) == ["a", "f", "x"]
    assert (tmp_path / "a").read_bytes() == (tmp_path / "f" / "x").read_bytes() == b"old"
