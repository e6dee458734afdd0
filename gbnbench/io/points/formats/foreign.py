"""Files that are often at hand and hold no points to be read: each by name, with what to do instead."""

from __future__ import annotations

from gbnbench.io.points.file_format import LEGIBLE
from gbnbench.io.points.formats.numpy_array import UNSAFE
from gbnbench.io.points.point_file import PointFile

_DOTS = (
    "find its dots with an image program (ImageJ's Analyze Particles, skimage.measure.regionprops), write "
    "their centres as text, and give the image's size by --period or --bounds"
)
_TEXT = "export its points as .csv, or save them by numpy as .npy"
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
    (b"<?xml", "an XML file", _TEXT),
    (b"P5\n", "a PGM image", _DOTS),
    (b"P6\n", "a PPM image", _DOTS),
    (b"%PDF", "a PDF document", "export its points as .csv"),
    (b"\x89HDF", "an HDF5 file", _TEXT),
    (b"MATLAB 5.0", "a MATLAB file", "write its points by writematrix(x, 'x.csv')"),
    (b"\xd0\xcf\x11\xe0", "an Excel or Word file", "save the sheet as .csv"),
    (b"PAR1", "a Parquet file", _TEXT),
    (b"ARROW1", "a Feather file", _TEXT),
    (b"SQLite format 3", "an SQLite database", _TEXT),
    (b"\x28\xb5\x2f\xfd", "compressed by zstd", "unpack it first, or pack it by gzip"),
    (b"\x7fELF", "a program", "name a file of points"),
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
    for signature, what, instead in SIGNATURES:
        if head.startswith(signature) and not (len(signature) < 3 and not head.translate(None, LEGIBLE)):
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


def _looks_like_utf16(head: bytes) -> bool:
    """Whether every second byte is zero and the others are legible."""
    even, odd = head[0 : len(head) // 2 * 2 : 2], head[1::2]
    return any(
        len(letters) > 3 and not any(zeros) and not letters.translate(None, LEGIBLE)
        for letters, zeros in ((even, odd), (odd, even))
    )
