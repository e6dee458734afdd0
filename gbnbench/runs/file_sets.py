"""The sets of a file or a folder, grouped by their n and d, with the checksum of what they were read from."""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from gbnbench.core.errors import FormatError, InputError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points import ReadingOptions, read_sets
from gbnbench.io.points.formats.registry import FOLDER_SUFFIXES, in_folders


@dataclass(frozen=True)
class FileSets:
    """Sets of one n and d.

    Attributes
    ----------
    sets : (realizations, n, d) float64
        In the order of their files.
    digest : str
        SHA-256 of the contents of their files and of how they are read.
    sides : tuple of float or None
        Sides of the box in the files' unit; None where they tell none.
    toroidal : bool or None
        Whether the box is a torus, where the files or the user say so.
    """

    sets: FloatArray
    digest: str
    sides: tuple[float, ...] | None
    toroidal: bool | None


def read_groups(path: Path, reading: ReadingOptions) -> list[FileSets]:
    """Read the sets of a file or folder.

    Parameters
    ----------
    path : Path
        Of a folder, every file with the suffix of a format, in natural order of their names.
    reading : ReadingOptions
        How they are read.

    Returns
    -------
    list of FileSets
        One for each (n, d).

    Raises
    ------
    InputError
        If a folder holds no point sets, or a file cannot be read.
    FormatError
        If files of one n and d tell of different boxes.
    """
    files = files_of(path)
    groups: dict[tuple[int, int], list[FloatArray]] = {}
    digests: dict[tuple[int, int], list[str]] = {}
    boxes: dict[tuple[int, int], tuple[tuple[float, ...] | None, bool | None]] = {}
    for file in files:
        digest = checksum(file)
        found = read_sets(file, reading)
        for x in found.sets:
            shape = (x.shape[0], x.shape[1])
            groups.setdefault(shape, []).append(x)
            digests.setdefault(shape, []).append(digest)
            if boxes.setdefault(shape, (found.sides, found.toroidal)) != (found.sides, found.toroidal):
                raise FormatError(file, f"its box is not that of the files before: {_box(*boxes[shape])}")
    return [
        FileSets(np.stack(sets), joint_checksum(digests[shape], reading), *boxes[shape])
        for shape, sets in groups.items()
    ]


def files_of(path: Path) -> list[Path]:
    """List the files that hold the sets of a path.

    Parameters
    ----------
    path : Path
        A file, which need not exist, or a folder.

    Returns
    -------
    list of Path
        Of a folder, every file with the suffix of a format, in natural order of their names.

    Raises
    ------
    InputError
        If a folder holds no point sets.
    """
    if not path.is_dir():
        return [path]
    files = sorted(
        (f for f in path.iterdir() if f.is_file() and in_folders(f)),
        key=lambda f: [(part.isdigit(), int(part) if part.isdigit() else 0, part)
                       for part in re.split(r"(\d+)", f.name)],
    )  # fmt: skip
    if not files:
        raise InputError(f"{path} holds no point sets; files are known by {', '.join(FOLDER_SUFFIXES)}")
    return files


def joint_checksum(digests: Sequence[str], reading: ReadingOptions) -> str:
    """Sum up what sets were read from, and how.

    Parameters
    ----------
    digests : sequence of str
        Checksums of the files, one a set.
    reading : ReadingOptions
        How they were read.

    Returns
    -------
    str
        SHA-256.
    """
    said = reading.record()
    return hashlib.sha256(("".join(digests) + (json.dumps(said) if said else "")).encode()).hexdigest()


def _box(sides: tuple[float, ...] | None, toroidal: bool | None) -> str:
    """Describe a box in an error."""
    size = "the unit torus" if sides is None else "sides " + " x ".join(f"{side:g}" for side in sides)
    return f"{size}, no torus" if toroidal is False else size


def checksum(path: Path) -> str:
    """SHA-256 of the content of a file."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()
