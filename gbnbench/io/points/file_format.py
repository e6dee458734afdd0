"""The format of a file, decided by its first bytes, and by its name only where bytes cannot tell."""

from __future__ import annotations

import os
import stat
from pathlib import Path

from gbnbench.core.errors import FormatError, InputError

LIMIT_VARIABLE = "GBNBENCH_MAX_FILE_BYTES"
DEFAULT_LIMIT = 2_000_000_000

NUMERIC = b"0123456789+-.eE"
# A headerless binary file without the .rps name is believed from this many points on: a byte string drawn at
# random passes for floats of [0, 1] with odds of 4**-2 a point.
SURE_POINTS = 16

_HEAD = 4096
_LEGIBLE = bytes(range(32, 127)) + b"\t\n\r\f\v" + bytes(range(128, 256))


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


def reason(error: Exception) -> str:
    """Return the reason of the operating system in its own words, without the path that it repeats."""
    text = error.strerror if isinstance(error, OSError) and error.strerror else str(error)
    return text[:1].lower() + text[1:]


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
            head = file.read(_HEAD)
    except FormatError:
        raise
    except (OSError, ValueError) as error:  # ValueError: a NUL in the name
        raise FormatError(path, f"cannot be read: {reason(error)}") from None
    if not head:
        raise FormatError(path, "the file is empty")
    return status.st_size, head


def kind(path: Path, size: int, head: bytes) -> str:
    """Name the format of a file.

    Parameters
    ----------
    path : Path
        The file.
    size : int
        Its bytes.
    head : bytes
        The first of them.

    Returns
    -------
    {"npy", "npz", "eps", "rps", "text"}

    Raises
    ------
    FormatError
        If the bytes belong to something that is not a point set.
    """
    name = path.suffix.lower()
    if head.startswith(b"\x93NUMPY"):
        return "npy"
    if head.startswith((b"PK\x03\x04", b"PK\x05\x06")):
        return "npz"
    if head.startswith((b"%!", b"\xef\xbb\xbf%!")):
        return "eps"
    if name == ".rps":  # bytes of floats can look like anything, so only what is all numbers is text
        return "text" if not head.translate(None, NUMERIC + b" \t\r\n,#") else "rps"
    if name == ".eps" and not head.translate(None, _LEGIBLE):
        return "eps"
    if head.startswith((b"\xff\xfe", b"\xfe\xff")) and b"\0" in head[2:4]:
        raise FormatError(path, "is UTF-16 text; save it as UTF-8 or ASCII")
    if head.startswith((b"\x1f\x8b", b"BZh", b"\xfd7zXZ", b"\x28\xb5\x2f\xfd")):
        raise FormatError(path, "is compressed; unpack it first")
    if name in (".npy", ".npz"):
        if not head.translate(None, _LEGIBLE):
            return "text"
        raise FormatError(path, f"is not a {name} file: it starts with {head[:6]!r}")
    if 20 * len(head.translate(None, _LEGIBLE)) < len(head):  # a stray byte is better named by its line
        return "text"
    if size % 8 == 0 and size >= 8 * SURE_POINTS:
        return "rps"
    raise FormatError(
        path,
        "is binary, in no format known here (.npy, .npz, .rps); "
        "little-endian float32 pairs are read where the name ends in .rps",
    )
