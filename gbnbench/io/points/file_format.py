"""First looks at a file: whether it can be read at all, how large it is, and how it begins."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from gbnbench.core.errors import FormatError, InputError

LIMIT_VARIABLE = "GBNBENCH_MAX_FILE_BYTES"
DEFAULT_LIMIT = 2_000_000_000

NUMERIC = b"0123456789+-.eE"
HEAD = 4096
BYTE_ORDER_MARK = b"\xef\xbb\xbf"
LEGIBLE = bytes(range(32, 127)) + b"\t\n\r\f\v" + bytes(range(128, 256))


def size_limit(max_bytes: int | None = None) -> int:
    """Return the bytes that a file has to stay below: the argument, else the environment variable, else 2 GB.

    Raises
    ------
    InputError
        If the environment variable is not a positive whole number.
    """
    if max_bytes is not None:
        return max_bytes
    text = os.environ.get(LIMIT_VARIABLE, "")
    if not text:
        return DEFAULT_LIMIT
    if not (text.isascii() and text.isdigit() and 0 < len(text) <= 18 and int(text) > 0):
        raise InputError(f"{LIMIT_VARIABLE} must be a positive whole number of bytes; got {text!r}")
    return int(text)


def readable(size: float) -> str:
    """Write a number of bytes in words, such as 2.15 GB."""
    for unit in ("bytes", "kB", "MB"):
        if size < 1000:
            return f"{size:.4g} {unit}"
        size /= 1000
    return f"{size:.4g} GB"


def refuse_large(path: Path, size: int, limit: int, what: str = "the file holds") -> None:
    """Raise FormatError where a size is not below the limit.

    Parameters
    ----------
    path : Path
        Named in the error.
    size, limit : int
        Bytes.
    what : str
        What has the size, for the error.
    """
    if size >= limit:
        raise FormatError(
            path,
            f"{what} {readable(size)}, and {readable(limit)} or more are refused; "
            f"split it, or set {LIMIT_VARIABLE} to a larger number of bytes",
        )


def without_marks(data: bytes) -> bytes:
    """Drop the byte-order mark of UTF-8 in front of a text; joining files can leave it there twice."""
    while data.startswith(BYTE_ORDER_MARK):
        data = data[len(BYTE_ORDER_MARK) :]
    return data


def reason(error: Exception) -> str:
    """Return the reason of the operating system in its own words, without the path that it repeats."""
    text = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return text[:1].lower() + text[1:]


def _mistaken(path: Path) -> str:
    """Say what a name that is no file's may be meant for: standard input, or a number of a list."""
    if str(path) == "-":
        return "; standard input is not read: name a file"
    is_number = not str(path).translate(str.maketrans("", "", "0123456789.,"))
    return "; numbers of one option are parted by commas alone, such as 512,512" if is_number else ""


def look(path: Path, limit: int) -> tuple[int, bytes]:
    """Return the size and the first bytes of a regular file that is within the limit.

    Parameters
    ----------
    path : Path
        The file.
    limit : int
        Bytes that it has to stay below.

    Returns
    -------
    size : int
        Bytes.
    head : bytes
        At most the first 4,096 of them.

    Raises
    ------
    FormatError
        If there is no such file, it is a folder or a device, cannot be read, is empty, or is too large.
    """
    try:
        status = path.stat()
        if stat.S_ISDIR(status.st_mode):
            raise FormatError(path, "is a folder; name a file in it (gbnbench compare takes whole folders)")
        if not stat.S_ISREG(status.st_mode):
            raise FormatError(path, "is not a regular file; write the points to a file first")
        refuse_large(path, status.st_size, limit)
        with path.open("rb") as file:
            head = file.read(HEAD)
    except FormatError:
        raise
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        raise FormatError(path, f"cannot be read: {reason(error)}{_mistaken(path)}") from None
    if not head:
        raise FormatError(path, "the file is empty")
    return status.st_size, head
