"""Strict readers of .rps, PSA's .eps and .npy: plain Python that shares no code with gbnbench.io.points."""

from __future__ import annotations

import ast
import re
import struct

import numpy as np

from tests.oracles.text_points import DECIMAL, NoPointsError, PointLists, need, twin_point


def twin_rps(data: bytes) -> PointLists:
    need(data and len(data) % 8 == 0 and (any(data) or len(data) == 8))
    values = struct.unpack(f"<{len(data) // 4}f", data)
    return [[twin_point([repr(a), repr(b)], 2) for a, b in zip(values[::2], values[1::2], strict=True)]]


def twin_eps(data: bytes) -> PointLists:
    """Every line of the body is a point; the frame around it is that of PSA's own files."""
    lines = [line.strip(" \t\v\f") for line in re.split("\r\n|\r|\n", data.decode("latin-1"))]
    body = [line for line in lines if re.search(r"(^|\s)p$", line, re.ASCII)]
    points = []
    for line in body:
        match = re.fullmatch(rf"({DECIMAL})\s+({DECIMAL})\s+p", line, re.ASCII)
        need(match)
        assert match is not None
        points.append(twin_point([match[1], match[4]], 2))
    need(points)
    start, stop = lines.index(body[0]), len(lines) - lines[::-1].index(body[-1])
    need(all(line in body or not line or line[0] == "%" for line in lines[start:stop]))
    setup = r"%.*|/.*|(.*\s)?(def|bind|gsave|save|scale|translate|newpath|set(gray|rgbcolor|linewidth))|"
    need(all(re.fullmatch(setup, line, re.DOTALL | re.ASCII) for line in lines[:start]))
    need(
        all(
            re.fullmatch(r"%.*|((grestore|restore|showpage|stroke|fill|end)(\s+|$))*", line, re.ASCII)
            for line in lines[stop:]
        )
    )
    closed = any(line and line[0] != "%" for line in lines[stop:])
    opened = any("gsave" in line.split() for line in lines[:start] if line[:1] != "%")
    need(closed or not opened)
    return [points]


def twin_npy(data: bytes) -> PointLists:
    need(data[:6] == b"\x93NUMPY" and data[6:8] in (b"\1\0", b"\2\0", b"\3\0"))
    wide = data[6] > 1
    start = 12 if wide else 10
    need(len(data) >= start)
    (length,) = struct.unpack("<I" if wide else "<H", data[8:start])
    try:
        header = ast.literal_eval(data[start : start + length].decode("latin-1").strip())
        need(set(header) == {"descr", "fortran_order", "shape"})
        kind = re.fullmatch(r"([<>=|]?)f([248])", header["descr"])
        need(kind and isinstance(header["fortran_order"], bool) and not header["fortran_order"])
    except (ValueError, SyntaxError, TypeError, AttributeError):
        raise NoPointsError from None
    shape, body = header["shape"], data[start + length :]
    assert kind is not None
    need(isinstance(shape, tuple) and len(shape) in (2, 3))
    need(all(type(s) is int and s > 0 for s in shape))
    count = int(np.prod(shape))
    need(len(body) == count * int(kind[2]))
    order = ">" if kind[1] == ">" else "<"
    values = struct.unpack(f"{order}{count}{ {'2': 'e', '4': 'f', '8': 'd'}[kind[2]] }", body)
    d = shape[-1]
    points = [twin_point([repr(v) for v in values[i : i + d]], d) for i in range(0, count, d)]
    n = shape[-2]
    return [points[i : i + n] for i in range(0, len(points), n)]
