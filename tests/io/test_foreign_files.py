"""Files of other programs: each is told by name, with a way to its points; none that is alike is refused."""

from __future__ import annotations

import gzip
import io
import zipfile
from pathlib import Path

import numpy as np
import pytest

from gbnbench.core.errors import FormatError
from gbnbench.io.points import load
from tests.io.point_bytes import npy, put

P = np.array([[0.5, 0.25], [0.125, 0.75]])
TRIPLES = np.array([[1.5, 0.25, 3.0], [2.5, 0.75, 1.0]])


def packed(name: str, text: str) -> bytes:
    """An archive that holds one text."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr(name, text)
    return file.getvalue()


VTK = b"# vtk DataFile Version 3.0\npoints\n%s\nDATASET POLYDATA\nPOINTS 2 float\n%s"
PCD = b"VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nDATA %s\n"
ROWS = b"1.5 0.25 3\n2.5 0.75 1\n"

FOREIGN: list[tuple[str, str, bytes, str]] = [
    ("VTK", "a.vtk", VTK % (b"ASCII", ROWS), "is a VTK file, not points: save its points by numpy.save("),
    ("VTK, binary", "a.vtk", VTK % (b"BINARY", TRIPLES.astype(">f4").tobytes()), "is a VTK file"),
    ("VTK in XML", "a.vtp", b'<VTKFile type="PolyData">\n</VTKFile>\n', "is a VTK file"),
    ("VTK in whole XML", "a.vtu", b'<?xml version="1.0"?>\n<VTKFile type="a">\n', "is a VTK file"),
    ("other XML", "a.xml", b"<points><p x='1'/></points>", "is an XML or HTML file"),
    ("PCD", "a.pcd", b"# .PCD v.7\n" + PCD % b"ascii" + ROWS, "is a PCD file, not points: save it as .ply"),
    ("PCD without a comment", "a.pcd", PCD % b"ascii" + ROWS, "is a PCD file"),
    ("PCD, binary", "a.pcd", b"# .PCD v.7\n" + PCD % b"binary" + TRIPLES.tobytes(), "is a PCD file"),
    ("OBJ", "a.obj", b"# made\no points\nv 1.5 0.25 3\nv 2.5 0.75 1\n", "is an OBJ file"),
    ("OFF", "a.off", b"OFF\n2 0 0\n" + ROWS, "is an OFF file"),
    ("STL", "a.stl", b"solid a\n facet normal 0 0 1\n", "is an STL file"),
    ("PDB", "a.pdb", b"HEADER\nATOM      1  N   ALA A   1      11.104   6.134  -6.504\n", "ase convert FILE"),
    ("CIF", "a.cif", b"data_si\n_cell_length_a 5.43\n", "is a CIF file"),
    ("GROMACS", "a.gro", b"MD\n 1\n    1WATER  OW1    1   0.126   1.624   1.679\n", "is a GROMACS f"),
    ("VASP", "POSCAR", b"Si\n1.0\n5.4 0 0\n0 5.4 0\n0 0 5.4\nSi\n1\nDirect\n0 0 0\n", "is a POSCAR"),
    ("LAMMPS data", "a.data", b"LAMMPS\n\n12 atoms\n1 atom types\n", "ase convert -i lammps-data FILE"),
    ("Gmsh", "a.msh", b"$MeshFormat\n4.1 0 8\n", "is a Gmsh file"),
    ("ARFF", "a.arff", b"@RELATION p\n@attribute x numeric\n@data\n0.5\n", "remove its lines that b"),
    ("WKT", "a.wkt", b"POINT (0.5 0.25)\nPOINT (0.1 0.75)\n", "is well-known text"),
    ("YAML", "a.yaml", b"points:\n- [0.5, 0.25]\n", "is a YAML file"),
    ("MATLAB's display", "a.txt", b"x =\n\n    0.5    0.25\n", "is a program's text"),
    ("a literal of Julia", "a.jl", b"x = [0.5 0.25; 0.1 0.75]\n", "is a program's text"),
    ("Mathematica", "a.m", b"{{0.5, 0.25}, {0.1, 0.75}}\n", 'Export["points.csv", x] writes its points'),
    ("numpy's print", "a.txt", b"[[0.5 0.25]\n [0.1 0.75]]\n", "rows of plain text have no brackets"),
    ("LAS", "a.las", b"LASF" + bytes(300), "numpy.save('points.npy', laspy.read(FILE).xyz)"),
    ("ImageJ", "a.roi", b"Iout" + bytes(100), "is a selection of ImageJ"),
    ("FITS", "a.fits", b"SIMPLE  =                    T" + bytes(100), "is a FITS file"),
    ("Git LFS", "a.txt", b"version https://git-lfs.github.com/spec/v1\noid sha256:0a\n", "git lfs pull"),
    ("R", "a.rds", gzip.compress(b"X\n\0\0\0\x03" + bytes(60)), "row.names = FALSE"),
    ("MATLAB 4", "a.mat", bytes(20) + b"x\0" + P.tobytes(), "is a MATLAB file"),
    ("MATLAB 7.3", "a.mat", b"MATLAB 7.3 MAT-file" + bytes(500) + b"\x89HDF", "is a MATLAB file"),
    ("a zip of text", "a.zip", packed("a.csv", "0.5,0.25\n"), "holds 'a.csv': unpack it, and name the"),
    ("a line", "a.npy", npy(np.array([0.5, 0.25])), "got (2,): of points on a line save x[:, None]"),
    ("complex", "a.npy", npy(P.astype(complex)), "save numpy.column_stack([z.real, z.imag])"),
    ("a field of points", "a.npy", npy(np.zeros(3, [("id", "i4"), ("pos", "f8", 2)])), "(FILE, x['pos'])"),
    ("fields", "a.npy", npy(np.zeros(3, "i4,f8,f8")), "--columns f0,f1,f2 takes those wanted"),
    ("named fields", "a.npy", npy(np.zeros(3, [("id", "i4"), ("x", "f8"), ("y", "f8")])), "--columns x,y t"),
]  # fmt: skip


@pytest.mark.parametrize(("name", "data", "said"), [f[1:] for f in FOREIGN], ids=[f[0] for f in FOREIGN])
def test_is_told_by_name(tmp_path: Path, name: str, data: bytes, said: str) -> None:
    with pytest.raises(FormatError) as caught:
        load(put(tmp_path, name, data))
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("data", [f[2] for f in FOREIGN[1:2] + FOREIGN[7:8] + FOREIGN[24:26]])
def test_its_header_is_never_read_as_numbers(tmp_path: Path, data: bytes) -> None:
    with pytest.raises(FormatError, match="and --raw is for numbers without a header: leave it out"):
        load(put(tmp_path, "a", data), raw="uint8,1", period=256)


ALIKE: list[tuple[str, str, str | None]] = [
    ("a count below a title", "# title\n2\n1e-05 0.25\n0.125 0.75\n", None),
    ("exponents without a sign", "#\n2\n1E00 0.25\n0.125 0.75\n", None),
    ("labels of atoms", "v 0.5 0.25\nv 0.125 0.75\n", "2,3"),
    ("names", "data_x,data_y\n0.5,0.25\n0.125,0.75\n", "data_x,data_y"),
    ("words as labels", "kind,x,y\nDirect,0.5,0.25\n12 atoms,0.125,0.75\n", "x,y"),
    ("a name with a colon", "x:,y:\n0.5,0.25\n0.125,0.75\n", "x:,y:"),
]


@pytest.mark.parametrize(("text", "columns"), [a[1:] for a in ALIKE], ids=[a[0] for a in ALIKE])
def test_what_is_alike_is_read(tmp_path: Path, text: str, columns: str | None) -> None:
    found = np.asarray(load(put(tmp_path, "a.txt", text.encode()), columns=columns))
    assert found.shape == (2, 2)
    assert np.array_equal(found[1], P[1])


LAYOUTS: list[tuple[str, str, str | None, str, str]] = [
    ("a.rps", "<f8", None, r"its floats are of 64 bits.*--raw 'float64,2' reads it", "float64,2"),
    ("a.rps", ">f8", None, r"its floats are of 64 bits.*--raw '>float64,2' reads it", ">float64,2"),
    (
        "a.bin",
        "<f8",
        "float32,2",
        "torus as float64, not as float32: --raw 'float64,2'",
        "float64,2",
    ),
    (
        "a.bin",
        ">f4",
        "float32,2",
        "torus as >float32, not as float32: --raw '>float32,2' reads it",
        ">float32,2",
    ),
    (
        "a.bin",
        "<f4",
        "float64,1",
        "torus as float32, not as float64: --raw 'float32,1' reads it",
        "float32,2",
    ),
]


@pytest.mark.parametrize(("name", "written", "told", "said", "raw"), LAYOUTS)
def test_floats_of_another_type_are_told(
    tmp_path: Path, name: str, written: str, told: str | None, said: str, raw: str
) -> None:
    x = np.random.default_rng(6).random((40, 2)).astype(written)
    path = put(tmp_path, name, x.tobytes())
    with pytest.raises(FormatError, match=said):
        load(path, raw=told)
    assert np.array_equal(load(path, raw=raw), x)


@pytest.mark.parametrize("layout", ["float32", ">float32", "float64", ">float64"])
def test_floats_of_their_own_type_are_read(tmp_path: Path, layout: str) -> None:
    for x in (P, P / 64, P[:1] / 64, np.zeros((1, 2)), np.random.default_rng(7).random((40, 2)) / 200):
        written = x.astype(np.dtype(layout[-7:]).newbyteorder(">" if layout[0] == ">" else "<"))
        path = put(tmp_path, "a.bin", written.tobytes())
        assert np.array_equal(load(path, raw=f"{layout},2"), written)
