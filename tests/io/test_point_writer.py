"""Point sets written: read back bit for bit, replaced whole, refused without a trace."""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gbnbench.core.errors import FormatError, InputError
from gbnbench.io.points import load, read, read_sets, save
from gbnbench.io.points.point_sets import PointSets
from tests.io.point_bytes import A, put

WRITTEN = [".txt", ".dat", ".csv", ".npy", ".npz"]
coordinate = st.one_of(
    st.floats(0, 1, exclude_max=True, allow_subnormal=True),
    st.sampled_from([0.0, 5e-324, 1e-300, 2**-64, 0.1, 1 / 3, float(np.nextafter(1, 0))]),
)


@st.composite
def some_sets(draw: st.DrawFn) -> list[np.ndarray]:
    d = draw(st.integers(1, 5))
    rows = st.lists(st.lists(coordinate, min_size=d, max_size=d), min_size=1, max_size=4)
    return [np.array(x) for x in draw(st.lists(rows, min_size=1, max_size=3))]


@pytest.mark.parametrize("suffix", WRITTEN)
def test_what_is_written_is_read(suffix: str, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.mktemp("round") / f"trip{suffix}"

    @settings(max_examples=150, derandomize=True, deadline=None, database=None)
    @given(some_sets())
    def check(sets: list[np.ndarray]) -> None:
        same = len({len(x) for x in sets}) == 1
        if suffix == ".npy" and not same:
            with pytest.raises(InputError, match="one size"):
                save(path, sets)
            return
        save(path, sets)
        assert [x.tobytes() for x in read(path)] == [x.tobytes() for x in sets]
        assert [x.shape for x in read(path)] == [x.shape for x in sets]
        back = load(path)
        if len(sets) == 1:
            assert np.shape(back) == sets[0].shape
        elif same:
            assert np.shape(back) == (len(sets), *sets[0].shape)
        else:
            assert isinstance(back, list)

    check()


def test_written_text_is_that_of_the_others(tmp_path: Path) -> None:
    x = np.array([A, [[0.0, 0.875], [1 / 3, 0.1]]])
    save(tmp_path / "a.txt", x)
    assert (
        tmp_path / "a.txt"
    ).read_text() == "2\n0.5 0.25\n0.125 0.75\n2\n0.0 0.875\n0.3333333333333333 0.1\n"
    save(tmp_path / "a.txt", [[0.5, 0.25, 0.125]])
    assert (tmp_path / "a.txt").read_text() == "1 3\n0.5 0.25 0.125\n"
    save(tmp_path / "a.dat", x)
    assert (
        tmp_path / "a.dat"
    ).read_text() == "0.5\t0.25\n0.125\t0.75\n#\n0.0\t0.875\n0.3333333333333333\t0.1\n"
    save(tmp_path / "a.csv", A)
    assert (tmp_path / "a.csv").read_text() == "x0,x1\n0.5,0.25\n0.125,0.75\n"


def test_save_refuses_and_leaves_no_trace(tmp_path: Path) -> None:
    kept = put(tmp_path, "kept.txt", b"before")
    with pytest.raises(InputError, match=r"written as \.txt, \.dat, \.csv, .*; got extension '\.rps'"):
        save(tmp_path / "a.rps", A)
    with pytest.raises(InputError, match=r"must lie in \[0, 1\)"):
        save(kept, [[0.5, 1.0]])
    with pytest.raises(InputError, match="of one d"):
        save(kept, [np.zeros((2, 2)), np.zeros((2, 3))])
    with pytest.raises(InputError, match=r"cannot write .*absent/a\.txt: no such file"):
        save(tmp_path / "absent" / "a.txt", A)
    with pytest.raises(InputError, match="not a directory"):
        save(kept / "a.txt", A)
    (tmp_path / "folder.txt").mkdir()
    with pytest.raises(InputError, match="it is a folder"):
        save(tmp_path / "folder.txt", A)
    with pytest.raises(InputError, match="null byte"):
        save(f"{tmp_path}/a\0.txt", A)
    assert kept.read_bytes() == b"before"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["folder.txt", "kept.txt"]


def test_save_replaces_whole(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A write that fails half way leaves the old file and no other; a link stays a link."""
    kept = put(tmp_path, "kept.txt", b"before")
    (tmp_path / "link.txt").symlink_to(kept)

    def full(_: int) -> None:
        raise OSError(28, "No space left on device")

    with monkeypatch.context() as patch:
        patch.setattr(os, "fsync", full)
        with pytest.raises(InputError, match="no space left"):
            save(tmp_path / "link.txt", A)
    assert kept.read_bytes() == b"before"
    save(tmp_path / "link.txt", A)
    assert (tmp_path / "link.txt").is_symlink()
    assert kept.read_bytes() == b"2\n0.5 0.25\n0.125 0.75\n"
    assert sorted(p.name for p in tmp_path.iterdir()) == ["kept.txt", "link.txt"]


@pytest.mark.parametrize("suffix", [".txt", ".csv", ".tsv", ".dat", ".npz", ".json", ".edat", ".csv.gz"])
def test_few_points_of_many_dimensions_come_back(tmp_path: Path, suffix: str) -> None:
    """A header, names or the format say that rows are points: nothing is taken for transposed."""
    x = np.random.default_rng(3).random((4, 16))
    save(tmp_path / f"a{suffix}", x)
    assert np.array_equal(load(tmp_path / f"a{suffix}"), x)
    sets = np.random.default_rng(4).random((3, 2, 20))
    save(tmp_path / f"b{suffix}", sets)
    assert np.array_equal(load(tmp_path / f"b{suffix}"), sets)


@pytest.mark.parametrize("suffix", [".npy", ".asc"])
def test_a_bare_matrix_of_few_points_is_read_where_columns_are_told(tmp_path: Path, suffix: str) -> None:
    x = np.random.default_rng(3).random((4, 16))
    path = tmp_path / f"a{suffix}"
    if suffix == ".npy":
        save(path, x)
    else:
        np.savetxt(path, x, "%.17g")
    with pytest.raises(FormatError, match=r"4 points of 16 dimensions: is it transposed\? .* --columns 1-16"):
        load(path)
    assert np.array_equal(load(path, columns="1-16"), x)
    assert np.array_equal(load(path, columns="2,4-6"), x[:, [1, 3, 4, 5]])


@pytest.mark.parametrize("suffix", [".npz", ".json", ".xyz", ".edat", ".lammpstrj"])
def test_what_rounds_to_the_upper_end_is_read_again(tmp_path: Path, suffix: str) -> None:
    """0.3 + 1e5 is rounded upwards by more than the distance of the point from the end."""
    rng = np.random.default_rng(4)
    points = np.concatenate([np.full((1, 3), 1 - 2**-53), rng.random((50, 3))])
    sets = PointSets([points], (1e5, 3e5, 0.1), (0.3, -7.0, 1e3), True)
    for made in (sets, PointSets([points], (0.3, 7.0, 1e3), (1e5, -3e5, 0.1), True)):
        save(tmp_path / f"x{suffix}", made)
        again = read_sets(tmp_path / f"x{suffix}")
        away = np.abs(again.sets[0] - points)
        size = np.abs(np.array(made.low)) + np.array(made.sides)
        assert (np.minimum(away, 1 - away) * np.array(made.sides) <= 4e-16 * size).all()
