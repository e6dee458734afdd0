"""Writing point sets: text that keeps every bit, and files that appear whole or not at all."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, cast

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, check_points
from gbnbench.io.points.file_format import reason


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


def _rows(points: FloatArray, separator: str, prefix: str = "") -> str:
    """Lines of the shortest literals that read back to the same bits."""
    return "".join(f"{prefix}{separator.join(map(repr, row))}\n" for row in points.tolist())


def _txt(sets: list[FloatArray]) -> bytes:
    """PSA's count and rows; where d is not 2, the count and the dimension as the GBN authors' programs do."""
    heads = [f"{len(s)}\n" if s.shape[1] == 2 else f"{len(s)} {s.shape[1]}\n" for s in sets]
    return "".join(head + _rows(s, " ") for head, s in zip(heads, sets, strict=True)).encode()


def _dat(sets: list[FloatArray]) -> bytes:
    """UTK's rows, sets parted by a line #."""
    return "#\n".join(_rows(s, "\t") for s in sets).encode()


def _csv(sets: list[FloatArray]) -> bytes:
    """Columns x0, x1, ..., and before them the set's number where there are several."""
    names = ",".join(f"x{a}" for a in range(sets[0].shape[1]))
    if len(sets) == 1:
        return f"{names}\n{_rows(sets[0], ',')}".encode()
    return (f"set,{names}\n" + "".join(_rows(s, ",", f"{k},") for k, s in enumerate(sets))).encode()


def _npy(sets: list[FloatArray]) -> bytes:
    if not _same_size(sets):
        sizes = [len(s) for s in sets][:6]
        raise InputError(f".npy holds sets of one size; got {sizes} points: use .npz, .txt, .dat or .csv")
    file = io.BytesIO()
    np.lib.format.write_array(file, _stack(sets), allow_pickle=False)
    return file.getvalue()


def _npz(sets: list[FloatArray]) -> bytes:
    file = io.BytesIO()
    arrays: dict[str, Any] = (
        {"points": _stack(sets)} if _same_size(sets) else {f"set_{k}": s for k, s in enumerate(sets)}
    )
    np.savez(file, **arrays)
    return file.getvalue()


def _same_size(sets: list[FloatArray]) -> bool:
    return len({len(s) for s in sets}) == 1


def _stack(sets: list[FloatArray]) -> FloatArray:
    return np.stack(sets) if len(sets) > 1 else sets[0]


WRITERS: dict[str, Callable[[list[FloatArray]], bytes]] = {
    ".txt": _txt,
    ".dat": _dat,
    ".csv": _csv,
    ".npy": _npy,
    ".npz": _npz,
}


def encode(path: Path, x: ArrayLike | Sequence[ArrayLike]) -> bytes:
    """Make the bytes of a file of the format that the path's extension names.

    Parameters
    ----------
    path : Path
        Ends in one of ``WRITERS``.
    x : (n, d) or (realizations, n, d) array_like, or a list of (n_i, d)
        Points in [0, 1).

    Returns
    -------
    bytes

    Raises
    ------
    InputError
        If the extension is none of these, or x is not points.
    """
    writer = WRITERS.get(path.suffix.lower())
    if writer is None:
        raise InputError(f"{path}: points are written as {', '.join(WRITERS)}; got extension {path.suffix!r}")
    return writer(checked_sets(x))


def write_atomically(path: Path, data: bytes) -> None:
    """Write a file whole or not at all, and say what is wrong with its place.

    Parameters
    ----------
    path : Path
        A regular file or nothing yet; a link is followed.
    data : bytes
        The whole content.

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
