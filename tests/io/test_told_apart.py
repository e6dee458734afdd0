"""Files whose kind decides: it is said by name, and no axis, point or header is lost or made up."""

from __future__ import annotations

import bz2
import gzip
import json
import lzma
from pathlib import Path

import numpy as np
import pytest

from gbnbench.core.errors import FormatError
from gbnbench.io.points import PointSets, ReadingOptions, load, read_sets, save
from tests.io.format_files import DUMP, EDAT, ply
from tests.io.point_bytes import PSA_EPS, npy, npz, put

FLOATS = np.random.default_rng(0).random((40, 2)).astype("<f4").tobytes()
NONE = ReadingOptions()

REFUSED: list[tuple[str, str, bytes | str, ReadingOptions, str]] = [
    ("LAMMPS, z of another kind", "a.dump", DUMP.replace("x y z", "xu yu z"), NONE, "xu, yu, z"),
    ("LAMMPS, zs beside x", "a.dump", DUMP.replace("x y z", "x y zs"), NONE, "x, y, zs are coord"),
    ("raw .npy", "a.npy", npy([[0.5, 0.5]]), ReadingOptions(raw="u1,2"), "is a numpy array, and --raw"),
    ("raw .npz", "a", npz(x=np.eye(2)), ReadingOptions(raw="u1,1"), "is an archive, such as .npz, and --raw"),
    ("raw PNG", "a", b"\x89PNG\r\n\x1a\n" + FLOATS, ReadingOptions(raw="f4,2"), "is a PNG image, and --raw"),
    ("raw JPEG", "a", b"\xff\xd8\xff\xe0" + FLOATS, ReadingOptions(raw="f4,1"), "is a JPEG image, and --raw"),
    ("raw PLY", "a", ply("ascii", b""), ReadingOptions(raw="u1,1"), "is a PLY file, and --raw"),
    ("raw EPS", "a", PSA_EPS, ReadingOptions(raw="u1,1"), "is PostScript, and --raw"),
    ("raw text", "a", b"0.5 0.25\n0.5 0.75\n", ReadingOptions(raw="u1,1"), "is text, and --raw"),
    ("packed twice", "a.gz", gzip.compress(gzip.compress(b"0.5 0.5\n")), NONE, "is packed twice"),
    ("packed twice, otherwise", "a.xz", lzma.compress(bz2.compress(b"0.5")), NONE, "packed twice"),
    ("UTF-32", "a.txt", "0.5 0.25\n".encode("utf-32"), NONE, "is UTF-32 text; save it as UTF-8"),
    ("GeoJSON", "a.json", '{"type": "FeatureCollection"}', NONE, "is GeoJSON, whose longitudes"),
    ("pandas' columns", "a.json", '{"x": {"0": 0.5}}', NONE, "to_json(path, 'records')"),
    ("columns unlike", "a.json", '{"x": [0.5], "y": []}', NONE, "different lengths: {\"x\": 1, "),
    ("columns of nothing", "a.json", '{"x": [], "y": []}', NONE, "holds no points: its columns"),
    ("JSON of nothing", "a.json", "[[]]", NONE, "holds no points: points are lists"),
    (".edat of nothing", "a.edat", "0 0\n1 1\n1\n", NONE, "a box without points"),
    ("PLY of nothing", "a.ply", ply("ascii", b"").replace(b"x 2", b"x 0"), NONE, "it holds no poi"),
    ("XYZ of the plane", "a.xyz", "2\nwater\nC 0.5 0.5\nC 0 0\n", NONE, "3: an atom is 'symbol x"),
    ("too large", "a.edat", EDAT + "1e999 0\n", NONE, "line 6: '1e999' is too large for a number"),
]  # fmt: skip


@pytest.mark.parametrize(
    ("name", "data", "options", "said"), [r[1:] for r in REFUSED], ids=[r[0] for r in REFUSED]
)
def test_refuses(tmp_path: Path, name: str, data: bytes | str, options: ReadingOptions, said: str) -> None:
    path = put(tmp_path, name, data)
    with pytest.raises(FormatError) as caught:
        read_sets(path, options)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


