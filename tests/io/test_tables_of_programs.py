"""Tables as programs of the field export them: the right points, or advice that works when it is followed."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import numpy as np
import pytest

from gbnbench.core.errors import FormatError
from gbnbench.io.points import load
from tests.io.point_bytes import put

P = [[0.125, 0.25], [0.5, 0.75]]

READ: list[tuple[str, str]] = [
    ("tabs, blanks in a cell and an empty one",
     "label\tx\ty\tarea\tnote\ncell 1\t0.125\t0.25\t\t1\ncell 2\t0.5\t0.75\t\t1\n"),
    ("the same with quoted names",
     '"label"\t"x"\t"y"\t"area"\ncell 1\t0.125\t0.25\t\ncell 2\t0.5\t0.75\t7\n'),
    ("tabs and a comma in a cell", "x\ty\tlabel\tnote\n0.125\t0.25\ta, b\t\n0.5\t0.75\tc\td\n"),
    ("tabs at the ends", "label\tx\ty\ncell 1\t0.125\t0.25\t\ncell 2\t0.5\t0.75\n"),
    ("tabs, decimal commas and words", "label\tx\ty\ncell 1, a\t0,125\t0,25\nb\t0,5\t0,75\n"),
    ("a tab in front", "\tx\ty\nfirst one\t0.125\t0.25\nsecond one\t0.5\t0.75\n"),
    ("tabs in front of all", "\tx\ty\n\t0.125\t0.25\n\t0.5\t0.75\n"),
    ("tabs that line columns up", "name\tx\ty\nlonger\t\t0.125\t0.25\na\t\t0.5\t0.75\n"),
    ("ImageJ's results", "   \tLabel\tX\tY\n1\t\t0.125\t0.25\n2\tb c\t0.5\t0.75\n"),
    ("a comment among tabs", "label\tx\ty\ncell 1\t0.125\t0.25\n# half way\ncell 2\t0.5\t0.75\n"),
    ("a semicolon in a quoted name", 'x,y,"note; more"\n0.125,0.25,a\n0.5,0.75,b\n'),
    ("a semicolon in a name", "x,y,note; more\n0.125,0.25,a\n0.5,0.75,b\n"),
    ("blanks and quoted words", 'label x y\n"cell 1" 0.125 0.25\n"cell 2" 0.5 0.75\n'),
]  # fmt: skip


@pytest.mark.parametrize("text", [r[1] for r in READ], ids=[r[0] for r in READ])
def test_columns_stand_under_their_names(tmp_path: Path, text: str) -> None:
    assert np.array_equal(load(put(tmp_path, "a.txt", text.encode()), columns="x,y"), P)


@pytest.mark.parametrize("front", ["", "0", "1"])
def test_tabs_in_front_and_at_the_ends_need_no_names(tmp_path: Path, front: str) -> None:
    rows = [f"{front and int(front) + k}\t{x}\t{y}\t" for k, (x, y) in enumerate(P)]
    path = put(tmp_path, "a.txt", "\n".join([" \tX\tY\t", *rows, ""]).encode())
    assert np.array_equal(load(path), P)


# program, line of names, what stands before and behind the coordinates
ADVISED: list[tuple[str, str, str]] = [
    ("napari", "index,axis-0,axis-1", "7,{0},{1}"),
    ("ParaView, of the plane", "Mass,Points:0,Points:1", "1,{0},{1}"),
    ("QuPath", "Image,Class,Centroid X µm,Centroid Y µm", "a.svs,Tumor: Positive,{0},{1}"),
    ("QuPath, tabs", "Image\tClass\tCentroid X µm\tCentroid Y µm", "a b.svs\tTumor, Positive\t{0}\t{1}"),
    ("TrackMate", "ID,POSITION_X,POSITION_Y,FRAME", "3,{0},{1},0"),
    ("CellProfiler", "ImageNumber,Location_Center_X,Location_Center_Y", "1,{0},{1}"),
    ("scikit-image", "label,centroid-0,centroid-1", "5,{0},{1}"),
    ("trackpy", "y,x,mass", "{1},{0},100"),
    ("ImageJ", " ,Area,Mean,X,Y", "1,20,100.5,{0},{1}"),
    ("columns of an image", "n,xc,yc", "9,{0},{1}"),
    ("units", "x (µm),y (µm)", "{0},{1}"),
    ("units first", "µm x,µm y", "{0},{1}"),
]


@pytest.mark.parametrize(("names", "row"), [r[1:] for r in ADVISED], ids=[r[0] for r in ADVISED])
@pytest.mark.parametrize("encoding", ["utf-8", "latin-1"])
def test_advised_columns_are_the_coordinates(tmp_path: Path, names: str, row: str, encoding: str) -> None:
    text = "\n".join([names, *(row.format(*point) for point in P), ""])
    path = put(tmp_path, "a.csv", text.encode(encoding))
    with pytest.raises(FormatError) as caught:
        load(path)
    advised = re.search(r"--columns ('[^']+'|\S+) takes those wanted", str(caught.value))
    assert advised is not None, str(caught.value)
    assert np.array_equal(load(path, columns=shlex.split(advised[1])[0]), P)


def test_three_axes_are_advised(tmp_path: Path) -> None:
    path = put(tmp_path, "a.csv", b"Points:0,Points:1,Points:2\n0.5,0.25,0.125\n")
    with pytest.raises(FormatError, match="--columns Points:0,Points:1,Points:2 takes"):
        load(path)
    path = put(tmp_path, "b.csv", b"t,pos_x,pos_y,pos_z\n1,0.5,0.25,0.125\n")
    with pytest.raises(FormatError, match="--columns pos_x,pos_y,pos_z takes"):
        load(path)


REFUSED: list[tuple[str, str, str | None, int | None, str]] = [
    ("no names alike", "id,mass,charge\n1,2,3\n", None, 1, "takes those wanted; here are id, mass, charge"),
    ("names with commas", '"x, mm","y, mm",m\n1,2,3\n', None, 1, "rename 'x, mm', 'y, mm' without commas"),
    ("a name twice", "x,y,x\n0.5,0.25,0.75\n", "x,y", None, "column 'x' is there twice"),
    ("units below the names", "x,y\num,um\n0.5,0.25\n", None, 2, "no number in it, nor in line 1: keep"),
    ("more names", "id,x,y\nID,X,Y\n,(px),(px)\n0,0.5,0.25\n", "x,y", 2, "nor in line 1: keep the one"),
    ("a row of none", "x,y\nnan,nan\n0.5,0.25\n", None, 2, "'nan' is not a number: remove the point"),
    ("a missing number of R", "x,y\n0.5,NA\n", None, 2, "'NA' is not a number: remove the point"),
    ("Matlab's comment", "% x y\n0.5 0.25\n", None, 1, "begins with '%', and comments begin with '#' here"),
    ("C's comment", "// x y\n0.5 0.25\n", None, 1, "begins with '//', and comments begin with '#' here"),
    ("Lisp's comment", "; x y\n0.5 0.25\n", None, 1, "begins with ';', and comments begin with '#' here"),
    ("Fortran's comment", "! x y\n0.5 0.25\n", None, 1, "begins with '!', and comments begin with '#' here"),
    ("a comment behind numbers", "0.5 0.25 # a\n", None, 1, "a comment stands on a line of its own"),
    ("Fortran's exponent", "5.0D-01 2.5D-01\n", None, 1, "write its exponent with e, such as 1e-3"),
    ("Mathematica's exponent", "5.0*^-1,0.25\n", None, 1, "write its exponent with e, such as 1e-3"),
    ("Swiss thousands", "x;y\n1'234.5;7\n", None, 2, "write it without parted thousands"),
    ("a unit", "x,y\n0.5 um,0.25 um\n", None, 2, "'0.5 um' is not a number: write the number alone"),
    ("C's floats", "0.5f, 0.25f\n", None, 1, "'0.5f' is not a number: write the number alone"),
    ("brackets", "(0.5, 0.25)\n", None, 1, "'(0.5' is not a number: write the number alone"),
    ("French thousands", "x;y\n1\u202f234,5;7\n", None, 2, "write it without parted thousands"),
    ("tabs, a row too short", "a\tx\ty\n1\t0.5\t0.25\n2\t0.5\n", "x,y", 3, "2 columns where the lines bef"),
    ("tabs, an empty coordinate", "a\tx\ty\tb\n1\t\t0.25\t3\n", "x,y", 2, "an empty cell, in column 'x'"),
    ("tabs, a row struck out", "a\tx\n1 b\t0.5\n#2 c\t0.25\n", "x", 3, "a point behind a '#'"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "columns", "line", "said"), [r[1:] for r in REFUSED], ids=[r[0] for r in REFUSED]
)
def test_says_what_to_do(tmp_path: Path, text: str, columns: str | None, line: int | None, said: str) -> None:
    with pytest.raises(FormatError) as caught:
        load(put(tmp_path, "a.csv", text.encode()), columns=columns)
    assert said in str(caught.value)
    assert caught.value.line == line


@pytest.mark.parametrize("separator", [",", ";"])
def test_pandas_index_and_numbers_of_columns_are_left_out(tmp_path: Path, separator: str) -> None:
    text = ",0,1\n0,0.125,0.25\n1,0.5,0.75\n".replace(",", separator)
    assert np.array_equal(load(put(tmp_path, "a.csv", text.encode())), P)


@pytest.mark.parametrize("d", [2, 3, 4])
@pytest.mark.parametrize("separator", [",", " "])
def test_numbers_of_columns_are_no_point(tmp_path: Path, d: int, separator: str) -> None:
    """pandas writes them where columns have no names and the index is left out."""
    pixels = np.arange(2 * d).reshape(2, d) + 7
    rows = [separator.join(map(str, row)) + "\n" for row in (range(d), *pixels.tolist())]
    with pytest.raises(
        FormatError, match=r"line 1: '0 1.*' may number the columns, be .*: remove it, or write the p"
    ):
        load(put(tmp_path, "a.csv", "".join(rows).encode()), period=16)
    assert np.array_equal(load(put(tmp_path, "b.csv", "".join(rows[1:]).encode()), period=16), pixels / 16)
    told = "".join([separator.join(f"{k}.0" for k in range(d)) + "\n", *rows[1:]])
    found = load(put(tmp_path, "c.csv", told.encode()), period=16)
    assert np.array_equal(found, np.vstack([np.arange(d), pixels]) / 16)
