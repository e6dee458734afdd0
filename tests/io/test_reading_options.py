"""Boxes and columns that the user tells: fractions are right, contradictions refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gbnbench.core.errors import FormatError, InputError
from gbnbench.io.points import ReadingOptions, load, read_sets, reading_options


def text(folder: Path, content: str, name: str = "a.txt") -> Path:
    path = folder / name
    path.write_text(content)
    return path


def test_a_period_divides_by_the_sides(tmp_path: Path) -> None:
    path = text(tmp_path, "128 64\n0.5 256\n512 16\n")
    found = read_sets(path, ReadingOptions(period=(512.0, 256.0)))
    assert found.sets[0].tolist() == [[0.25, 0.25], [0.5 / 512, 0.0], [0.0, 0.0625]]
    assert (found.sides, found.low, found.toroidal) == ((512.0, 256.0), (0.0, 0.0), True)
    assert np.array_equal(load(path, period="512,256"), found.sets[0])


def test_bounds_divide_from_their_lower_end_and_keep_the_upper_edge(tmp_path: Path) -> None:
    path = text(tmp_path, "-1.0 10.0\n0.0 15.0\n1.0 20.0\n")
    found = read_sets(path, reading_options(bounds="-1,1,10,20"))
    below = float(np.nextafter(1, 0))
    assert found.sets[0].tolist() == [[0.0, 0.0], [0.5, 0.5], [below, below]]
    assert (found.sides, found.low, found.toroidal) == ((2.0, 10.0), (-1.0, 10.0), None)
    assert np.array_equal(load(path, bounds=((-1, 1), (10, 20))), found.sets[0])


def test_one_number_serves_every_axis(tmp_path: Path) -> None:
    path = text(tmp_path, "1.0 2.0 3.0\n")
    assert read_sets(path, reading_options(period=4)).sets[0].tolist() == [[0.25, 0.5, 0.75]]
    line = text(tmp_path, "1.0\n2.0\n", "line.txt")
    assert read_sets(line, reading_options(bounds=(1, 5))).sets[0].tolist() == [[0.0], [0.25]]
    with pytest.raises(FormatError, match=r"--bounds 1,5 is of 1 axis, .* d=3: write 1,5,1,5,1,5 for all"):
        load(path, bounds=(1, 5))


def test_wrap_takes_whole_sides_off(tmp_path: Path) -> None:
    path = text(tmp_path, "1.25 -0.25\n0.5 -1e-17\n")
    assert load(path, wrap=True).tolist() == [[0.25, 0.75], [0.5, 0.0]]  # type: ignore[union-attr]
    far = text(tmp_path, "5.0 -3.0\n1.0 20.0\n")
    assert load(far, period=4, wrap=True).tolist() == [[0.25, 0.25], [0.25, 0.0]]  # type: ignore[union-attr]
    with pytest.raises(FormatError, match=r"line 1: coordinate 5\.0 is not in \[0, 1\]; scale the points"):
        load(far, wrap=True)


def test_what_the_file_says_is_not_contradicted(tmp_path: Path) -> None:
    path = text(tmp_path, "0.5 0.25\n0.125 0.75\n")
    with pytest.raises(FormatError, match="--period 1,2,3 has 3 sides, and its points have d=2"):
        load(path, period=(1, 2, 3))
    with pytest.raises(FormatError, match="--bounds 0,1,0,1,0,1 is of 3 axes, and its points have d=2"):
        load(path, bounds=(0, 1, 0, 1, 0, 1))
    with pytest.raises(FormatError, match=r"line 2: coordinate 0\.6 is not in \[0, 0\.5\], the box; give"):
        load(text(tmp_path, "0.25 0.5\n0.6 0.1\n", "b.txt"), bounds=(0, 0.5, 0, 0.5))


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"period": (1, 2), "bounds": (0, 1)}, "give one of them"),
        ({"period": "512;512"}, "period must be numbers parted by commas"),
        ({"period": (1, 0)}, "each above 0; got 1,0"),
        ({"period": (1, float("nan"))}, "each above 0"),
        ({"bounds": (0, 1, 2)}, "lower and upper end of each axis"),
        ({"bounds": (0, 1, 2, 2)}, "low < high on each axis; axis 1 has 2, 2"),
        ({"bounds": (0, float("inf"))}, "lower and upper end"),
        ({"columns": "x,,y"}, "each column once"),
        ({"columns": ("x", "x")}, "each column once"),
        ({"columns": ()}, "each column once"),
        ({"columns": 1}, "columns must be names or numbers, such as 'x,y'"),
        ({"bounds": "abc"}, "parted by commas, such as 0,512,0,512; got 'abc'"),
        ({"raw": "float32"}, "such as float32,3; got 'float32'"),
        ({"raw": "object,2"}, "such as float32,3"),
        ({"raw": "float128,2"}, "such as float32,3"),
        ({"raw": "complex64,2"}, "such as float32,3"),
    ],
)
def test_options_that_cannot_be_meant(given: dict[str, object], said: str) -> None:
    with pytest.raises(InputError, match=said):
        reading_options(**given)  # type: ignore[arg-type]


def test_a_record_holds_what_was_given() -> None:
    assert ReadingOptions().record() == {}
    assert reading_options("x,y", "f4,2", "pos", None, (0, 1), True).record() == {
        "columns": ["x", "y"], "raw": "f4,2", "array": "pos", "bounds": [0.0, 1.0], "wrap": True
    }  # fmt: skip


def test_columns_are_numbers_too(tmp_path: Path) -> None:
    path = text(tmp_path, "0.5 0.25 7\n0.125 0.75 9\n")
    assert np.array_equal(load(path, columns=(2, 1)), [[0.25, 0.5], [0.75, 0.125]])


def test_raw_numbers_are_read_by_their_layout(tmp_path: Path) -> None:
    x = np.random.default_rng(0).random((20, 3)).astype("f4")
    path = tmp_path / "a.dat"
    path.write_bytes(x.tobytes())
    assert np.array_equal(load(path, raw="float32,3"), x)
    path.write_bytes(x.astype(">f4").tobytes())
    assert np.array_equal(load(path, raw=">f4,3"), x)
    assert np.array_equal(load(path, raw=">f4,3", columns="3,1"), x[:, [2, 0]])
    path.write_bytes((x * 512).astype("<u2").tobytes())
    assert np.array_equal(load(path, raw="uint16,3", period=512), (x * 512).astype("<u2") / 512)
    with pytest.raises(FormatError, match="120 bytes are no whole number of points of 7 float32"):
        load(path, raw="float32,7")
    path.write_bytes(bytes(48))
    with pytest.raises(FormatError, match="all bytes are zero"):
        load(path, raw="float32,3")


def test_row_numbers_are_no_coordinate(tmp_path: Path) -> None:
    path = text(tmp_path, "1 20.5 30.5\n2 10.5 40.5\n3 25.0 35.0\n")
    with pytest.raises(FormatError, match="line 1: the first column numbers the rows: take the others by"):
        load(path, period=512)
    assert load(path, period=512, columns="2,3").tolist()[0] == [20.5 / 512, 30.5 / 512]  # type: ignore[union-attr]
    assert np.shape(load(path, period=512, columns="1,2,3")) == (3, 3)


def test_whole_numbers_in_other_units_are_points_not_headers(tmp_path: Path) -> None:
    pixels = text(tmp_path, "115 376\n130 272\n")
    assert load(pixels, period=512).tolist() == [[115 / 512, 376 / 512], [130 / 512, 272 / 512]]  # type: ignore[union-attr]
    counted = text(tmp_path, "2\n115 376\n130 272\n", "counted.txt")
    assert np.array_equal(load(counted, period=512), load(pixels, period=512))
    authors = text(tmp_path, "2 2\n115.5 376\n130 272\n", "authors.txt")
    assert np.shape(load(authors, period=512)) == (2, 2)
    with pytest.raises(FormatError, match="line 1: '2 2' may be a header or a point"):
        load(text(tmp_path, "2 2\n115 376\n130 272\n", "either.txt"), period=512)
    with pytest.raises(FormatError, match="line 1: '5' may be a header or a point"):
        load(text(tmp_path, "5\n7\n9\n", "line.txt"), period=512)
    with pytest.raises(FormatError, match=r"line 1: this line says 115 points, and the file ends after 1"):
        load(text(tmp_path, "115 2\n0.5 0.25\n", "cut.txt"), period=512)
