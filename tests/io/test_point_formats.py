"""Formats of other fields: PLY, XYZ, LAMMPS dumps, UTK's .edat, JSON and packed files."""

from __future__ import annotations

import bz2
import gzip
import io
import json
import lzma
import pickle
import struct
import zipfile
from pathlib import Path

import numpy as np
import pytest

from gbnbench.core.errors import FormatError, InputError
from gbnbench.io.points import PointSets, ReadingOptions, load, read_sets, reading_options, save
from gbnbench.io.points.formats.registry import FORMATS
from gbnbench.io.points.writer import WRITTEN

A, B = [[0.5, 0.25, 0.125], [0.125, 0.75, 0.5]], [[0.0, 0.875, 0.25]]
FLAT = [row[:2] for row in A]


def put(folder: Path, name: str, data: bytes | str) -> Path:
    path = folder / name
    path.write_bytes(data.encode() if isinstance(data, str) else data)
    return path


def ply(kind: str, body: bytes, properties: str = "float x\nproperty float y\nproperty float z") -> bytes:
    head = f"ply\nformat {kind} 1.0\ncomment by hand\nelement vertex 2\nproperty {properties}\nend_header\n"
    return head.encode() + body


DUMP = """ITEM: TIMESTEP
0
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp pp pp
-1.0 1.0
0.0 4.0
0 8
ITEM: ATOMS id type x y z
1 1 0.0 1.0 1.0
7 2 -0.75 3.0 4.0
"""
CELL = (
    'Lattice="2.0 0 0 0 4.0 0 0 0 8.0" Origin="-1 0 0" Properties=species:S:1:pos:R:3:forces:R:3 pbc="T T T"'
)
FRACTIONS = (
    DUMP.replace("x y z", "xs ys zs")
    .replace("0.0 1.0 1.0", "0.5 0.25 0.125")
    .replace("-0.75 3.0 4.0", "0.125 0.75 0.5")
)
PLANE = (
    DUMP.replace(" z\n", "\n")
    .replace("1.0 1.0\n1", "1.0\n1")
    .replace("1.0 1.0\n7", "1.0\n7")
    .replace("3.0 4.0", "3.0")
)
EDAT = "-1\t0\n1\t4\n1\n0.0\t1.0\n-0.75\t3\n"
POLYGON = b"0.5 0.25 0.125\n0.125 0.75 0.5\n3 0 1 1\n"
FACES = "float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices"

