"""Files that are often at hand and hold no points to be read: each by name, with what to do instead."""

from __future__ import annotations

import re

from gbnbench.io.points.file_format import BYTE_ORDER_MARK, LEGIBLE
from gbnbench.io.points.formats.numpy_array import UNSAFE
from gbnbench.io.points.point_file import PointFile

_DOTS = (
    "find its dots with an image program (ImageJ's Analyze Particles, skimage.measure.regionprops), write "
    "their centres as text, and give the image's size by --period or --bounds"
)
_TEXT = "export its points as .csv, or save them by numpy as .npy"
_VTK = "save its points by numpy.save('points.npy', pyvista.read(FILE).points), or from ParaView as .csv"
_CLOUD = "save it as .ply, as MeshLab, CloudCompare and Open3D do"
_ATOMS = "'ase convert FILE points.extxyz' (pip install ase) writes what is read here, with its box"
_R = "write its points by write.csv(x, 'x.csv', row.names = FALSE)"
_ROWS = "write its points as rows of numbers alone"
VTK = b"<VTKFile"  # behind a line that any XML begins with
JPEG = b"\xff\xd8\xff"
SIGNATURES: tuple[tuple[bytes, str, str], ...] = (
    (b"\x89PNG\r\n\x1a\n", "a PNG image", _DOTS),
    (JPEG, "a JPEG image", _DOTS),
    (b"GIF8", "a GIF image", _DOTS),
    (b"BM", "a BMP image", _DOTS),
    (b"II*\x00", "a TIFF image", _DOTS),
    (b"MM\x00*", "a TIFF image", _DOTS),
    (b"RIFF", "a WebP image", _DOTS),
    (b"<svg", "an SVG drawing", _DOTS),
    (VTK, "a VTK file", _VTK),
    (b"<?xml", "an XML file", _TEXT),
    (b"P5\n", "a PGM image", _DOTS),
    (b"P6\n", "a PPM image", _DOTS),
    (b"%PDF", "a PDF document", "export its points as .csv"),
    (b"\x89HDF", "an HDF5 file", _TEXT),
    (b"MATLAB ", "a MATLAB file", "write its points by writematrix(x, 'x.csv')"),
    (b"\xd0\xcf\x11\xe0", "an Excel or Word file", "save the sheet as .csv"),
    (b"PAR1", "a Parquet file", _TEXT),
    (b"ARROW1", "a Feather file", _TEXT),
    (b"SQLite format 3", "an SQLite database", _TEXT),
    (b"\x28\xb5\x2f\xfd", "compressed by zstd", "unpack it first, or pack it by gzip"),
    (b"\x7fELF", "a program", "name a file of points"),
    (b"# vtk DataFile", "a VTK file", _VTK),
    (b"# .PCD", "a PCD file", _CLOUD),
    (b"LASF", "a LAS file", "save its points by numpy.save('points.npy', laspy.read(FILE).xyz)"),
    (b"Iout", "a selection of ImageJ", "open it there, and save what Analyze > Measure lists as .csv"),
    (b"SIMPLE  =", "a FITS file", _TEXT),
    (b"version https://git-lfs", "a pointer of Git LFS", "fetch the file itself by 'git lfs pull'"),
    (b"CDF\x01", "a NetCDF file", _TEXT),
    (b"CDF\x02", "a NetCDF file", _TEXT),
    (b"CDF\x05", "a NetCDF file", _TEXT),
    (b"FEA1", "a Feather file", _TEXT),
    (b"RDX", "an R data file", _R),
    (b"X\n\x00\x00\x00", "an R data file", _R),
    (b"7z\xbc\xaf\x27\x1c", "a 7-Zip archive", "unpack it first"),
    (b"Rar!", "a RAR archive", "unpack it first"),
)
# what no text of points begins with, or holds; asked last, when nothing else has taken the file
_TEXTS: tuple[tuple[re.Pattern[bytes], str, str], ...] = (
    (re.compile(rb"<"), "an XML or HTML file", _TEXT),
    (re.compile(rb"[CN4S]*T?OFF\s*\n"), "an OFF file", _CLOUD),
    (re.compile(rb"solid\b[^\n]*\n\s*facet\b"), "an STL file", _CLOUD),
    (re.compile(rb"(?:(?:#|(?:o|g|s|mtllib|usemtl) )[^\n]*\n|\s)*v[ \t]+[-+.0-9]"), "an OBJ file", _CLOUD),
    (re.compile(rb"(?:#[^\n]*\n)*VERSION [.0-9]+\s*\nFIELDS "), "a PCD file", _CLOUD),
    (re.compile(rb"(?:[^\n]*\n)*?(?:ATOM  |HETATM)[ 0-9]"), "a PDB file", _ATOMS),
    (re.compile(rb"data_[^\s,;]*\s*\n\s*(?:[_#]|loop_)"), "a CIF file", _ATOMS),
    (re.compile(rb"[^\n]*\n\s*[0-9]+\s*\n\s*[0-9]+[A-Za-z]\w*\s+[A-Za-z]"), "a GROMACS file", _ATOMS),
    (re.compile(rb"(?:[^\n]*\n)*?[ \t]*(?:[Dd]irect|[Cc]artesian)[ \t]*\n"), "a POSCAR of VASP", _ATOMS),
    (
        re.compile(rb"(?:[^\n]*\n)*?[ \t]*[0-9]+[ \t]+atoms[ \t]*\n"),
        "a data file of LAMMPS",
        "'ase convert -i lammps-data FILE points.extxyz' (pip install ase) writes what is read here, "
        "with its box",
    ),
    (re.compile(rb"\$MeshFormat"), "a Gmsh file", _VTK),
    (re.compile(rb"@relation\b", re.IGNORECASE), "an ARFF file", "remove its lines that begin with @"),
    (re.compile(rb"(?:SRID=[0-9]+;)?(?:MULTI)?POINT *Z? *\(", re.IGNORECASE), "well-known text", _ROWS),
    (re.compile(rb"---\s*\n|[A-Za-z_][\w ]*:\s*(?:\[|\n\s*-\s)"), "a YAML file", _ROWS),
    (re.compile(rb"[A-Za-z_]\w*\s*=\s*(?:[\[({]|\n)"), "a program's text", f"{_ROWS}, as .csv"),
)
_PICKLES = (".pkl", ".pickle", ".joblib", ".pt", ".pth")


