"""A file on its way to be read: its bytes, unpacked where it is compressed, and what the user said of it."""

from __future__ import annotations

import bz2
import gzip
import io
import lzma
import mmap
import re
import zlib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import IO

from gbnbench.core.errors import FormatError
from gbnbench.io.points.file_format import HEAD, look, readable, reason
from gbnbench.io.points.options import ReadingOptions

# magic bytes, suffix and opener of each compression that Python's own library unpacks
_Packed = gzip.GzipFile | bz2.BZ2File | lzma.LZMAFile
_COMPRESSIONS: tuple[tuple[bytes, str, Callable[[Path], _Packed]], ...] = (
    (b"\x1f\x8b", ".gz", gzip.GzipFile),
    (b"BZh", ".bz2", bz2.BZ2File),
    (b"\xfd7zXZ\x00", ".xz", lzma.LZMAFile),
)
PACKED = tuple(suffix for _, suffix, _ in _COMPRESSIONS)
# longer, since numbers without a header can begin with any two bytes
_RAW_PACKED = re.compile(rb"\x1f\x8b\x08|BZh[1-9]1AY&SY|\xfd7zXZ\x00")
_BROKEN = (OSError, EOFError, zlib.error, lzma.LZMAError, ValueError)
_PIECE = 1 << 24
MAPPED_FROM = 1 << 26  # bytes of numbers that are mapped into memory, not read


@dataclass(frozen=True)
class PointFile:
    """A file of points.

    Attributes
    ----------
    path : Path
        Named in errors.
    suffix : str
        Of its name in lower case, without that of a compression: ``.csv`` of ``a.csv.gz``.
    size : int
        Bytes, unpacked.
    head : bytes
        At most the first 4,096 of them.
    limit : int
        Bytes from which on a file is refused.
    options : ReadingOptions
        What the user said of it.
    unpacked : bytes or None
        The whole content where it was compressed.
    """

    path: Path
    suffix: str
    size: int
    head: bytes
    limit: int
    options: ReadingOptions
    unpacked: bytes | None = None

    def open(self) -> IO[bytes]:
        """Open the content for reading.

        Raises
        ------
        FormatError
            If the file cannot be opened.
        """
        if self.unpacked is not None:
            return io.BytesIO(self.unpacked)
        try:
            return self.path.open("rb")
        except OSError as error:
            raise FormatError(self.path, f"cannot be read: {reason(error)}") from None

    def read(self) -> bytes:
        """Return the whole content.

        Raises
        ------
        FormatError
            If the file cannot be read.
        """
        if self.unpacked is not None:
            return self.unpacked
        try:
            return self.path.read_bytes()
        except OSError as error:
            raise FormatError(self.path, f"cannot be read: {reason(error)}") from None

    def numbers(self) -> bytes | memoryview:
        """Return the whole content for numpy: of a large file mapped, so that it is read as it is needed.

        What is written to a mapped content does not change the file.

        Raises
        ------
        FormatError
            If the file cannot be read.
        """
        if self.unpacked is not None or self.size < MAPPED_FROM:
            return self.read()
        with self.open() as file:
            return memoryview(mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_COPY))


def open_point_file(path: Path, limit: int, options: ReadingOptions) -> PointFile:
    """Look at a file, and unpack it where it is compressed by gzip, bzip2 or xz.

    Parameters
    ----------
    path : Path
        The file.
    limit : int
        Bytes that it has to stay below, unpacked too.
    options : ReadingOptions
        What the user said of it.

    Returns
    -------
    PointFile

    Raises
    ------
    FormatError
        If there is no such file, it is empty or too large, or its compression is damaged.
    """
    size, head = look(path, limit)
    suffix = path.suffix.lower()
    for magic, packed, opener in _COMPRESSIONS:
        if head.startswith(magic) and (options.raw is None or _RAW_PACKED.match(head)):
            data = _unpack(path, opener, limit)
            if any(data.startswith(again) for again, _, _ in _COMPRESSIONS) and options.raw is None:
                raise FormatError(path, "is packed twice: unpack it once")
            inner = Path(path.stem).suffix.lower() if suffix == packed else suffix
            return PointFile(path, inner, len(data), data[:HEAD], limit, options, data)
    return PointFile(path, suffix, size, head, limit, options)


def _unpack(path: Path, opener: Callable[[Path], _Packed], limit: int) -> bytes:
    data = bytearray()
    try:
        with opener(path) as file:
            while piece := file.read(_PIECE):
                data += piece
                if len(data) >= limit:
                    said = f"unpacked, it holds {readable(limit)} or more, which are refused; split it"
                    raise FormatError(path, said)
    except FormatError:
        raise
    except _BROKEN as error:
        raise FormatError(path, f"its compression is damaged: {reason(error)}") from None
    if not data:
        raise FormatError(path, "the file is empty")
    return bytes(data)
