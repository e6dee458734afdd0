"""Point-set files: each format read and written, each fault named with its line, big files refused unread."""

from __future__ import annotations

import io
import os
import pickle
import struct
import zipfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gbnbench.core.errors import FormatError, InputError
from gbnbench.io.points import load, read, save
from gbnbench.io.points.number_parser import BLOCK, _fast, _slow
from tests.published_sets import published_files

WRITTEN = [".txt", ".dat", ".csv", ".npy", ".npz"]
PSA_EPS = (
    b"%!PS-Adobe-3.1 EPSF-3.0\n%%BoundingBox: -3 -3 515 515\n/radius { 0.00585938 } def\n"
    b"/p { radius 0 360 arc closepath fill stroke } def\ngsave 512 512 scale\n0 setgray\n"
    b"0.600459 0.549315 p\n4.62451e-06 1 p\ngrestore\n"
)


def put(folder: Path, name: str, data: bytes) -> Path:
    path = folder / name
    path.write_bytes(data)
    return path


def npy(x: object, **kwargs: bool) -> bytes:
    file = io.BytesIO()
    np.save(file, x, **kwargs)  # type: ignore[arg-type]
    return file.getvalue()


def npz(**arrays: object) -> bytes:
    file = io.BytesIO()
    np.savez_compressed(file, **arrays)  # type: ignore[arg-type]
    return file.getvalue()


A, B = [[0.5, 0.25], [0.125, 0.75]], [[0.0, 0.875]]

