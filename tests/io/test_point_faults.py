"""Point-set files that are refused, each with its fault in one line and the number of the line."""

from __future__ import annotations

import os
import pickle
import struct
from pathlib import Path

import numpy as np
import pytest

from gbnbench.core.errors import FormatError
from gbnbench.io.points import load
from tests.io.point_bytes import PSA_EPS, A, npy, npz, put

BAD: list[tuple[str, str, bytes, int | None, str]] = [
    ("empty", "a.txt", b"", None, "empty"),
    ("only blanks", "a.txt", b"\n \n", None, "no points"),
    ("only comments", "a.dat", b"#\n# nothing\n", None, "no points"),
    ("only names", "a.csv", b"x,y\n", None, "no points"),
    (
        "fewer than counted",
        "a.txt",
        b"3\n0.5 0.25\n0.125 0.75\n",
        1,
        "says 3 points, and the file ends after 2",
    ),
    (
        "more than counted",
        "a.txt",
        b"1\n0.5 0.25\n0.125 0.75\n",
        3,
        "line 1 says 1 point, here is another",
    ),
    (
        "fewer in the first set",
        "a.txt",
        b"2\n0.5 0.25\n1\n0 0.875\n",
        3,
        "1 number where a point has 2; line 1",
    ),
    ("a count of none", "a.txt", b"0\n0.5 0.25\n", 1, "no set has this header: 0"),
    ("no dimension", "a.txt", b"5 0\n", 1, "no set has this header: 5 0"),
    ("a vast count", "a.txt", b"9" * 400 + b"\n0.5 0.25\n", 1, "99...' is too large for a number"),
    ("wrong dimension", "a.txt", b"2 3\n0.5 0.25\n0.5 0.25\n", 2, "2 numbers where a point has 3"),
    ("dimensions differ by set", "a.txt", b"1 2\n0.5 0.5\n1 3\n0 0 0\n", 3, "this set has 3 dimensions"),
    ("a word", "a.txt", b"0.5 0.25\n0.5 word\n", 2, "'word' is not a number"),
    ("nan", "a.txt", b"0.5 0.25\n\n#\n0.5 nan\n", 4, "'nan' is not a number"),
    ("inf", "a.dat", b"0.5 inf\n", 1, "'inf' is not a number"),
    ("python's underscore", "a.txt", b"0.5 0.2_5\n", 1, "'0.2_5' is not a number"),
    ("two points in one", "a.txt", b"0.5 0.2.5\n", 1, "'0.2.5' is not a number"),
    ("a stray sign", "a.txt", b"0.5 0.2-5\n0.5 0.25", 1, "'0.2-5' is not a number"),
    ("a bare exponent", "a.txt", b"0.5 1e\n", 1, "'1e' is not a number"),
    ("a decimal comma", "a.txt", b"0,5 0,25\n", 1, "'5 0' is not a number"),
    ("a long word", "a.txt", b"0.5 " + b"w" * 99, 1, "www...' is not a number"),
    ("a NUL", "a.txt", b"0.5 0.25\n" * 9 + b"0.5 0.2\0", 10, "is not a number"),
    ("above 1", "a.txt", b"0.5 0.25\n\n#\n0.5 1.25\n", 4, "coordinate 1.25 is not in [0, 1]"),
    ("below 0", "a.dat", b"0.5 -0.25\n", 1, "coordinate -0.25"),
    ("overflow", "a.txt", b"0.5 0.25\n0.5 1e999\n", 2, "'1e999' is too large for a number"),
    ("mixed dimensions", "a.txt", b"0.5 0.25\n0.5 0.25 0.125\n", 2, "3 numbers where a point has 2"),
    ("mixed over sets", "a.dat", b"0.5 0.25\n#\n0.5\n", 3, "1 number where a point has 2"),
    ("a blank line between", "a.txt", b"0.5 0.25\n\n0.125 0.75\n", 2, "blank line"),
    ("a struck-out point", "a.dat", b"0.5 0.25\n# 0.125 0.75\n0.5 0.5", 2, "behind a '#'"),
    ("0 may be a count", "a.txt", b"0\n", 1, "write the point as '0.0'"),
    ("0 may be a column's name", "a.csv", b"0\n0.5\n", 1, "write the point as '0.0'"),
    ("1 may be a count", "a.txt", b"1\n0.5\n", 1, "write the point as '1.0'"),
    ("0 1 may be names", "a.csv", b"0,1\n0.5,0.25\n", 1, "write the point as '0.0 1.0'"),
    ("1 1 may be a header", "a.txt", b"1 1\n0.5 0.25\n", 1, "write the point as '1.0 1.0'"),
    ("a later count of 1 in 1D", "a.txt", b"2\n0.5\n0.25\n1\n0.5\n", 4, "write the header as '1 1'"),
    ("an empty cell", "a.csv", b"0.5,0.25\n0.5,\n", 2, "empty cell"),
    ("too few cells for the names", "a.csv", b"x,y\n0.5\n", 2, "the header names 2"),
    ("a column that is no coordinate", "a.csv", b"x,y,weight\n0.5,0.25,0.1\n", 1, "column 'weight'"),
    ("w without z", "a.csv", b"x,y,w\n0.5,0.25,0.1\n", 1, "column 'w' is no coordinate"),
    ("y without x", "a.csv", b"y,z\n0.5,0.25\n", 1, "columns y, z are no coordinate"),
    ("a gap in the numbers", "a.csv", b"x0,x2\n0.5,0.25\n", 1, "columns x0, x2 are no coordinate"),
    ("two letters", "a.csv", b"x0,y1\n0.5,0.25\n", 1, "columns x0, y1 are no coordinate"),
    ("coordinates out of order", "a.csv", b"x1,x0\n0.5,0.25\n", 1, "put the columns as x0, x1"),
    ("u and v", "a.txt", b"u v\n0.5 0.25\n", 1, "column 'u' is no coordinate"),
    ("an index that does not count", "a.csv", b",x,y\n7,0.5,0.25\n9,0.1,0.2\n", 2, "'7' where 1 would stand"),
    ("an index that stops counting", "a.csv", b",x,y\n0,0.5,0.25\n2,0.1,0.2\n", 3, "'2' where 1 would stand"),
    ("an index without names", "a.csv", b"0,0.5,0.2\n1,0.1,0.2\n2,0.3,0.4\n", 1, "the first column numbers"),
    ("commas at the ends", "a.csv", b"0.5,0.25,\n0.1,0.2,\n", 1, "after the last comma: remove it"),
    ("thousands or decimals", "a.csv", b"x;y\n1,234;5,678\n", 2, "'1,234' may have a decimal comma or"),
    ("blanks and decimal commas", "a.txt", b"0,5 0,25\n", 1, "where semicolons or tabs part cells"),
    (
        "quoted decimal commas",
        "a.csv",
        b'"0,5","0,25"\n',
        1,
        "'0,5' is not a number; decimal commas are read",
    ),
    ("a lone quote", "a.csv", b'"0.5,0.25\n', 1, "is not a number"),
    ("blanks within quotes", "a.txt", b'" 0.5 " 0.25\n', 1, "is not a number"),
    ("hexadecimal", "a.txt", b"0.5 0x1p-1\n", 1, "'0x1p-1' is not a number"),
    ("thousands", "a.csv", b'x,y\n"1,024",0.5\n', 2, "is not a number"),
    ("a huge integer", "a.txt", b"0.5 0.5\n" + b"9" * 400 + b" 0.5\n", 2, "99...' is too large for a number"),
    ("latin-1 names", "a.csv", b"L\xe4nge,y\n0.5,0.25\n", 1, "is no coordinate"),
    ("transposed", "a.csv", b",".join([b"0.5"] * 20) + b"\n" + b",".join([b"0.2"] * 20), None, "transposed?"),
    ("UTF-16 without its mark", "a.txt", "0.5 0.25\n".encode("utf-16-le"), None, "looks like UTF-16"),
    ("a name twice", "a.csv", b"\nx,x\n0.5,0.25\n", 2, "once each"),
    ("sets out of order", "a.csv", b"set,x\n0,0.5\n2,0.25\n", 3, "set number 2"),
    ("sets not from 0 or 1", "a.csv", b"set,x\n3,0.5\n", 2, "set number 3"),
    (
        "sets beyond all numbers",
        "a.csv",
        b"set,x\n1e999,0.5\n1e999,0.5\n",
        2,
        "'1e999' is too large for a number",
    ),
    ("no coordinates but sets", "a.csv", b"set\n0\n", None, "at least one coordinate"),
    ("UTF-16", "a.txt", "0.5 0.25\n".encode("utf-16"), None, "UTF-16"),
    ("gzip", "a.txt.gz", b"\x1f\x8b\x08\0\0\0", None, "compression is damaged"),
    ("binary junk", "a.txt", bytes(range(256)) * 4, None, "binary"),
    ("short binary junk", "a.dat", bytes(range(16)), None, "binary"),
    ("rps truncated", "a.rps", struct.pack("<3f", 0.5, 0.25, 0.125), None, "truncated"),
    ("rps of zeros", "a.rps", bytes(64), None, "all bytes are zero"),
    ("rps with nan", "a.rps", struct.pack("<2f", 0.5, np.nan), None, "coordinate nan"),
    ("rps with signalling nan", "a.rps", b"\1\0\x80\x7f" * 2, None, "coordinate nan"),
    ("rps outside", "a.rps", struct.pack("<4f", 0.5, 0.25, 0.125, 7.0), None, "7.0 is not in [0, 1]; scale"),
    ("eps truncated", "a.eps", PSA_EPS.removesuffix(b"grestore\n"), 8, "truncated"),
    ("eps with a word", "a.eps", PSA_EPS.replace(b"0.549315 p", b"word p"), 7, "'word' is not a number"),
    ("eps outside", "a.eps", PSA_EPS.replace(b"0.549315 p", b"5 p"), 7, "coordinate 5.0"),
    ("eps with a damaged point", "a.eps", PSA_EPS.replace(b"0.549315 p", b"0.549315"), 7, "no line of a PSA"),
    ("eps with a point struck out", "a.eps", PSA_EPS.replace(b"4.62", b"%.62"), 8, "is not a number"),
    ("another eps", "a.eps", b"%!PS-Adobe-3.0 EPSF-3.0\n", None, "no lines 'x y p'"),
    ("npy truncated", "a.npy", npy(A)[:-1], None, "truncated"),
    ("npy with a tail", "a.npy", npy(A) + b"\0", None, "33 are there"),
    ("npy header cut", "a.npy", npy(A)[:40], None, "damaged .npy header"),
    ("npy of arrays of one float", "a.npy", npy(A).replace(b"<f8", b"1f8"), None, "damaged .npy header"),
    ("npy of ints", "a.npy", npy(np.zeros((2, 2), int)), None, "floats; got type int64"),
    ("npy of complex", "a.npy", npy(np.zeros((2, 2), complex)), None, "floats"),
    ("npy of one axis", "a.npy", npy(np.zeros(5)), None, "got (5,)"),
    ("npy of nothing", "a.npy", npy(np.zeros((0, 2))), None, "holds no points: its shape is (0, 2)"),
    ("npy with nan", "a.npy", npy([[0.5, np.nan]]), None, "coordinate nan"),
    ("npy in another version", "a.npy", b"\x93NUMPY\x09\x00" + npy(A)[8:], None, "version (9, 0)"),
    ("junk called npy", "a.npy", bytes(range(64)), None, "is not a .npy file"),
    ("npz truncated", "a.npz", npz(points=np.array(A))[:-30], None, "damaged .npz"),
    ("npz of nothing", "a.npz", npz(), None, "no arrays"),
    ("npz of other arrays", "a.npz", npz(pos=np.array(A), v=np.eye(3)), None, "arrays pos, v: say which"),
    ("npz of unlike sets", "a.npz", npz(set_0=np.array(A), set_1=np.eye(3)), None, "different dimensions"),
    ("npz with a stack among sets", "a.npz", npz(set_0=np.array(A), set_1=np.array([A])), None, "(1, 2, 2)"),
    (
        "floats without a name",
        "a.bin",
        struct.pack("<4f", 0.5, 0.25, 0.125, 0.75) * 8,
        None,
        "--raw float32,3",
    ),
]


