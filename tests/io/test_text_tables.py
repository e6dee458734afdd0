"""Tables in text: names stand over the right cells, comments part nothing, and doubts are refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from gbnbench.core.errors import FormatError
from gbnbench.io.points import load, read_sets, reading_options
from tests.io.point_bytes import put

P = [[0.1, 0.2], [0.3, 0.4]]

READ: list[tuple[str, str, str | None]] = [
    ("commas at the ends", "x,y\n0.1,0.2,\n0.3,0.4,\n", "x,y"),
    ("commas at the ends, all columns", "x,y\n0.1,0.2,\n0.3,0.4,\n", None),
    ("commas at the ends of the names too", "x,y,\n0.1,0.2,\n0.3,0.4,\n", None),
    ("commas at the ends, a column left out", "x,y,w\n0.1,0.2,0.5,\n0.3,0.4,0.6,\n", "x,y"),
    ("semicolons at the ends", "x;y\n0,1;0,2;\n0,3;0,4;\n", "x,y"),
    ("row numbers and commas at the ends", ",x,y,\n0,0.1,0.2,\n1,0.3,0.4,\n", None),
    ("row numbers without a name", "x,y\n1,0.1,0.2\n2,0.3,0.4\n", "x,y"),
    ("quoted names of rows", 'x,y\n"a",0.1,0.2\n"b",0.3,0.4\n', "x,y"),
    ("a column in front that the header leaves empty", ",x,y\n7,0.1,0.2\n9,0.3,0.4\n", "x,y"),
    ("names of numpy.savetxt", "# x y weight\n0.1 0.2 0.9\n0.3 0.4 0.8\n", "x,y"),
    ("names of numpy.savetxt, by number", "# x y weight\n0.1 0.2 0.9\n0.3 0.4 0.8\n", "1,2"),
    ("names of numpy.savetxt with commas", "# made today\n# x, y\n0.1,0.2\n0.3,0.4\n", None),
    ("a comment of other words", "# made by hand\n0.1 0.2\n0.3 0.4\n", None),
    ("a comment above a count", "# n d\n2 2\n0.1 0.2\n0.3 0.4\n", None),
    ("comments between the rows of a table", "x,y\n0.1,0.2\n# half\n0.3,0.4\n", None),
    ("comments between rows of chosen columns", "x,y,c\n0.1,0.2,red\n# half\n0.3,0.4,blue\n", "x,y"),
    ("Excel's sep=", "sep=;\nx;y\n0,1;0,2\n0,3;0,4\n", None),
    ("Excel's sep= of commas", "sep=,\r\nx,y\r\n0.1,0.2\r\n0.3,0.4\r\n", None),
    ("quoted decimal commas between semicolons", '"x";"y"\n"0,1";"0,2"\n"0,3";"0,4"\n', None),
    ("two byte-order marks", "\ufeff\ufeffx,y\n0.1,0.2\n0.3,0.4\n", None),
]  # fmt: skip


@pytest.mark.parametrize(("text", "columns"), [r[1:] for r in READ], ids=[r[0] for r in READ])
def test_reads(tmp_path: Path, text: str, columns: str | None) -> None:
    found = read_sets(put(tmp_path, "a.csv", text.encode()), reading_options(columns))
    assert [x.tolist() for x in found.sets] == [P]


REFUSED: list[tuple[str, str, str | None, int, str]] = [
    ("a surplus cell", "x,y\n0.1,0.2,0.5\n0.3,0.4,0.6\n", "x,y", 2, "3 cells where line 1 has 2 names"),
    ("a surplus cell, all columns", "x,y\n0.1,0.2,0.5\n0.3,0.4,0.6\n", None, 2, "name every column (one"),
    ("two surplus cells", "x,y\n1,0.1,0.2,\n2,0.3,0.4,\n", "x,y", 2, "4 cells where line 1 has 2 names"),
    ("a quoted coordinate in front", 'x,y\n"0.1",0.2,0.5\n', "x,y", 2, "3 cells where line 1 has 2 names"),
    ("row numbers that stop", "x,y\n1,0.1,0.2\n3,0.3,0.4\n", "x,y", 3, "would stand; name every column"),
    ("an end that is not empty", "x,y\n0.1,0.2,\n0.3,0.4,0.6\n", "x,y", 3, "3 cells where there are 2 names"),
    ("an end that is missing", "x,y\n0.1,0.2,\n0.3,0.4\n", "x,y", 3, "2 columns where the lines before"),
    ("row numbers or a column", "x,y\n0,1,\n1,5,\n2,3,\n", "x,y", 2, "which of the two has no name?"),
    ("an empty last cell", "x,y\n0.1,0.2\n0.3,\n", None, 3, "an empty cell, in column 'y'"),
    ("an empty end of a later row", "x,y\n0.1,0.2\n0.3,0.4,\n", None, 3, "after the last comma: remove it"),
    ("a row struck out", "x,y,c\n0.1,0.2,1\n#0.3,0.4,1\n0.5,0.6,1", "x,y", 3, "a point behind a '#'"),
    ("a row with a word struck out", "x,y,c\n0.1,0.2,a\n#0.3,0.4,b\n", "x,y", 3, "a point behind a '#'"),
    ("a quoted row struck out", 'x,y\n"0.1","0.2"\n#"0.3","0.4"\n', None, 3, "a point behind a '#'"),
    ("a row of whole numbers struck out", "x,y\n1,0\n#0,1\n1,1\n", None, 3, "a point behind a '#'"),
    ("a weight named by a comment", "# x y weight\n0.1 0.2 0.9\n", None, 1, "'weight' is no coordinate"),
    ("a line # in a table", "x,y\n0.1,0.2\n#\n0.3,0.4\n", None, 3, "parts no sets: remove it"),
    ("a blank line in a table", "x,y\n0.1,0.2\n\n0.3,0.4\n", None, 3, "part sets by a column 'set'"),
    ("commas twice in a number", "x;y\n1.234,5;0,2\n0,1;0,2\n", None, 2, "'1.234,5' is not a number"),
    ("the same in a chosen column", "a;x\n1;1.234,5\n2;0,2\n", "x", 2, "'1.234,5' is not a number, in"),
    ("a name with a comma", "Länge, mm;y\n0,1;0,2\n", None, 1, "column 'Länge, mm' is no coordinate"),
    ("a column not there, by a name with a comma", "a, b;x\n0,1;0,2\n", "c", -1, "its columns are a, b, x"),
    ("names for the shell", "X [mm],Y [mm]\n0.1,0.2\n", None, 1, "--columns 'X [mm],Y [mm]' takes"),
    ("a quoted decimal comma", '"0,1","0,2"\n', None, 1, "'0,1' is not a number; decimal commas"),
    ("a quoted decimal comma under names", 'x,y\n"0,1","0,2"\n', None, 2, "'0,1' is not a number; decimal"),
    ("the same in a chosen column", 'x,y\n"0,1","0,2"\n', "x,y", 2, "'0,1' is not a number; decimal"),
    ("too large", "x;y\n1e999;0,5\n", None, 2, "'1e999' is too large for a number"),
    ("an unknown separator", "sep=|\nx|y\n0.1|0.2\n", None, 1, "'sep=|': cells are parted by ; or , or"),
    ("thousands under a name with a comma", "x, m;y\n1,234;5,678\n", None, 2, "'1,234' may have a decimal"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "columns", "line", "said"), [r[1:] for r in REFUSED], ids=[r[0] for r in REFUSED]
)
def test_refuses(tmp_path: Path, text: str, columns: str | None, line: int, said: str) -> None:
    path = put(tmp_path, "a.csv", text.encode())
    with pytest.raises(FormatError) as caught:
        load(path, columns=columns)
    assert said in str(caught.value)
    assert caught.value.line == (None if line < 0 else line)
    assert "\n" not in str(caught.value)


def test_headers_in_comments_leave_sets_parted(tmp_path: Path) -> None:
    """Two tables of numpy.savetxt, one after the other."""
    path = put(tmp_path, "a.dat", b"# x y\n0.1 0.2\n# x y\n0.3 0.4\n")
    assert [x.tolist() for x in read_sets(path).sets] == [[row] for row in P]


def test_one_point_of_whole_numbers(tmp_path: Path) -> None:
    path = put(tmp_path, "a.txt", b"5 6\n")
    assert np.array_equal(load(path, period=10), [[0.5, 0.6]])
    with pytest.raises(FormatError, match=r"says 5 points, .* after 0; as a point, write it as '5\.0 6\.0'"):
        load(path)
    with pytest.raises(FormatError, match="says 3 points, and the file ends after 0"):
        load(put(tmp_path, "b.txt", b"3\n"))


def test_a_row_of_pixels_struck_out(tmp_path: Path) -> None:
    path = put(tmp_path, "a.txt", b"115 376\n#130 272\n200 300\n")
    with pytest.raises(FormatError, match="line 2: a point behind a '#'"):
        load(path, period=512)


@pytest.mark.parametrize("comment", ["# random points", "# two columns", "# made by", "#"])
def test_a_comment_without_an_axis_is_no_line_of_names(tmp_path: Path, comment: str) -> None:
    path = tmp_path / "x.txt"
    path.write_text(f"{comment}\n0.1 0.2\n0.3 0.4\n")
    assert read_sets(path).sets[0].tolist() == [[0.1, 0.2], [0.3, 0.4]]
