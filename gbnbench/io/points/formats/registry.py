"""The formats of point files, in the order in which a file is asked whether it is one of them.

A format is a module here that defines a ``Format``, and its line in ``FORMATS``.
"""

from __future__ import annotations

from pathlib import Path

from gbnbench.core.errors import FormatError
from gbnbench.io.points.file_format import LEGIBLE
from gbnbench.io.points.formats.edat import EDAT
from gbnbench.io.points.formats.eps import EPS
from gbnbench.io.points.formats.foreign import foreign, foreign_text
from gbnbench.io.points.formats.format import Format
from gbnbench.io.points.formats.json_lists import JSON
from gbnbench.io.points.formats.lammps import LAMMPS
from gbnbench.io.points.formats.npy import NPY
from gbnbench.io.points.formats.npz import NPZ
from gbnbench.io.points.formats.ply import PLY
from gbnbench.io.points.formats.rps import RPS
from gbnbench.io.points.formats.text import TEXT
from gbnbench.io.points.formats.xyz import XYZ
from gbnbench.io.points.point_file import PACKED, PointFile

# text last: it takes whatever is legible
FORMATS = (NPY, NPZ, EPS, RPS, PLY, LAMMPS, EDAT, JSON, XYZ, TEXT)
SUFFIXES = tuple(suffix for format_ in FORMATS for suffix in format_.suffixes)
# what point sets of a folder end in; its JSON files mostly tell of the others
FOLDER_SUFFIXES = tuple(suffix for suffix in SUFFIXES if suffix != ".json")


def in_folders(path: Path) -> bool:
    """Whether a file of a folder is taken for a point set: by its suffix, that of a compression apart.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    bool
        False for hidden files too.
    """
    name = path.name.lower()
    packed = next((suffix for suffix in PACKED if name.endswith(suffix)), "")
    return not name.startswith(".") and name.removesuffix(packed).endswith(FOLDER_SUFFIXES)


def format_of(file: PointFile) -> Format:
    """Tell the format of a file.

    Parameters
    ----------
    file : PointFile
        Its first bytes, and its name.

    Returns
    -------
    Format

    Raises
    ------
    FormatError
        If the bytes belong to something that is not a point set.
    """
    path, head = file.path, file.head
    if file.suffix != ".rps" and (said := foreign(file)) is not None:
        raise FormatError(path, said)
    for format_ in FORMATS[:-1]:
        if format_.recognises(file):
            return format_
    if file.suffix in (".npy", ".npz") and head.translate(None, LEGIBLE):
        raise FormatError(path, f"is not a {file.suffix} file: it starts with {head[:6]!r}")
    if TEXT.recognises(file):
        if (said := foreign_text(file)) is not None:
            raise FormatError(path, said)
        return TEXT
    raise FormatError(
        path,
        "is binary, in no format known here; where it is numbers alone, say of what layout, such as "
        "--raw float32,3 (raw= in Python): the type, and how many a point has",
    )
