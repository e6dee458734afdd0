"""Packed files unpacked by Python's own library in one go, for the strict readings."""

from __future__ import annotations

import bz2
import gzip
import lzma
from collections.abc import Callable

from gbnbench.benchmarks.reliability.strict_words import NoPointsError, Sets, known, need

PACKERS: dict[str, Callable[[bytes], bytes]] = {
    ".gz": lambda data: gzip.compress(data, mtime=0),
    ".bz2": bz2.compress,
    ".xz": lzma.compress,
}
_UNPACKERS: dict[str, tuple[bytes, Callable[[bytes], bytes]]] = {
    ".gz": (b"\x1f\x8b", gzip.decompress),
    ".bz2": (b"BZh", bz2.decompress),
    ".xz": (b"\xfd7zXZ\x00", lzma.decompress),
}


def unpacking(packing: str, strict: Callable[[bytes], Sets]) -> Callable[[bytes], Sets]:
    """Make the strict reading of packed files from that of their content.

    Parameters
    ----------
    packing : str
        ``.gz``, ``.bz2`` or ``.xz``.
    strict : callable
        Reads the content.

    Returns
    -------
    callable
        It refuses a damaged or empty file, and leaves one undecided that does not begin as it should.
    """
    magic, unpack = _UNPACKERS[packing]

    def read(data: bytes) -> Sets:
        known(data.startswith(magic))
        try:
            content = unpack(data)
        except Exception:  # whatever is wrong with a packed file
            raise NoPointsError from None
        need(content)
        return strict(content)

    return read