GOOD: list[tuple[str, str, bytes, list[list[list[float]]]]] = [
    ("PSA", "a.txt", b"2\n0.5 0.25\n0.125 0.75\n", [A]),
    ("PSA, several", "a.txt", b"2\n0.5 0.25\n0.125 0.75\n1\n0 0.875\n", [A, B]),
    ("authors'", "a.txt", b"1 3\n0.5 0.25 1\n", [[[0.5, 0.25, 0.0]]]),
    ("authors', several", "a.txt", b"2 2\n0.5 0.25\n0.125 0.75\n1 2\n0 0.875\n", [A, B]),
    ("a count, d from the rows", "a.txt", b"1\n0.5 0.25 0.125\n", [[[0.5, 0.25, 0.125]]]),
    ("a count of 1D points", "a.txt", b"3\n0.5\n1\n0\n", [[[0.5], [0.0], [0.0]]]),
    ("one 1D point", "a.txt", b"1 1\n0.5\n", [[[0.5]]]),
    ("rows", "a.txt", b"0.5 0.25\n0.125 0.75", [A]),
    ("rows of one", "a.txt", b".5\n+0.25\n2.5e-1\n", [[[0.5], [0.25], [0.25]]]),
    ("a first row of zeros", "a.txt", b"0 0\n0.5 0.5\n", [[[0.0, 0.0], [0.5, 0.5]]]),
    ("any blanks, blank ends", "a.txt", b"\n\n  0.5\t0.25  \n0.125   0.75\n \n\n", [A]),
    ("comments in a counted file", "a.txt", b"# by hand\n2\n0.5 0.25\n# half\n\n0.125 0.75\n", [A]),
    ("Windows", "a.txt", b"\xef\xbb\xbf2\r\n0.5 0.25\r\n0.125 0.75\r\n", [A]),
    ("old Mac", "a.txt", b"0.5 0.25\r0.125 0.75\r", [A]),
    ("UTK", "a.dat", b"0.5\t0.25\n0.125\t0.75\n#\n0\t0.875\n", [A, B]),
    ("UTK, # around", "a.dat", b"#\n#\n0.5 0.25\n0.125 0.75\n#\n\n#\n0 0.875\n#\n", [A, B]),
    ("csv", "a.csv", b"0.5,0.25\n0.125,0.75\n", [A]),
    ("csv with names", "a.csv", b'"x", "y"\n0.5, 0.25\n0.125, 0.75\n', [A]),
    ("names parted by blanks", "a.txt", b"x y\n0.5 0.25\n0.125 0.75\n", [A]),
    ("names parted by tabs", "a.tsv", b"X\tY\n0.5\t0.25\n0.125\t0.75\n", [A]),
    ("semicolons", "a.csv", b"0.5;0.25\n0.125;0.75\n", [A]),
    ("semicolons and decimal commas", "a.csv", b"x;y\r\n0,5;,25\r\n0,125;7,5e-1\r\n", [A]),
    ("tabs and decimal commas", "a.txt", b"0,5\t0,25\n0,125\t0,75\n", [A]),
    ("tabs, decimal commas and names", "a.txt", b"x\ty\n0,5\t0,25\n0,125\t0,75\n", [A]),
    ("every cell quoted", "a.csv", b'"x","y"\n"0.5","0.25"\n"0.125", "0.75"\n', [A]),
    ("quotes and blanks", "a.txt", b'"0.5" "0.25"\n"0.125" "0.75"\n', [A]),
    ("pandas' index", "a.csv", b",x,y\n0,0.5,0.25\n1,0.125,0.75\n", [A]),
    ("pandas' index and sets", "a.csv", b",set,x,y\n0,0,0.5,0.25\n1,0,0.125,0.75\n2,1,0,0.875\n", [A, B]),
    ("R's write.csv", "a.csv", b'"","x","y"\n"1",0.5,0.25\n"2",0.125,0.75\n', [A]),
    ("R's write.csv2", "a.csv", b'"";"x";"y"\n"1";0,5;0,25\n"2";0,125;0,75\n', [A]),
    ("R's write.table", "a.txt", b'"x" "y"\n"1" 0.5 0.25\n"2" 0.125 0.75\n', [A]),
    ("R's row names", "a.txt", b'"x" "y"\n"first one" 0.5 0.25\n"b" 0.125 0.75\n', [A]),
    ("R without quotes", "a.txt", b"x y\n1 0.5 0.25\n2 0.125 0.75\n", [A]),
    ("x1 and x2", "a.csv", b"x1,x2\n0.5,0.25\n0.125,0.75\n", [A]),
    ("p[0] and p[1]", "a.csv", b"p[0],p[1]\n0.5,0.25\n0.125,0.75\n", [A]),
    ("csv of one column", "a.csv", b"x0\n0.5\n1\n", [[[0.5], [0.0]]]),
    ("csv with sets", "a.csv", b"set,x0,x1\n0,0.5,0.25\n0,0.125,0.75\n1,0,0.875\n", [A, B]),
    ("csv with sets at the end", "a.csv", b"x,y,Set\n0.5,0.25,1\n0.125,0.75,1\n0,0.875,2\n", [A, B]),
    ("csv without its name", "points", b"x,y\n0.5,0.25\n0.125,0.75\n", [A]),
    ("text called .npy", "a.npy", b"0.5 0.25\n0.125 0.75\n", [A]),
    ("text called .rps", "a.rps", b"0.5 0.25\n0.125 0.75\n", [A]),
    ("rps", "a.rps", struct.pack("<4f", 0.5, 0.25, 0.125, 0.75), [A]),
    ("rps holding 1", "a.RPS", struct.pack("<2f", 1.0, 0.875), [B]),
    ("eps", "a.eps", PSA_EPS, [[[0.600459, 0.549315], [4.62451e-06, 0.0]]]),
    ("eps without its name", "a.txt", PSA_EPS, [[[0.600459, 0.549315], [4.62451e-06, 0.0]]]),
    ("eps, points alone", "a.eps", b"0.5 0.25 p\n0.125 0.75 p\n", [A]),
    ("npy", "a.npy", npy(A), [A]),
    ("npy of several", "a.dat", npy([A, A]), [A, A]),
    ("npy in Fortran's order", "a.npy", npy(np.asfortranarray(A)), [A]),
    ("npy of float32 big-endian", "a.npy", npy(np.array(A, ">f4")), [A]),
    ("npy of float32 holding 1", "a.npy", npy(np.array([[1, 0.875]], "f4")), [B]),
    ("npz, points", "a.npz", npz(points=np.array(A), weight=np.ones(5)), [A]),
    ("npz, x", "a.npz", npz(x=np.array([A, A])), [A, A]),
    ("npz, only one", "a.zip", npz(anything=np.array(A)), [A]),
    ("npz, several", "a.npz", npz(set_1=np.array(B), set_0=np.array(A)), [A, B]),
]