@pytest.mark.parametrize(("name", "data", "line", "said"), [b[1:] for b in BAD], ids=[b[0] for b in BAD])
def test_refuses(tmp_path: Path, name: str, data: bytes, line: int | None, said: str) -> None:
    path = put(tmp_path, name, data)
    with pytest.raises(FormatError) as caught:
        load(path)
    assert (caught.value.path, caught.value.line) == (path, line)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def test_never_unpickles(tmp_path: Path) -> None:
    class Trap:
        def __reduce__(self) -> tuple[object, ...]:
            return Path.touch, (tmp_path / "sprung",)

    boxed = np.array([[Trap(), 0.5]], dtype=object)
    for name, data in (
        ("a.npy", npy(boxed, allow_pickle=True)),
        ("a.npz", npz(points=boxed)),
        ("a", pickle.dumps(0)),
    ):
        with pytest.raises(FormatError):
            load(put(tmp_path, name, data))
    assert not (tmp_path / "sprung").exists()


def test_not_a_file(tmp_path: Path) -> None:
    with pytest.raises(FormatError, match="is a folder"):
        load(tmp_path)
    with pytest.raises(FormatError, match="no such file"):
        load(tmp_path / "absent.txt")
    with pytest.raises(FormatError, match="null byte"):
        load(f"{tmp_path}/a\0b")
    os.mkfifo(tmp_path / "pipe.txt")
    with pytest.raises(FormatError, match="not a regular file"):
        load(tmp_path / "pipe.txt")
    closed = put(tmp_path, "closed.txt", b"0.5 0.5\n")
    closed.chmod(0)
    if not os.access(closed, os.R_OK):
        with pytest.raises(FormatError, match="permission denied"):
            load(closed)
