"""Indices and planes in tables of any format: no column becomes a dimension that the points have not."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from gbnbench.core.errors import FormatError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points import PointSets, load, save
from tests.io.point_bytes import npy, npz, put

P = np.random.default_rng(5).integers(0, 512, (12, 2)).astype(np.float64)


def written(folder: Path, suffix: str, table: FloatArray) -> Path:
    """A table without names in a format of that suffix."""
    text = "".join(" ".join(f"{v:.2f}" for v in row) + "\n" for row in table)
    data = {
        "npy": npy(table),
        "npz": npz(anything=table),
        "json": json.dumps(table.tolist()).encode(),
        "txt": text.encode(),
    }
    return put(folder, f"a.{suffix}", data[suffix])


@pytest.mark.parametrize("first", [0, 1, 100])
@pytest.mark.parametrize("suffix", ["npy", "npz", "json", "txt"])
def test_an_index_is_no_coordinate(tmp_path: Path, suffix: str, first: int) -> None:
    table = np.column_stack([first + np.arange(12.0), P])
    path = written(tmp_path, suffix, table)
    with pytest.raises(FormatError, match=r"first column numbers the rows: .* --columns 2,3, or name all"):
        load(path, period=512)
    assert np.array_equal(load(path, period=512, columns="2,3"), P / 512)
    assert np.array_equal(load(path, period=512, columns="1,2,3"), table / 512)


@pytest.mark.parametrize("suffix", ["npy", "npz", "json", "txt"])
def test_a_few_whole_numbers_in_turn_are_points(tmp_path: Path, suffix: str) -> None:
    table = np.array([[7.0, 3.5], [8.0, 1.25], [9.0, 7.5]])
    assert np.array_equal(load(written(tmp_path, suffix, table), period=16), table / 16)


def test_points_in_the_unit_of_their_own_box_may_count(tmp_path: Path) -> None:
    x = np.column_stack([np.arange(12) / 16, P[:, 1] / 512])
    save(tmp_path / "a.json", x)
    assert np.array_equal(load(tmp_path / "a.json"), x)
    boxed = put(tmp_path, "b.json", json.dumps({"sides": [16, 1], "points": (x * [16, 1]).tolist()}))
    assert np.array_equal(load(boxed), x)


PLANES: list[tuple[str, str]] = [
    ("a.csv", "x,y,z\n0.5,0.25,0\n0.125,0.75,0\n"),
    ("a.csv", "set,x,y,z\n0,0.5,0.25,0\n1,0.125,0.75,0\n"),
    ("a.tsv", "X\tY\tZ\n0.5\t0.25\t0\n0.125\t0.75\t0\n"),
    ("a.txt", "# x y z\n0.5 0.25 0.0\n0.125 0.75 0.0\n"),
    ("a.json", '[{"x": 0.5, "y": 0.25, "z": 0}, {"x": 0.125, "y": 0.75, "z": 0}]'),
    ("a.json", '{"x": [0.5, 0.125], "y": [0.25, 0.75], "z": [0, 0]}'),
]


@pytest.mark.parametrize(("name", "text"), PLANES)
def test_a_plane_is_told_from_space(tmp_path: Path, name: str, text: str) -> None:
    path = put(tmp_path, name, text.encode())
    with pytest.raises(FormatError, match="z is 0 in every point: a set of the plane is read by --columns x"):
        load(path)
    flat = np.array([[0.5, 0.25], [0.125, 0.75]])
    assert np.array_equal(np.reshape(load(path, columns="x,y"), (2, 2)), flat)
    space = np.column_stack([flat, [0, 0]])
    assert np.array_equal(np.reshape(load(path, columns="x,y,z"), (2, 3)), space)


@pytest.mark.parametrize("suffix", [".csv", ".json", ".npy", ".txt", ".dat"])
def test_our_own_planes_in_space_come_back(tmp_path: Path, suffix: str) -> None:
    x = np.column_stack([P[:5] / 512, np.full(5, 0.25)])
    save(tmp_path / f"a{suffix}", PointSets([x]).sets[0])
    assert np.array_equal(load(tmp_path / f"a{suffix}"), x)


JSON: list[tuple[str, str, int | None]] = [
    ("[[0.5, 0.25],\n [0.5, -1e400]]", "point 1: '-1e400' is too large for a number: remove the point", None),
    (f"[[0.5, {'9' * 400}]]", f"point 0: '{'9' * 37}...' is too large for a number", None),
    (f"[[0.5, {'9' * 5000}]]", f"point 0: '{'9' * 37}...' is too large for a number", None),
    ('{"x": 0.5, "y": 0.25}\n{"x": 0.1, "y": 0.75}\n', "a second value begins here, as in JSON Lines", 2),
    ('{"run": {"points": [[0.5, 0.25]]}}', "no 'points': it has 'run'; none of them a list: points", None),
    ("{}", "holds no points: points are lists of numbers", None),
    ("[[0.5, NaN]]", "NaN is not a number: remove the point", None),
]


@pytest.mark.parametrize(("text", "said", "line"), JSON)
def test_json_is_quoted(tmp_path: Path, text: str, said: str, line: int | None) -> None:
    with pytest.raises(FormatError) as caught:
        load(put(tmp_path, "a.json", text.encode()))
    assert said in str(caught.value)
    assert caught.value.line == line


def test_json_of_whole_numbers_of_many_digits(tmp_path: Path) -> None:
    """A float holds 10**305, which has more digits than Python's own limit asks to be read at once."""
    path = put(tmp_path, "a.json", f"[[{10**305}, {5 * 10**304}]]")
    assert np.array_equal(load(path, period=2e305), [[0.5, 0.25]])
