"""Files of many sets whose parts come one after another; an .npy takes no more memory than one of them."""

from __future__ import annotations

import io
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.io.points.writer import encode, suffix_of, write_atomically

IN_PARTS = ".npy"


def takes_parts(path: Path) -> bool:
    """Whether a file of this name is written part by part; of others all parts are gathered first."""
    return path.suffix.lower() == suffix_of(path) == IN_PARTS


def save_parts(path: Path, shape: tuple[int, int, int], parts: Iterator[FloatArray]) -> None:
    """Write sets, whole or not at all: the same bytes as ``save`` writes of them all together.

    Parameters
    ----------
    path : Path
        The extension names the format.
    shape : (realizations, n, d)
        Of all sets together.
    parts : iterator of (sets, n, d) float64
        All sets in their order; each part is asked for once.

    Raises
    ------
    InputError
        If the extension names no format, or the place cannot be written.
    """
    if takes_parts(path):
        write_atomically(path, _npy(shape if shape[0] > 1 else shape[1:], parts))
    else:
        write_atomically(path, encode(path, np.concatenate(list(parts))))


def _npy(shape: tuple[int, ...], parts: Iterator[FloatArray]) -> Iterator[bytes]:
    """Give the bytes of an .npy, the header first."""
    head = io.BytesIO()
    described = {"descr": np.lib.format.dtype_to_descr(np.dtype(np.float64)), "fortran_order": False}
    np.lib.format.write_array_header_1_0(head, {**described, "shape": shape})
    yield head.getvalue()
    for part in parts:
        yield np.ascontiguousarray(part).tobytes()
