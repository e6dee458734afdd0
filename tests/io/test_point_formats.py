"""Formats of other fields: PLY, XYZ, LAMMPS dumps, UTK's .edat, JSON and packed files."""

from __future__ import annotations

import bz2
import gzip
import json
import lzma
import struct
from pathlib import Path

import numpy as np
import pytest

from gbnbench.core.errors import FormatError, InputError
from gbnbench.io.points import PointSets, ReadingOptions, load, read_sets, reading_options, save
from gbnbench.io.points.formats.registry import FORMATS
from gbnbench.io.points.writer import WRITTEN
from tests.io.format_files import CELL, DUMP, EDAT, FACES, FIELDS, FLAT, FRACTIONS, PLANE, POLYGON, A, B, ply
from tests.io.point_bytes import put

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


def test_columns_are_taken_by_name(tmp_path: Path) -> None:
    def taken(name: str, data: bytes | str, columns: str, **more: object) -> list[list[float]]:
        options = reading_options(columns, **more)  # type: ignore[arg-type]
        (found,) = read_sets(put(tmp_path, name, data), options).sets
        return found.tolist()  # type: ignore[no-any-return]

    assert taken("a.csv", "id,x,y,kind\n8,0.5,0.25,red\n9,0.125,0.75,\n", "x,y") == FLAT
    assert taken("a.csv", "id;X;Y\n8;0,5;0,25\n9;0,125;0,75\n", "x,y") == FLAT
    assert taken("a.txt", "8 0.5 0.25 red\n9 0.125 0.75 blue\n", "2,3") == FLAT
    assert taken("a.txt", '"x" "y"\n"1" 0.25 0.5\n"2" 0.75 0.125\n', "y,x") == FLAT
    assert taken("a.npy", FIELDS, "mass,x") == [[0.0, 0.0]] * 3
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


def test_a_box_is_contradicted_on_any_axis(tmp_path: Path) -> None:
    path = tmp_path / "x.xyz"
    path.write_text('1\nLattice="1000 0 0 0 1 0 0 0 1"\nC 500 0.5 0.25\n')
    with pytest.raises(FormatError, match="which --period contradicts"):
        read_sets(path, reading_options(period=(1000, 1.0009, 0.9991)))
    assert read_sets(path, reading_options(period=(1000, 1, 1 + 1e-9))).sides == (1000, 1, 1)


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
    with pytest.raises(InputError, match="a PLY file holds one set; got several"):
        save(tmp_path / "a.ply", [A, A])
    with pytest.raises(InputError, match="at most three dimensions; got d=4"):
        save(tmp_path / "a.dump", np.zeros((2, 4)))
    assert not list(tmp_path.iterdir())
