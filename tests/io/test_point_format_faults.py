"""Files of other formats that are refused, each with its fault in one line and the number of the line."""

from __future__ import annotations

import gzip
import io
import pickle
import zipfile
from pathlib import Path

import numpy as np
import pytest

from gbnbench.core.errors import FormatError
from gbnbench.io.points import load
from tests.io.format_files import CELL, DUMP, EDAT, FIELDS, ply
from tests.io.point_bytes import npy, put


def office() -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("[Content_Types].xml", "<Types/>")
    return file.getvalue()


OBJECTS = npy(np.array([[0.5, "a"]], dtype=object), allow_pickle=True)
BAD: list[tuple[str, str, bytes | str, int | None, str]] = [
    ("a pickle", "a.pkl", pickle.dumps([0.5]), None, "refused as unsafe; save the points by numpy.save"),
    ("a pickle of text", "a.pickle", pickle.dumps([0.5], 0), None, "refused as unsafe"),
    ("a pickle called .npy", "a.npy", pickle.dumps([0.5]), None, "refused as unsafe"),
    ("objects", "a.npy", OBJECTS, None, "an array of Python objects is a pickle"),
    ("a structured array", "a.npy", FIELDS, None, "fields x, mass: say which are coordinates"),
    (
        "a PNG image",
        "a.png",
        b"\x89PNG\r\n\x1a\n" + bytes(9),
        None,
        "is a PNG image, not points: find its dots",
    ),
    ("a JPEG image", "a.jpg", b"\xff\xd8\xff\xe0" + bytes(9), None, "is a JPEG image"),
    ("HDF5", "a.h5", b"\x89HDF\r\n\x1a\n" + bytes(9), None, "is an HDF5 file"),
    (
        "a workbook",
        "a.xlsx",
        office(),
        None,
        "an Office document, not points: save its sheet as .csv",
    ),
    ("tar", "a.tar", bytes(257) + b"ustar" + bytes(250), None, "is a tar archive: unpack it first"),
    ("zstd", "a.zst", b"\x28\xb5\x2f\xfd" + bytes(9), None, "is compressed by zstd"),
    ("gzip, cut", "a.txt.gz", gzip.compress(b"0.5 0.25\n" * 99)[:-9], None, "its compression is damaged"),
    ("gzip, a wrong line", "a.txt.gz", gzip.compress(b"0.5 0.25\n0.5 x\n"), 2, "'x' is not a number"),
    ("PLY, cut", "a.ply", ply("binary_little_endian", bytes(23)), None, "2 vertices need 24 bytes"),
    (
        "PLY, long",
        "a.ply",
        ply("binary_little_endian", bytes(25)),
        None,
        "25 are there: truncated or damaged",
    ),
    (
        "PLY, short text",
        "a.ply",
        ply("ascii", b"0.5 0.25 0.125\n"),
        None,
        "says 2 vertices, and the file ends",
    ),
    (
        "PLY, long text",
        "a.ply",
        ply("ascii", b"0.5 0.25 0.1\n" * 3),
        11,
        "says 2 vertices, and here is another",
    ),
    ("PLY, a word", "a.ply", ply("ascii", b"0.5 0.25 0.1\n0.5 x 0.1\n"), 10, "'x' is not a number"),
    ("PLY, few numbers", "a.ply", ply("ascii", b"0.5 0.25\n0.5 0.1\n"), 9, "2 numbers where a vertex has 3"),
    ("PLY, no end", "a.ply", b"ply\nformat ascii 1.0\n", None, "without end_header"),
    ("PLY, a wrong line", "a.ply", b"ply\nformat ascii 2.0\nend_header\n", 2, "no line of a PLY header"),
    ("PLY, no vertices", "a.ply", b"ply\nformat ascii 1.0\nend_header\n", None, "without element vertex"),
    (
        "PLY, flat",
        "a.ply",
        ply("ascii", b"0.5 0.25 0\n0.125 0.75 0\n"),
        None,
        "a set of the plane is read by",
    ),
    (
        "PLY outside",
        "a.ply",
        ply("ascii", b"0.5 0.25 0\n0.125 0.75 5\n"),
        10,
        "coordinate 5.0 is not in [0, 1]",
    ),
    (
        "XYZ, cut",
        "a.xyz",
        "3\n\nC 0.5 0.25 0.125\nC 0.1 0.2 0.3\n",
        1,
        "says 3 atoms, and the file ends after 2",
    ),
    ("XYZ, a word", "a.xyz", "1\n\nC 0.5 0.25 0.125 \n1\n\nC 0.5 x 0.3\n", 6, "'x' is not a number"),
    ("XYZ, few columns", "a.xyz", "2\n\nC 0.5 0.25 0.125\nC 0.5 0.3\n", 4, "here are 3 columns"),
    ("XYZ, flat", "a.xyz", "2\n\nC 0.5 0.25 0\nC 0.1 0.2 0\n", 3, "z is 0 in every point"),
    ("XYZ, slanted", "a.xyz", '1\nLattice="2 0 0 1 2 0 0 0 2"\nC 0 1 1\n', 2, "no box of right angles"),
    (
        "XYZ, a short cell",
        "a.xyz",
        '1\nLattice="2 0 0"\nC 0 1 1\n',
        2,
        "Lattice must be 9 numbers; here are 3",
    ),
    ("XYZ outside", "a.xyz", f"1\n{CELL}\nC 0 4.5 1 0 0 0\n", 3, "where it left through a side, --wrap"),
    ("LAMMPS, cut", "a.dump", DUMP[: DUMP.index("7 2")], 9, "2 atoms were told, and the file ends after 1"),
    ("LAMMPS, no atoms", "a.dump", DUMP[: DUMP.index("ITEM: ATOMS")], 8, "no ATOMS after its last timestep"),
    ("LAMMPS, slanted", "a.dump", DUMP.replace("BOUNDS pp", "BOUNDS xy xz yz pp"), 5, "triclinic"),
    ("LAMMPS, two boxes", "a.dump", DUMP + DUMP.replace("0 8", "0 9"), 20, "another box than the first"),
    ("LAMMPS outside", "a.dump", DUMP.replace("-0.75 3.0", "-0.75 4.5"), 11, "4.5 is not in [0, 4], the box"),
    ("LAMMPS, a column less", "a.dump", DUMP.replace("7 2 ", "7 "), 11, "4 columns where ATOMS names 5"),
    ("LAMMPS, no columns", "a.dump", DUMP.replace("x y z", "a b c"), 9, "no column of coordinates"),
    ("LAMMPS, flat", "a.dump", DUMP.replace("3.0 4.0", "3.0 1.0"), 10, "z is 1 in every point"),
    (".edat without a box", "a.edat", "0.5 0.25\n0.1 0.2\n0.3 0.4\n", 3, "an .edat begins each set with"),
    (".edat, a flat box", "a.edat", "0 0\n1 0\n1\n0.5 0\n", 2, "must lie above the lower"),
    (".edat outside", "a.edat", EDAT + "1.5 0\n", 6, "coordinate 1.5 is not in [-1, 1], the box"),
    (
        ".edat, two boxes",
        "a.edat",
        EDAT + "#\n" + EDAT.replace("4\n1", "5\n1"),
        7,
        "another box than the one before",
    ),
    (".edat, no points", "a.edat", EDAT + "#\n-1 0\n1 4\n1\n", 7, "a box without points"),
    (".edat, struck out", "a.edat", EDAT + "#0.5 0.25\n", 6, "a point behind a '#'"),
    (".edat, a blank line", "a.edat", EDAT + "\n0.5 0.25\n", 6, "a blank line between points"),
    ("JSON, cut", "a.json", "[[0.5, 0.25],\n[0.5", 2, "begins as JSON does and is none"),
    ("JSON, NaN", "a.json", "[[0.5, NaN]]", None, "NaN is not a number"),
    ("JSON, ragged", "a.json", "[[0.5, 0.25], [0.5]]", None, "point 1 has 1 numbers where point 0 has 2"),
    ("JSON, a word", "a.json", '[[0.5, "x"]]', None, 'point 0: "x" is not a number'),
    ("JSON, true", "a.json", "[[0.5, true]]", None, "true is not a number"),
    ("JSON, numbers alone", "a.json", "[0.5, 0.25]", None, "point 0 is no list"),
    ("JSON, nothing", "a.json", "[]", None, "holds no points"),
    (
        "JSON, other keys",
        "a.json",
        '{"xy": [[0.5]]}',
        None,
        "has no 'points': it has 'xy'; --array takes another",
    ),
    ("JSON, a key twice", "a.json", '{"points": [[0.5]], "points": [[0.1]]}', None, "a key stands twice"),
    ("JSON, deep", "a.json", "[" * 100_000, None, "nested too deeply"),
    ("JSON, huge", "a.json", f"[[0.5, 1{'0' * 400}]]", None, "0...' is too large for a number"),
    ("JSON outside", "a.json", "[[[0.5, 0.25]], [[0.5, 2]]]", None, "set 1: coordinate 2.0 is not in [0, 1]"),
    ("JSON, dimensions", "a.json", "[[[0.5, 0.25]], [[0.5]]]", None, "different dimensions: [1, 2]"),
    ("JSON, a weight", "a.json", '[{"x": 0.5, "y": 0.5, "m": 2}]', None, "column 'm' is no coordinate"),
]


@pytest.mark.parametrize(("name", "data", "line", "said"), [b[1:] for b in BAD], ids=[b[0] for b in BAD])
def test_refuses(tmp_path: Path, name: str, data: bytes | str, line: int | None, said: str) -> None:
    path = put(tmp_path, name, data)
    with pytest.raises(FormatError) as caught:
        load(path)
    assert said in str(caught.value)
    assert (caught.value.path, caught.value.line) == (path, line)
    assert "\n" not in str(caught.value)


def test_a_bomb_is_refused_unpacked(tmp_path: Path) -> None:
    bomb = put(tmp_path, "a.txt.gz", gzip.compress(b"0.5 0.5\n" * 100_000))
    with pytest.raises(FormatError, match=r"unpacked, it holds 100 kB or more"):
        load(bomb, max_bytes=100_000)