GOOD: list[tuple[str, str, bytes | str, list[list[list[float]]], tuple[float, ...] | None]] = [
    ("PLY", "a.ply", ply("ascii", b"0.5 0.25 0.125\n0.125 0.75 0.5\n"), [A], None),
    (
        "PLY, Windows",
        "a.ply",
        ply("ascii", b"0.5 0.25 0.125\n0.125 0.75 0.5\n").replace(b"\n", b"\r\n"),
        [A],
        None,
    ),
    ("PLY with faces", "a.ply", ply("ascii", POLYGON, FACES), [A], None),
    ("PLY, little-endian", "a.ply", ply("binary_little_endian", np.array(A, "<f4").tobytes()), [A], None),
    ("PLY, big-endian", "a.ply", ply("binary_big_endian", np.array(A, ">f4").tobytes()), [A], None),
    (
        "PLY with colours, in double",
        "a.bin",
        ply(
            "binary_little_endian",
            b"".join(struct.pack("<dBdd", row[0], 9, *row[1:]) for row in A),
            "double x\nproperty uchar red\nproperty double y\nproperty float64 z",
        ),
        [A],
        None,
    ),
    (
        "PLY of the plane",
        "a.ply",
        ply("ascii", b"0.5 0.25\n0.125 0.75\n", "float x\nproperty float y"),
        [FLAT],
        None,
    ),
    ("XYZ", "a.xyz", "2\n\nC 0.5 0.25 0.125\nHe 0.125 0.75 0.5 0.9\n", [A], None),
    (
        "XYZ, frames",
        "a.xyz",
        "2\nfirst\nC 0.5 0.25 0.125\nC 0.125 0.75 0.5\n1\nb\nC 0 0.875 0.25",
        [A, B],
        None,
    ),
    ("XYZ of atomic numbers", "a.xyz", "2\nwater\n6 0.5 0.25 0.125\n6 0.125 0.75 0.5\n", [A], None),
    ("rows called .xyz", "a.xyz", "0.5 0.25 0.125\n0.125 0.75 0.5\n", [A], None),
    ("counted rows called .xyz", "a.xyz", "2\n0.5 0.25 0.125\n0.125 0.75 0.5\n", [A], None),
    ("extended XYZ", "a.xyz", f"2\n{CELL}\nC 0 1 1 9 9 9\nC -0.75 3 4 9 9 9\n", [A], (2.0, 4.0, 8.0)),
    ("LAMMPS", "a.lammpstrj", DUMP, [A], (2.0, 4.0, 8.0)),
    ("LAMMPS, two timesteps", "dump", DUMP + DUMP.replace("\n0\n", "\n10\n"), [A, A], (2.0, 4.0, 8.0)),
    (
        "LAMMPS, fractions",
        "a.dump",
        FRACTIONS,
        [A],
        (2.0, 4.0, 8.0),
    ),
    (
        "LAMMPS, unwrapped",
        "a.dump",
        DUMP.replace("x y z", "xu yu zu").replace("-0.75 3.0", "5.25 -5.0"),
        [A],
        (2.0, 4.0, 8.0),
    ),
    ("LAMMPS of the plane", "a.dump", PLANE, [FLAT], (2.0, 4.0)),
    (".edat", "a.edat", EDAT, [FLAT], (2.0, 4.0)),
    (".edat, two sets", "a.edat", EDAT + "#\n" + EDAT, [FLAT, FLAT], (2.0, 4.0)),
    (".edat, one box", "a.edat", EDAT + "#\n0.0 1.0\n", [FLAT, FLAT[:1]], (2.0, 4.0)),
    ("JSON", "a.json", json.dumps(A), [A], None),
    ("JSON without its name", "a.txt", json.dumps(A), [A], None),
    ("JSON, sets", "a.json", json.dumps([A, B]), [A, B], None),
    ("JSON, an object", "a.json", json.dumps({"by": "us", "points": A}), [A], None),
    ("JSON, records", "a.json", json.dumps([dict(zip("xyz", row, strict=True)) for row in A]), [A], None),
    (
        "JSON with a box",
        "a.json",
        json.dumps({"points": [[1, 3]], "sides": [2, 4]}),
        [[[0.5, 0.75]]],
        (2.0, 4.0),
    ),
    ("gzip", "a.csv.gz", gzip.compress(b"x,y,z\n0.5,0.25,0.125\n0.125,0.75,0.5\n"), [A], None),
    ("bzip2", "a.txt.bz2", bz2.compress(b"0.5 0.25 0.125\n0.125 0.75 0.5\n"), [A], None),
    ("xz", "a.dat.xz", lzma.compress(b"0.5 0.25 0.125\n0.125 0.75 0.5\n"), [A], None),
    ("gzip without its name", "a.csv", gzip.compress(b"x,y,z\n0.5,0.25,0.125\n0.125,0.75,0.5\n"), [A], None),
]


@pytest.mark.parametrize(("name", "data", "sets", "sides"), [g[1:] for g in GOOD], ids=[g[0] for g in GOOD])
def test_reads(
    tmp_path: Path,
    name: str,
    data: bytes | str,
    sets: list[list[list[float]]],
    sides: tuple[float, ...] | None,
) -> None:
    found = read_sets(put(tmp_path, name, data))
    assert [x.tolist() for x in found.sets] == sets
    assert found.sides == sides
    assert all(x.dtype == np.float64 and x.flags.c_contiguous for x in found.sets)


OBJECTS = io.BytesIO()
np.save(OBJECTS, np.array([[0.5, "a"]], dtype=object), allow_pickle=True)
FIELDS = io.BytesIO()
np.save(FIELDS, np.zeros(3, [("x", "f8"), ("mass", "f8")]))
OFFICE = io.BytesIO()
with zipfile.ZipFile(OFFICE, "w") as _archive:
    _archive.writestr("[Content_Types].xml", "<Types/>")

