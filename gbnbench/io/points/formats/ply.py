"""PLY: the vertices of a polygon file, in text or binary of either byte order (Turk 1994); one set."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import FormatError, InputError
from gbnbench.io.points.columns import choose
from gbnbench.io.points.formats.axes import DIMENSION, XYZ, is_plane, refuse_plane
from gbnbench.io.points.formats.format import Format
from gbnbench.io.points.literals import shown
from gbnbench.io.points.point_file import PointFile
from gbnbench.io.points.point_sets import Coordinates, FileContent, PointSets
from gbnbench.io.points.text_lines import numbers_of

_TYPES = {
    "char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4",
    "double": "f8", "int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4",
    "float32": "f4", "float64": "f8",
}  # fmt: skip
_ORDERS = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}
_END = re.compile(rb"(?:^|\n|\r)end_header[ \t]*(\r\n|\n|\r)")
_SPATIAL = re.compile(rb"[\n\r]comment %b 3[ \t]*[\n\r]" % DIMENSION.encode())
_MOST_HEADER = 1 << 20


@dataclass
class _Element:
    """A kind of record: how many there are, and the types of its properties, None for a list."""

    name: str
    count: int
    properties: dict[str, str | None] = field(default_factory=dict)


def _recognises(file: PointFile) -> bool:
    return file.head.startswith((b"ply\n", b"ply\r"))


def _read(file: PointFile) -> FileContent:
    path, data = file.path, file.read()
    end = _END.search(data, 0, _MOST_HEADER)
    if end is None:
        raise FormatError(path, "a PLY file without end_header: truncated or damaged")
    order, elements, header = _header(path, data[: end.end()])
    at = next((k for k, element in enumerate(elements) if element.name == "vertex"), None)
    if at is None:
        raise FormatError(path, "a PLY file without element vertex: it holds no points")
    vertex, last = elements[at], at == len(elements) - 1
    if vertex.count < 1:
        raise FormatError(path, "element vertex 0: it holds no points")
    for element in elements[: at + 1]:
        if None in element.properties.values() and (element is vertex or order):
            said = f"lists in its element {element.name} are not read: write x, y, z of the vertices alone"
            raise FormatError(path, said)
    names = tuple(vertex.properties)
    there = tuple(name for name in XYZ if name in names)
    if there != XYZ[: len(there)] or not there:
        raise FormatError(path, f"its vertices have no x, y, z, but {', '.join(names) or 'no properties'}")
    columns = file.options.columns
    kept = (
        [names.index(name) for name in there] if columns is None else choose(path, columns, names, len(names))
    )
    if order:
        table = _binary(path, data[end.end() :], order, elements[: at + 1], last)
        points = np.stack([table[names[k]] for k in kept], axis=-1)
        with np.errstate(invalid="ignore"):  # signalling nan
            found = Coordinates(points.astype(np.float64))
    else:
        before = sum(element.count for element in elements[:at])
        found = _text(path, data[end.end() :], header, before, vertex, kept, last)
    if not _SPATIAL.search(data, 0, end.end()):
        refuse_plane(path, found.points, columns)
    return FileContent([found])


def _header(path: Path, head: bytes) -> tuple[str, list[_Element], int]:
    """Return the byte order ("" for text), the elements, and the number of lines."""
    lines = re.split(rb"\r\n|\n|\r", head)[:-1]
    order: str | None = None
    elements: list[_Element] = []
    for number, line in enumerate(lines[1:-1], start=2):
        words = line.decode("utf-8", "backslashreplace").split()
        match words:
            case [] | ["comment" | "obj_info", *_]:
                pass
            case ["format", kind, "1.0"] if kind in _ORDERS and order is None:
                order = _ORDERS[kind]
            case ["element", name, count] if count.isascii() and count.isdigit() and len(count) < 16:
                elements.append(_Element(name, int(count)))
            case ["property", "list", *_, name] if elements and len(words) == 5:
                elements[-1].properties[name] = None
            case ["property", kind, name] if (
                elements and kind in _TYPES and name not in elements[-1].properties
            ):
                elements[-1].properties[name] = _TYPES[kind]
            case _:
                raise FormatError(path, f"{shown(line)} is no line of a PLY header", number)
    if order is None:
        raise FormatError(path, "a PLY file that does not say its format")
    return order, elements, len(lines)


def _binary(path: Path, body: bytes, order: str, elements: list[_Element], last: bool) -> NDArray[Any]:
    """Read the vertices, the last of these elements."""
    types = [np.dtype([(name, f"{order}{kind}") for name, kind in e.properties.items()]) for e in elements]
    begin = sum(e.count * t.itemsize for e, t in zip(elements[:-1], types[:-1], strict=True))
    vertex, dtype = elements[-1], types[-1]
    need = begin + vertex.count * dtype.itemsize
    if len(body) < need or (last and len(body) > need):
        said = f"{vertex.count} vertices need {need} bytes after the header, and {len(body)} are there"
        raise FormatError(path, f"{said}: truncated or damaged")
    return np.frombuffer(body, dtype, vertex.count, begin)


def _text(
    path: Path, body: bytes, header: int, before: int, vertex: _Element, kept: list[int], last: bool
) -> Coordinates:  # fmt: skip
    lines = re.split(rb"\r\n|\n|\r", body.rstrip())
    rows = lines[before : before + vertex.count]
    if len(rows) < vertex.count or not body.strip():
        here = len(rows) if body.strip() else 0
        raise FormatError(path, f"the header says {vertex.count} vertices, and the file ends after {here}")
    if last and len(lines) > before + vertex.count:
        line = header + before + vertex.count + 1
        raise FormatError(path, f"the header says {vertex.count} vertices, and here is another", line)
    first = header + before + 1
    points = []
    for line, row in enumerate(rows, start=first):
        tokens = row.split()
        if len(tokens) != len(vertex.properties):
            said = f"{len(tokens)} numbers where a vertex has {len(vertex.properties)}"
            raise FormatError(path, said, line)
        points.append(numbers_of(path, [tokens[k] for k in kept], line))
    return Coordinates(np.array(points), np.arange(first, first + len(points)))


def _write(x: PointSets) -> bytes:
    d = x.sets[0].shape[1]
    if len(x.sets) > 1:
        raise InputError(f"a PLY file holds one set; got {len(x.sets)}")
    if d > 3:
        raise InputError(f"a PLY file holds points of at most three dimensions; got d={d}")
    head = [
        "ply", "format ascii 1.0", *[f"comment {DIMENSION} 3"] * is_plane(x.sets[0]),
        f"element vertex {len(x.sets[0])}",
        *(f"property double {name}" for name in XYZ[:d]), "end_header",
    ]  # fmt: skip
    rows = [" ".join(map(repr, row)) for row in x.sets[0].tolist()]
    return ("\n".join(head + rows) + "\n").encode()


PLY = Format("PLY", (".ply",), _recognises, _read, {".ply": _write}, frozenset({"columns"}))
