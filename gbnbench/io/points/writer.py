"""Writing point sets: the bytes of a file by its suffix, and files that appear whole or not at all."""

from __future__ import annotations

import bz2
import gzip
import lzma
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import cast

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, check_points
from gbnbench.io.points.file_format import reason
from gbnbench.io.points.formats.registry import FORMATS
from gbnbench.io.points.point_sets import PointSets, unequal_sides

# text first, for whoever reads the list
WRITTEN = {suffix: format_ for format_ in (FORMATS[-1], *FORMATS) for suffix in format_.write}

_PACKERS: dict[str, Callable[[bytes], bytes]] = {
    ".gz": lambda data: gzip.compress(data, mtime=0),
    ".bz2": bz2.compress,
    ".xz": lzma.compress,
}


def checked_sets(x: ArrayLike | Sequence[ArrayLike]) -> list[FloatArray]:
    """Check points and split them into sets.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) array_like, or a list of (n_i, d)
        Points in [0, 1).

    Returns
    -------
    list of (n_i, d) float64

    Raises
    ------
    InputError
        If a set breaks the rules of ``check_points``, or their dimensions differ.
    """
    if isinstance(x, (list, tuple)) and len({s.shape for s in x if isinstance(s, np.ndarray)}) > 1:
        sets = [check_points(s) for s in x]
        if any(s.ndim != 2 for s in sets) or len({s.shape[1] for s in sets}) > 1:
            raise InputError(f"x must be sets (n, d) of one d; got shapes {[s.shape for s in sets][:6]}")
        return sets
    points = check_points(cast("ArrayLike", x))
    return list(points) if points.ndim == 3 else [points]


def encode(path: Path, x: ArrayLike | Sequence[ArrayLike] | PointSets) -> bytes:
    """Make the bytes of a file of the format that the path's extension names.

    Parameters
    ----------
    path : Path
        Ends in one of ``WRITTEN``, or in one of them and .gz, .bz2 or .xz.
    x : (n, d) or (realizations, n, d) array_like, a list of (n_i, d), or PointSets
        Points in [0, 1); PointSets have a box too, in whose unit they are written where the format holds it.

    Returns
    -------
    bytes

    Raises
    ------
    InputError
        If the extension is none of these, x is not points, or the format cannot hold them.
    """
    check_suffix(path)
    suffix, pack = suffix_of(path), _PACKERS.get(path.suffix.lower(), bytes)
    format_ = WRITTEN[suffix]
    given = x if isinstance(x, PointSets) else PointSets(checked_sets(x))
    if (lost := lost_box(path, given)) is not None:
        raise InputError(f"{path}: {lost}")
    try:
        return pack(format_.write[suffix](given if format_.keeps_box else PointSets(given.sets)))
    except InputError as error:
        raise InputError(f"{path}: {error}") from None


def lost_box(path: Path, x: PointSets) -> str | None:
    """Say what of the box a file of this name could not hold and measures need, or return None.

    Parameters
    ----------
    path : Path
        Its suffix names the format.
    x : PointSets
        Sets with their box.

    Returns
    -------
    str or None
        A sentence for an error; a cube that is a torus, or not told to be none, is the unit torus in another
        unit and loses nothing that is measured.
    """
    check_suffix(path)
    format_ = WRITTEN[suffix_of(path)]
    if format_.keeps_box:
        return None
    keepers = ", ".join(dict.fromkeys(suffix for suffix, other in WRITTEN.items() if other.keeps_box))
    if x.sides is not None and unequal_sides(x.sides):
        sides = " x ".join(f"{side:g}" for side in x.sides)
        return f"{format_.name} cannot hold a box of unequal sides, {sides}; {keepers} do"
    if x.toroidal is False:
        return f"{format_.name} cannot say that the box is no torus; {keepers} do"
    return None


def suffix_of(path: Path) -> str:
    """Return the suffix that names the format of a file, in lower case, without that of a compression."""
    suffix = path.suffix.lower()
    return Path(path.stem).suffix.lower() if suffix in _PACKERS else suffix


def check_suffix(path: Path) -> None:
    """Refuse a file whose format is not written.

    Parameters
    ----------
    path : Path
        The file.

    Raises
    ------
    InputError
        If its suffix is none of ``WRITTEN``.
    """
    if suffix_of(path) not in WRITTEN:
        known = ", ".join(WRITTEN)
        raise InputError(f"{path}: points are written as {known}; got extension {suffix_of(path)!r}")


def write_atomically(path: Path, data: bytes | Iterable[bytes]) -> None:
    """Write a file whole or not at all, and say what is wrong with its place.

    Parameters
    ----------
    path : Path
        A regular file or nothing yet; a link is followed.
    data : bytes or iterable of bytes
        The whole content, or its parts in turn.

    Raises
    ------
    InputError
        If the place cannot be written or is no regular file; nothing is left behind, and a file that was
        there stays as it was.
    """
    try:
        target = path.resolve()
        if target.exists() and not target.is_file():
            raise InputError(
                f"cannot write {path}: it is {'a folder' if target.is_dir() else 'no regular file'}"
            )
        write_whole(target, data, make_folder=False)
    except InputError:
        raise
    except (OSError, ValueError, RuntimeError) as error:  # a NUL in the name; before 3.13 a loop of links
        raise InputError(f"cannot write {path}: {reason(error)}") from None