BAD: list[tuple[str, str, bytes | str, int | None, str]] = [
    ("a pickle", "a.pkl", pickle.dumps([0.5]), None, "refused as unsafe; save the points by numpy.save"),
    ("a pickle of text", "a.pickle", pickle.dumps([0.5], 0), None, "refused as unsafe"),
    ("a pickle called .npy", "a.npy", pickle.dumps([0.5]), None, "refused as unsafe"),
    ("objects", "a.npy", OBJECTS.getvalue(), None, "an array of Python objects is a pickle"),
    ("a structured array", "a.npy", FIELDS.getvalue(), None, "fields x, mass: say which are coordinates"),
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
        OFFICE.getvalue(),
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
    ("JSON, huge", "a.json", f"[[0.5, 1{'0' * 400}]]", None, "coordinate inf is not finite"),
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


def test_columns_are_taken_by_name(tmp_path: Path) -> None:
    def taken(name: str, data: bytes | str, columns: str, **more: object) -> list[list[float]]:
        options = reading_options(columns, **more)  # type: ignore[arg-type]
        (found,) = read_sets(put(tmp_path, name, data), options).sets
        return found.tolist()  # type: ignore[no-any-return]

    assert taken("a.csv", "id,x,y,kind\n8,0.5,0.25,red\n9,0.125,0.75,\n", "x,y") == FLAT
    assert taken("a.csv", "id;X;Y\n8;0,5;0,25\n9;0,125;0,75\n", "x,y") == FLAT
    assert taken("a.txt", "8 0.5 0.25 red\n9 0.125 0.75 blue\n", "2,3") == FLAT
    assert taken("a.txt", '"x" "y"\n"1" 0.25 0.5\n"2" 0.75 0.125\n', "y,x") == FLAT
    assert taken("a.npy", FIELDS.getvalue(), "mass,x") == [[0.0, 0.0]] * 3
    assert taken("a.ply", ply("ascii", b"0.5 0.25 0\n0.125 0.75 0\n"), "x,y") == FLAT
    assert taken("a.xyz", f"1\n{CELL}\nC 0 1 1 9 9 9\n", "y,x") == [[0.25, 0.5]]
    assert taken("a.dump", DUMP, "x,y") == FLAT
    assert taken("a.dump", FRACTIONS, "ys") == [[0.25], [0.75]]
    assert taken("a.json", json.dumps({"p": A}), "1,2", array="p") == FLAT
    sets = read_sets(
        put(tmp_path, "s.csv", "set,x,y,m\n0,0.5,0.25,9\n1,0.125,0.75,9\n"), reading_options("x,y")
    )
    assert [x.tolist() for x in sets.sets] == [FLAT[:1], FLAT[1:]]
    for name, data, columns, said in (
        ("a.csv", "x,y\n0.5,0.25\n", "x,z", "has no column 'z'; its columns are x, y"),
        ("a.csv", "x,y\n0.5,\n", "x,y", "line 2: an empty cell, in column 'y'"),
        ("a.csv", "x,y\n0.5,0.25\n", "x,X", "columns x,X name one column twice"),
        ("a.txt", "0.5 0.25\n", "1,3", "without names its 2 columns are counted from 1"),
        ("a.txt", "0.5 0.25 a\n0.5 0.25\n", "1,2", "line 2: 2 columns where the lines before have 3"),
        ("a.dump", DUMP, "x,v", "has no axis 'v'; its axes are x, y, z"),
        ("a.edat", EDAT, "x", "--columns means nothing to a file of this format"),
        ("a.csv", "x,y\n0.5,0.25\n", None, "--array means nothing to a file of this format (text)"),
    ):  # fmt: skip
        options = ReadingOptions(array="a") if columns is None else reading_options(columns)
        with pytest.raises(FormatError) as caught:
            read_sets(put(tmp_path, name, data), options)
        assert said in str(caught.value)


def test_a_box_of_the_file_is_not_contradicted(tmp_path: Path) -> None:
    path = put(tmp_path, "a.edat", EDAT)
    assert read_sets(path, reading_options(bounds=(-1, 1, 0, 4))).sides == (2.0, 4.0)
    with pytest.raises(
        FormatError, match=r"tells its own box, \[-1, 1\] x \[0, 4\], which --period contradicts"
    ):
        load(path, period=(2, 4))


def test_a_box_says_whether_it_is_a_torus(tmp_path: Path) -> None:
    assert read_sets(put(tmp_path, "a.dump", DUMP)).toroidal is True
    assert read_sets(put(tmp_path, "b.dump", DUMP.replace("pp pp pp", "pp ff pp"))).toroidal is False
    assert read_sets(
        put(tmp_path, "b.dump", DUMP.replace("pp pp pp", "pp pp ff")), reading_options("x,y")
    ).toroidal
    edge = read_sets(put(tmp_path, "a.edat", EDAT.replace("4\n1\n", "4\n0\n") + "1 4\n"))
    assert edge.toroidal is False
    assert edge.sets[0][-1].tolist() == [np.nextafter(1, 0)] * 2


def test_every_format_that_is_written_is_read(tmp_path: Path) -> None:
    rng = np.random.default_rng(5)
    assert {suffix for f in FORMATS for suffix in f.write} == {*WRITTEN}
    for suffix, form in WRITTEN.items():
        for d in (1, 2, 3):
            x = rng.random((5, d))
            for packed in ("", ".gz", ".bz2", ".xz"):
                path = tmp_path / f"a{suffix}{packed}"
                if form.name == "XYZ" and d != 3:
                    with pytest.raises(InputError, match=f"three dimensions; got d={d}"):
                        save(path, x)
                    continue
                save(path, x)
                found = read_sets(path)
                assert found.sets[0].tobytes() == x.tobytes(), (suffix, d)
                assert set(found.sides or (1.0,)) == {1.0}


@pytest.mark.parametrize("suffix", [s for s, form in WRITTEN.items() if form.keeps_box])
@pytest.mark.parametrize("toroidal", [True, False])
def test_a_box_is_kept(tmp_path: Path, suffix: str, toroidal: bool) -> None:
    x = PointSets(
        [np.random.default_rng(k).random((4, 3)) for k in range(2)],
        (2.0, 4.5, 8.0),
        (-1.0, 0.0, 3.0),
        toroidal,
    )
    save(tmp_path / f"a{suffix}", x)
    found = read_sets(tmp_path / f"a{suffix}")
    assert (found.sides, found.low, found.toroidal) == (x.sides, x.low, toroidal)
    for given, read in zip(x.sets, found.sets, strict=True):
        np.testing.assert_allclose(read, given, rtol=0, atol=4e-16)


def test_what_a_format_cannot_hold_is_refused(tmp_path: Path) -> None:
    flat = PointSets([np.array(FLAT)], (2.0, 4.0), (0.0, 0.0), True)
    with pytest.raises(InputError, match=r"a\.csv: text cannot hold a box of unequal sides, 2 x 4; \.npz, "):
        save(tmp_path / "a.csv", flat)
    with pytest.raises(InputError, match="text cannot say that the box is no torus"):
        save(tmp_path / "a.csv", PointSets([np.array(FLAT)], (2.0, 2.0), (0.0, 0.0), False))
    for suffix in (".edat", ".dump"):
        with pytest.raises(InputError, match="which is not known here: give the sides by --period"):
            save(tmp_path / f"a{suffix}", PointSets([np.array(FLAT)], (2.0, 4.0), (0.0, 0.0)))
    with pytest.raises(InputError, match="a PLY file holds one set; got 2"):
        save(tmp_path / "a.ply", [A, A])
    with pytest.raises(InputError, match="at most three dimensions; got d=4"):
        save(tmp_path / "a.dump", np.zeros((2, 4)))
    assert not list(tmp_path.iterdir())


def test_a_bomb_is_refused_unpacked(tmp_path: Path) -> None:
    bomb = put(tmp_path, "a.txt.gz", gzip.compress(b"0.5 0.5\n" * 100_000))
    with pytest.raises(FormatError, match=r"unpacked, it holds 100 kB or more"):
        load(bomb, max_bytes=100_000)