@pytest.mark.parametrize(("name", "data", "sets"), [g[1:] for g in GOOD], ids=[g[0] for g in GOOD])
def test_reads(tmp_path: Path, name: str, data: bytes, sets: list[list[list[float]]]) -> None:
    found = read(put(tmp_path, name, data))
    assert [x.tolist() for x in found] == sets
    assert all(x.dtype == np.float64 and x.flags.c_contiguous for x in found)


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
    ("a vast count", "a.txt", b"9" * 400 + b"\n0.5 0.25\n", 1, "no set has this header: inf"),
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
    ("overflow", "a.txt", b"0.5 0.25\n0.5 1e999\n", 2, "coordinate inf"),
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
    ("quoted decimal commas", "a.csv", b'"0,5","0,25"\n', 1, "is not a number"),
    ("a lone quote", "a.csv", b'"0.5,0.25\n', 1, "is not a number"),
    ("blanks within quotes", "a.txt", b'" 0.5 " 0.25\n', 1, "is not a number"),
    ("hexadecimal", "a.txt", b"0.5 0x1p-1\n", 1, "'0x1p-1' is not a number"),
    ("thousands", "a.csv", b'x,y\n"1,024",0.5\n', 2, "is not a number"),
    ("a huge integer", "a.txt", b"0.5 0.5\n" + b"9" * 400 + b" 0.5\n", 2, "coordinate inf is not finite"),
    ("latin-1 names", "a.csv", b"L\xe4nge,y\n0.5,0.25\n", 1, "is no coordinate"),
    ("transposed", "a.csv", b",".join([b"0.5"] * 20) + b"\n" + b",".join([b"0.2"] * 20), None, "transposed?"),
    ("UTF-16 without its mark", "a.txt", "0.5 0.25\n".encode("utf-16-le"), None, "looks like UTF-16"),
    ("a name twice", "a.csv", b"\nx,x\n0.5,0.25\n", 2, "once each"),
    ("sets out of order", "a.csv", b"set,x\n0,0.5\n2,0.25\n", 3, "set number 2"),
    ("sets not from 0 or 1", "a.csv", b"set,x\n3,0.5\n", 2, "set number 3"),
    ("sets beyond all numbers", "a.csv", b"set,x\n1e999,0.5\n1e999,0.5\n", 2, "set number inf"),
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
    ("npy of ints", "a.npy", npy(np.zeros((2, 2), int)), None, "floats; got type int64"),
    ("npy of complex", "a.npy", npy(np.zeros((2, 2), complex)), None, "floats"),
    ("npy of one axis", "a.npy", npy(np.zeros(5)), None, "got (5,)"),
    ("npy of nothing", "a.npy", npy(np.zeros((0, 2))), None, "got (0, 2)"),
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