def foreign(file: PointFile) -> str | None:
    """Say what a file is that cannot hold points to be read here, and what to do; None where it may be any.

    Parameters
    ----------
    file : PointFile
        Its first bytes, and its name.

    Returns
    -------
    str or None
        The rest of an error, after the file's name.
    """
    head = file.head
    pickled = head[:1] == b"\x80" and head[1:2] in b"\x02\x03\x04\x05" and len(head) > 1
    if pickled or file.suffix in _PICKLES:
        return f"is {UNSAFE}; save the points by numpy.save as .npy, or as text"
    if file.suffix == ".mat" and head.translate(None, LEGIBLE) and not head.startswith(b"\x89HDF"):
        head = b"MATLAB " + head  # those of version 4 begin with numbers
    for signature, what, instead in SIGNATURES:
        marked = head.startswith(signature) or (signature == VTK and signature in head[:400])
        if marked and not (len(signature) < 3 and not head.translate(None, LEGIBLE)):
            return f"is {what}, not points: {instead}"
    if head.startswith((b"\xff\xfe\0\0", b"\0\0\xfe\xff")):
        return "is UTF-32 text; save it as UTF-8 or ASCII"
    if head.startswith((b"\xff\xfe", b"\xfe\xff")) and b"\0" in head[2:4]:
        return "is UTF-16 text; save it as UTF-8 or ASCII"
    if head[257:262] == b"ustar":
        return "is a tar archive: unpack it first"
    if _looks_like_utf16(head):
        return "looks like UTF-16 text without a byte-order mark; save it as UTF-8 or ASCII"
    return None


def foreign_text(file: PointFile) -> str | None:
    """Say which program's text a file is, and how its points are had from it; None where it may hold points.

    Parameters
    ----------
    file : PointFile
        A text, columns of which the user may have named, that no format but plain rows and tables has taken.

    Returns
    -------
    str or None
        The rest of an error, after the file's name.
    """
    head = file.head.removeprefix(BYTE_ORDER_MARK).replace(b"\r\n", b"\n").lstrip()
    for pattern, what, instead in _TEXTS if file.options.columns is None else ():
        if pattern.match(head):
            return f"is {what}, not points: {instead}"
    return None


def _looks_like_utf16(head: bytes) -> bool:
    """Whether every second byte is zero and the others are legible."""
    even, odd = head[0 : len(head) // 2 * 2 : 2], head[1::2]
    return any(
        len(letters) > 3 and not any(zeros) and not letters.translate(None, LEGIBLE)
        for letters, zeros in ((even, odd), (odd, even))
    )
