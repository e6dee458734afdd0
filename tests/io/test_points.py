"""Point-set files: each format read, big files and bombs refused unread, long files lexed in blocks."""

from __future__ import annotations

import io
import struct
import zipfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gbnbench.core.errors import FormatError, InputError
from gbnbench.io.points import load, read
from gbnbench.io.points.number_parser import BLOCK, _fast, _slow
from tests.io.point_bytes import PSA_EPS, A, B, npy, npz, put
from tests.published_sets import published_files

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
