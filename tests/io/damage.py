"""Damage to point-set files: edits of their bytes, and what the reader then says against a strict twin."""

from __future__ import annotations

import struct
from collections.abc import Callable
from pathlib import Path

import numpy as np
from hypothesis import settings
from hypothesis import strategies as st

from gbnbench.benchmarks.reliability.strict_words import NoPointsError, Sets
from gbnbench.core.errors import FormatError
from gbnbench.io.points import read, save

FUZZ = settings(max_examples=350, derandomize=True, deadline=None, database=None)


def written(suffix: str, x: object, folder: Path) -> bytes:
    path = folder / f"seed{suffix}"
    save(path, x)  # type: ignore[arg-type]
    return path.read_bytes()


TOKENS = [
    *(bytes([b]) for b in b"0123456789.,-+eE#% \t\n\r\0x\xff_;:'\"p"),
    *(
        b"nan",
        b"inf",
        b"-1",
        b"1e999",
        b"1e-999",
        b"1_0",
        b"0x1p-1",
        b"one",
        b"x",
        b"set",
        b"\r\n",
        b"\n\n",
        b"\n#\n",
    ),
    *(
        b"1.0",
        b"0",
        b"1",
        b"0.5",
        b"2",
        b"3 2",
        b"1 1",
        b"0 1",
        b"\xef\xbb\xbf",
        b"\xd9\xa1",
        b"\xc2\xa0",
        b"p\n",
    ),
]
# four bytes an edit, drawn at once: hypothesis takes longer to draw than we to read
DAMAGE = st.binary(min_size=4, max_size=12)


def damaged(data: bytes, edits: bytes, binary: bool = False) -> bytes:
    """Insert, overwrite, delete, truncate or double stretches of a file."""
    for high, low, what, how in struct.iter_unpack("4B", edits[: len(edits) // 4 * 4]):
        at = (256 * high + low) * (len(data) + 1) >> 16
        token = bytes([how]) if binary else TOKENS[how % len(TOKENS)]
        if what < 96:
            data = data[:at] + token + data[at + len(token) :]
        elif what < 160:
            data = data[:at] + token + data[at:]
        elif what < 208:
            data = data[:at] + data[at + 1 + how % 13 :]
        elif what < 232:
            data = data[:at]
        else:
            data = data[: at + 1 + how % 13] + data[at:]
    return data


def outcome(path: Path, data: bytes) -> list[np.ndarray] | str:
    """Our reader's sets of a file of these bytes, or its error's text."""
    path.write_bytes(data)
    try:
        return read(path)
    except FormatError as error:
        said = str(error)
    assert said.startswith(str(path))
    assert "\n" not in said
    return said


def verdict(path: Path, data: bytes, twin: Callable[[bytes], Sets]) -> None:
    """Our reader and the twin agree: both refuse, or both read the same sets bit for bit."""
    found = outcome(path, data)
    try:
        expected: Sets | str = twin(data)
    except NoPointsError:
        expected = "no points"
    if isinstance(found, str) or isinstance(expected, str):
        assert isinstance(found, str) == isinstance(expected, str), (data, found, expected)
        return
    assert len(found) == len(expected)
    for x, points in zip(found, expected, strict=True):
        assert x.dtype == np.float64
        assert x.tobytes() == np.array(points).tobytes()