def test_too_large_is_refused_unread(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sparse = tmp_path / "sparse.txt"
    with sparse.open("wb") as file:
        file.truncate(2_000_000_000)
    with pytest.raises(
        FormatError, match=r"holds 2 GB, and 2 GB or more are refused.*GBNBENCH_MAX_FILE_BYTES"
    ):
        load(sparse)
    small = put(tmp_path, "small.txt", b"0.5 0.25\n")
    with pytest.raises(FormatError, match="holds 9 bytes"):
        load(small, max_bytes=9)
    monkeypatch.setenv("GBNBENCH_MAX_FILE_BYTES", "9")
    with pytest.raises(FormatError, match="holds 9 bytes"):
        load(small)
    monkeypatch.setenv("GBNBENCH_MAX_FILE_BYTES", "10")
    assert load(small).shape == (1, 2)  # type: ignore[union-attr]
    monkeypatch.setenv("GBNBENCH_MAX_FILE_BYTES", "2 GB")
    with pytest.raises(InputError, match="GBNBENCH_MAX_FILE_BYTES must be"):
        load(small)


def test_zip_bomb_is_refused_unpacked(tmp_path: Path) -> None:
    bomb = put(tmp_path, "bomb.npz", npz(points=np.zeros((100_000, 2))))
    assert bomb.stat().st_size < 10_000
    with pytest.raises(FormatError, match=r"unpacked, the arrays hold 1\.6 MB"):
        load(bomb, max_bytes=1_000_000)
    assert np.shape(load(bomb)) == (100_000, 2)


def test_archive_whose_directory_loses_a_set(tmp_path: Path) -> None:
    """A directory entry whose comment swallows the next entry: zipfile alone would give one set of two."""
    data = bytearray(npz(a=np.array(A), b=np.array(B)))
    first, second = (m for m in range(len(data)) if data[m : m + 4] == b"PK\x01\x02")
    end = data.index(b"PK\x05\x06")
    data[first + 32 : first + 34] = struct.pack("<H", end - second)
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        assert archive.namelist() == ["a.npy"]
    with pytest.raises(FormatError, match="fewer arrays than it counts"):
        load(put(tmp_path, "a.npz", bytes(data)))


def test_archive_that_is_no_npz(tmp_path: Path) -> None:
    path = tmp_path / "a.npz"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("readme.txt", "hello")
    with pytest.raises(FormatError, match=r"not an .npz of arrays: it holds 'readme\.txt'"):
        load(path)


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


def test_faults_beyond_the_first_block(tmp_path: Path) -> None:
    """Line numbers and sets hold where a text is lexed in several blocks."""
    rows = BLOCK // 8 + 1000
    text = b"0.5 0.25\n" * rows
    sets = read(put(tmp_path, "a.dat", text + b"#\n" + text))
    assert [x.shape for x in sets] == [(rows, 2), (rows, 2)]
    assert all((x == [0.5, 0.25]).all() for x in sets)
    with pytest.raises(FormatError, match=f"line {rows + 2}: 'half' is not"):
        load(put(tmp_path, "a.txt", b"%d\r\n" % (rows + 1) + text.replace(b"\n", b"\r\n") + b"half 0.5"))


@settings(max_examples=300, derandomize=True, deadline=None, database=None)
@given(
    st.lists(st.sampled_from([*"0159.,-+e \t\n", "0.25", "1e-3", "0.5, 0.5\n", "12 2\n"]), max_size=12).map(
        "".join
    )
)
def test_the_fast_lexer_is_the_slow_one(text: str) -> None:
    """What the fast reading takes, the slow takes too, alike; what it leaves, the slow refuses."""
    block = text.encode()
    fast = _fast(block, 3)
    if fast is None:
        with pytest.raises(FormatError):
            _slow(Path("a.txt"), block, 3)
        return
    for ours, slow in zip(fast, _slow(Path("a.txt"), block, 3), strict=True):
        assert ours.dtype == slow.dtype
        assert ours.tolist() == slow.tolist()


def test_sets_made_by_other_programs() -> None:
    for path in published_files("*/*.txt"):
        counted = len(path.read_text().splitlines()) == 1025
        x = load(path)
        assert np.shape(x) == (1024, 3 if "3d" in path.parent.name else 2)
        assert np.array_equal(x, np.loadtxt(path, skiprows=int(counted)) % 1)
