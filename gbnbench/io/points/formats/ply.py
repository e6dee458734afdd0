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
    """A kind of record: how many there are, and types of its properties, two for a list: length and items."""

    name: str
    count: int
    properties: dict[str, str | tuple[str, str]] = field(default_factory=dict)

    def has_lists(self) -> bool:
        """Whether its records differ in length."""
        return any(isinstance(kind, tuple) for kind in self.properties.values())

    def dtype(self, order: str) -> np.dtype[Any]:
        """Return the type of a record without lists."""
        return np.dtype([(name, f"{order}{kind}") for name, kind in self.properties.items()])


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
    vertex = elements[at]
    if vertex.count < 1:
        raise FormatError(path, "element vertex 0: it holds no points")
    if vertex.has_lists():
        raise FormatError(
            path, "lists in its element vertex are not read: write x, y, z of the vertices alone"
        )
    names = tuple(vertex.properties)
    there = tuple(name for name in XYZ if name in names)
    if there != XYZ[: len(there)] or not there:
        raise FormatError(path, f"its vertices have no x, y, z, but {', '.join(names) or 'no properties'}")
    columns = file.options.columns
    kept = (
        [names.index(name) for name in there] if columns is None else choose(path, columns, names, len(names))
    )
    if order:
        table = _binary(path, data[end.end() :], order, elements, vertex)
        points = np.stack([table[names[k]] for k in kept], axis=-1)
        with np.errstate(invalid="ignore"):  # signalling nan
            found = Coordinates(points.astype(np.float64))
    else:
        before = sum(element.count for element in elements[:at])
        found = _text(
            path, data[end.end() :], header, before, vertex, kept, sum(element.count for element in elements)
        )
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
            case ["property", "list", length, kind, name] if (
                elements and length in _TYPES and kind in _TYPES and name not in elements[-1].properties
            ):
                elements[-1].properties[name] = _TYPES[length], _TYPES[kind]
            case ["property", kind, name] if (
                elements and kind in _TYPES and name not in elements[-1].properties
            ):
                elements[-1].properties[name] = _TYPES[kind]
            case _:
                raise FormatError(path, f"{shown(line)} is no line of a PLY header", number)
    if order is None:
        raise FormatError(path, "a PLY file that does not say its format")
    return order, elements, len(lines)


def _binary(path: Path, body: bytes, order: str, elements: list[_Element], vertex: _Element) -> NDArray[Any]:
    """Read the vertices, and pass over all other elements, which have to fill the file."""
    at = 0
    found: NDArray[Any] | None = None
    for element in elements:
        if element.has_lists():
            at = _after_lists(path, body, at, order, element)
            continue
        dtype = element.dtype(order)
        need = at + element.count * dtype.itemsize
        if len(body) < need:
            said = "vertices" if element is vertex else f"records of its element {element.name}"
            raise FormatError(
                path,
                f"{element.count} {said} need {need} bytes after the header, and {len(body)} are there: "
                "truncated or damaged",
            )
        if element is vertex:
            found = np.frombuffer(body, dtype, vertex.count, at)
        at = need
    if len(body) > at:
        said = f"its elements need {at} bytes after the header, and {len(body)} are there"
        raise FormatError(path, f"{said}: truncated or damaged")
    assert found is not None  # noqa: S101 - the vertices are among the elements
    return found


def _after_lists(path: Path, body: bytes, at: int, order: str, element: _Element) -> int:
    """Find the place after an element with lists, each of which tells its own length."""
    kinds = [kind if isinstance(kind, tuple) else ("", kind) for kind in element.properties.values()]
    fields = [
        (np.dtype(order + length) if length else None, np.dtype(kind).itemsize) for length, kind in kinds
    ]
    for record in range(element.count):
        for length, size in fields:
            items = 1
            if length is not None and at + length.itemsize <= len(body):
                items = int(np.frombuffer(body, length, 1, at)[0])
                at += length.itemsize
            at += items * size
            if items < 0 or at > len(body):
                said = f"record {record} of its element {element.name} goes beyond the file's end"
                raise FormatError(path, f"{said}: truncated or damaged")
    return at


def _text(
    path: Path, body: bytes, header: int, before: int, vertex: _Element, kept: list[int], total: int
) -> Coordinates:  # fmt: skip
    lines = re.split(rb"\r\n|\n|\r", body.rstrip())
    rows = lines[before : before + vertex.count]
    if len(rows) < vertex.count or not body.strip():
        here = len(rows) if body.strip() else 0
        raise FormatError(path, f"the header says {vertex.count} vertices, and the file ends after {here}")
    if len(lines) > total:
        what = f"{vertex.count} vertices" if total == before + vertex.count else f"{total} lines"
        raise FormatError(path, f"the header says {what}, and here is another", header + total + 1)
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
        raise InputError("a PLY file holds one set; got several, which .npz and .txt hold")
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
