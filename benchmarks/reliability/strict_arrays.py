"""Strict readings of binary arrays, .rps, .npy and .npz, in plain Python, apart from our readers."""

from __future__ import annotations

import ast
import io
import re
import struct
import zipfile

import numpy as np

from gbnbench.benchmarks.reliability.strict_words import (
    NoPointsError,
    Sets,
    UndecidedError,
    known,
    need,
    read_point,
)


def strict_rps(data: bytes) -> Sets:
    """Read pairs of floats, lowest byte first."""
    need(data and len(data) % 8 == 0 and (any(data) or len(data) == 8))
    values = struct.unpack(f"<{len(data) // 4}f", data)
    return [[read_point([repr(a), repr(b)], 2) for a, b in zip(values[::2], values[1::2], strict=True)]]


def strict_npy(data: bytes) -> Sets:
    """Read an array of floats, of shape (n, d) or (sets, n, d)."""
    need(data[:6] == b"\x93NUMPY" and data[6:8] in (b"\1\0", b"\2\0", b"\3\0"))
    wide = data[6] > 1
    start = 12 if wide else 10
    need(len(data) >= start)
    (length,) = struct.unpack("<I" if wide else "<H", data[8:start])
    try:
        header = ast.literal_eval(data[start : start + length].decode("latin-1").strip())
        need(set(header) == {"descr", "fortran_order", "shape"})
        kind = re.fullmatch(r"([<>=|]?)(f0*[248]|[efd])", header["descr"])
        need(isinstance(header["fortran_order"], bool) and not header["fortran_order"])
    except (ValueError, SyntaxError, TypeError, AttributeError):
        raise NoPointsError from None
    if kind is None:
        raise NoPointsError
    shape, body = header["shape"], data[start + length :]
    need(isinstance(shape, tuple) and len(shape) in (2, 3))
    need(all(type(s) is int and s > 0 for s in shape))
    count = int(np.prod(shape))
    code = {"2": "e", "4": "f", "8": "d"}.get(kind[2][-1], kind[2])
    need(len(body) == count * struct.calcsize(f"={code}"))
    order = ">" if kind[1] == ">" else "<"
    values = struct.unpack(f"{order}{count}{code}", body)
    d = shape[-1]
    points = [read_point([repr(v) for v in values[i : i + d]], d) for i in range(0, count, d)]
    n = shape[-2]
    return [points[i : i + n] for i in range(0, len(points), n)]


def strict_npz(data: bytes) -> Sets:
    """Read an archive whose arrays are one, or ``points``, or numbered sets, as numpy packs them."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            names = archive.namelist()
            known(all(name.endswith(".npy") for name in names) and len({*names}) == len(names))
            known(all(info.flag_bits == 0 for info in archive.infolist()))
            taken = ["points.npy"] if "points.npy" in names else names
            members = {name.removesuffix(".npy"): archive.read(name) for name in taken}
    except UndecidedError:
        raise
    except Exception:  # whatever is wrong with an archive
        raise NoPointsError from None
    if len(members) == 1:
        (member,) = members.values()
        return strict_npy(member)
    known(list(members) == [f"set_{k}" for k in range(len(members))])
    return [one for member in members.values() for one in strict_npy(member)]