def ply_of_faces(order: str, places: str, tail: bytes = b"") -> bytes:
    """A binary PLY of two vertices with a list of two faces, in front of them or behind."""
    byte = "<" if order == "little" else ">"
    faces = b"".join(
        bytes([len(face)]) + np.array(face, f"{byte}i4").tobytes() for face in ([0, 1, 1], [0, 1, 1, 0])
    )
    vertices = np.array([[0.5, 0.25, 0.125], [0.125, 0.75, 0.5]], f"{byte}f4").tobytes()
    heads = {
        "v": "element vertex 2\nproperty float x\nproperty float y\nproperty float z\n",
        "f": "element face 2\nproperty list uchar int vertex_indices\n",
    }
    head = f"ply\nformat binary_{order}_endian 1.0\n{''.join(heads[k] for k in places)}end_header\n"
    return head.encode() + b"".join({"v": vertices, "f": faces}[k] for k in places) + tail


@pytest.mark.parametrize("order", ["little", "big"])
@pytest.mark.parametrize("places", ["vf", "fv"])
def test_faces_of_a_binary_ply_are_left_aside_and_fill_the_file(
    tmp_path: Path, order: str, places: str
) -> None:
    path = put(tmp_path, "a.ply", ply_of_faces(order, places))
    assert np.array_equal(load(path), [[0.5, 0.25, 0.125], [0.125, 0.75, 0.5]])
    with pytest.raises(FormatError, match="need 54 bytes after the header, and 55 are there: truncated"):
        load(put(tmp_path, "b.ply", ply_of_faces(order, places, b"\0")))
    with pytest.raises(FormatError, match="truncated or damaged"):
        load(put(tmp_path, "c.ply", ply_of_faces(order, places)[:-1]))


def test_packed_numbers_without_a_header_are_unpacked(tmp_path: Path) -> None:
    expected = np.frombuffer(FLOATS, "<f4").reshape(-1, 2)
    for name, data in (("a.bin", FLOATS), ("a.bin.gz", gzip.compress(FLOATS)), ("b", bz2.compress(FLOATS))):
        assert np.array_equal(load(put(tmp_path, name, data), raw="float32,2"), expected)
    short = b"\x1f\x8b" + FLOATS[2:]  # two bytes of gzip, as numbers can begin
    assert np.shape(load(put(tmp_path, "c", short), raw="float32,2")) == (40, 2)


def test_columns_of_json(tmp_path: Path) -> None:
    columns = {"x": [0.5, 0.125], "y": [0.25, 0.75]}
    assert np.array_equal(load(put(tmp_path, "a.json", json.dumps(columns))), [[0.5, 0.25], [0.125, 0.75]])
    more = put(tmp_path, "b.json", json.dumps({"kind": ["a", "b"], **columns, "sides": [2, 1]}))
    assert np.array_equal(load(more, columns="x,y"), [[0.25, 0.25], [0.0625, 0.75]])
    with pytest.raises(FormatError, match=r"column 'kind' is no coordinate; .* --columns x,y takes"):
        load(more)


@pytest.mark.parametrize("suffix", [".dump", ".lammpstrj", ".xyz", ".extxyz", ".ply"])
def test_a_set_of_space_in_one_plane_comes_back(tmp_path: Path, suffix: str) -> None:
    """Our own files say that the points are of space, though z is the same in all."""
    x = np.random.default_rng(2).random((5, 3))
    x[:, 2] = 0.25
    path = tmp_path / f"a{suffix}"
    save(path, x)
    assert np.array_equal(load(path), x)
    if suffix != ".ply":
        save(path, PointSets([x], (2.0, 4.0, 8.0), (0.0, 0.0, 0.0), True))
        assert np.array_equal(load(path), x)
