"""JSON: a list of points, a list of such lists, or an object whose ``points`` are one of these."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.io.points.columns import choose, fault_of_names, is_axis
from gbnbench.io.points.formats.axes import XYZ, refuse_plane
from gbnbench.io.points.formats.format import Format
from gbnbench.io.points.fractions_of_box import refuse_row_numbers
from gbnbench.io.points.literals import too_large
from gbnbench.io.points.point_file import PointFile
from gbnbench.io.points.point_sets import Box, Coordinates, FileContent, PointSets, in_own_unit

_ABOUT = ("low", "sides", "toroidal")  # keys that tell the box
_GEOJSON = ("FeatureCollection", "Feature", "GeometryCollection", "MultiPoint", "Point")
_DIGITS = 300  # of a whole number that a float surely holds
_LISTS = (
    "points are lists of numbers, such as [[0.1, 0.2], [0.3, 0.4]], alone or as the 'points' of an object"
)


def _recognises(file: PointFile) -> bool:
    return file.suffix == ".json" or file.head.removeprefix(b"\xef\xbb\xbf").lstrip()[:1] in (b"[", b"{")


def _read(file: PointFile) -> FileContent:
    path = file.path
    content = _parsed(path, file.read())
    about: dict[str, Any] = {}
    if isinstance(content, dict):
        key = file.options.array or "points"
        if content.get("type") in _GEOJSON:
            raise FormatError(
                path,
                "is GeoJSON, whose longitudes and latitudes are of no plane: project them, and write x and y "
                "as .csv",
            )
        if key == "points" and key not in content and (held := _columns(path, content)):
            return _of_columns(file, content, held)
        if key not in content:
            shown = ", ".join(map(repr, list(content)[:8]))
            lists = any(isinstance(value, list) for value in content.values())
            instead = "--array takes another key" if lists else f"none of them a list: {_LISTS}"
            raise FormatError(path, f"its object has no {key!r}: it has {shown}; {instead}")
        about = content if file.options.array is None else {}
        content = content[key]
    elif file.options.array is not None:
        raise FormatError(path, "--array means nothing to a list: it names a key of an object")
    if not isinstance(content, list) or not any(part not in ([], {}) for part in content):
        raise FormatError(path, f"holds no points: {_LISTS}")
    several = all(isinstance(part, list) and part and isinstance(part[0], (list, dict)) for part in content)
    parts = content if several else [content]
    columns = file.options.columns
    sets = [
        Coordinates(_points(path, part, columns, f"set {k}, " * several), where=f"set {k}: " * several)
        for k, part in enumerate(parts)
    ]
    named = isinstance(parts[0][0], dict)
    if named and columns is None and tuple(name.lower() for name in parts[0][0]) == XYZ:
        refuse_plane(path, np.concatenate([one.points for one in sets]), columns)
    if not named and columns is None and "sides" not in about:  # in the unit of a box points may count
        for one in sets:
            refuse_row_numbers(path, one)
    return FileContent(sets, _box(path, about, sets[0].points.shape[1]))


def _columns(path: Path, content: dict[str, Any]) -> dict[str, list[Any]]:
    """Return the columns of an object that holds a list for each, or nothing where it is another."""
    held = {name: value for name, value in content.items() if name not in _ABOUT}
    if not held:
        raise FormatError(path, f"holds no points: {_LISTS}")
    if all(isinstance(value, dict) and value and not _nested(value) for value in held.values()) or all(
        isinstance(value, dict) and any(map(is_axis, value)) for value in held.values()
    ):
        raise FormatError(path, "its columns are objects, as pandas writes them: to_json(path, 'records')")
    lists = all(isinstance(value, list) for value in held.values())
    if not lists or any(isinstance(cell, (list, dict)) for value in held.values() for cell in value):
        return {}
    return held


def _nested(value: dict[str, Any]) -> bool:
    """Whether an object holds lists or objects, and so no cells."""
    return any(isinstance(cell, (list, dict)) for cell in value.values())


def _of_columns(file: PointFile, content: dict[str, Any], held: dict[str, list[Any]]) -> FileContent:
    path = file.path
    lengths = {name: len(value) for name, value in held.items()}
    if len({*lengths.values()}) > 1:
        raise FormatError(path, f"its columns have different lengths: {json.dumps(lengths)[:80]}")
    rows = [dict(zip(held, row, strict=True)) for row in zip(*held.values(), strict=True)]
    if not rows:
        raise FormatError(path, "holds no points: its columns are empty")
    points = _points(path, rows, file.options.columns, "")
    if tuple(name.lower() for name in held) == XYZ:
        refuse_plane(path, points, file.options.columns)
    return FileContent([Coordinates(points)], _box(path, content, points.shape[1]))


def _parsed(path: Path, data: bytes) -> Any:
    try:
        text = data.decode("utf-8-sig")
        return json.loads(
            text,
            parse_constant=_no_constant,
            parse_float=_float,
            parse_int=_int,
            object_pairs_hook=_no_twice,
        )
    except json.JSONDecodeError as error:
        if error.msg == "Extra data" and text[error.pos] in "[{":
            raise FormatError(
                path,
                "a second value begins here, as in JSON Lines: write one list of all, as pandas does by "
                "to_json(path, 'records')",
                error.lineno,
            ) from None
        if text.lstrip().startswith("{{"):
            said = 'is a list of Mathematica: Export["points.csv", x] writes its points'
            raise FormatError(path, said) from None
        raise FormatError(
            path,
            f"begins as JSON does and is none: {error.msg.lower()} in column {error.colno}; rows of "
            "plain text have no brackets",
            error.lineno,
        ) from None
    except UnicodeDecodeError:
        raise FormatError(path, "is no JSON: it is not UTF-8") from None
    except RecursionError:
        raise FormatError(path, f"its lists are nested too deeply: {_LISTS}") from None
    except ValueError as error:
        raise FormatError(path, f"is no JSON: {(str(error).splitlines() or [''])[0][:100]}") from None


class _TooLarge(str):
    """A literal beyond the numbers that a float can be, to be quoted."""


def _float(literal: str) -> float | _TooLarge:
    number = float(literal)
    return number if math.isfinite(number) else _TooLarge(literal)


def _int(literal: str) -> int | float | _TooLarge:
    return int(literal) if len(literal) < _DIGITS else _float(literal)


def _no_constant(name: str) -> float:
    raise ValueError(f"{name} is not a number: remove the point")


def _no_twice(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        raise ValueError("a key stands twice in an object")
    return found


def _points(path: Path, rows: list[Any], columns: tuple[str, ...] | None, where: str) -> Any:
    """Points of one set; each is a list, or an object whose keys are the names of the axes."""
    names: tuple[str, ...] = ()
    if isinstance(rows[0], dict):
        names = tuple(rows[0])
        if columns is None and (fault := fault_of_names(names)) is not None:
            raise FormatError(path, f"{where}point 0: {fault}")
    width = len(rows[0]) if isinstance(rows[0], (list, dict)) else 0
    if width == 0:
        raise FormatError(path, f"{where}point 0 is no list: {_LISTS}")
    kept = range(width) if columns is None else choose(path, columns, names, width)
    found = []
    for k, row in enumerate(rows):
        if isinstance(row, dict):
            if tuple(row) != names:
                raise FormatError(path, f"{where}point {k} has other keys than point 0")
            row = list(row.values())
        elif names or not isinstance(row, list):
            raise FormatError(path, f"{where}point {k} is no {'object' if names else 'list'} as point 0 is")
        if len(row) != width:
            raise FormatError(path, f"{where}point {k} has {len(row)} numbers where point 0 has {width}")
        found.append([_number(path, row[at], f"{where}point {k}: ") for at in kept])
    return np.array(found)


def _number(path: Path, value: Any, where: str) -> float:
    if isinstance(value, _TooLarge):
        raise FormatError(path, where + too_large(value.encode()))
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        instead = ": remove the point" if value is None else ""
        raise FormatError(path, f"{where}{json.dumps(value)[:40]} is not a number{instead}")
    return float(value)


def _box(path: Path, about: dict[str, Any], d: int) -> Box | None:
    """Read ``sides``, ``low`` and ``toroidal`` beside the points."""
    if "sides" not in about:
        return None
    low, sides, toroidal = about.get("low", [0.0] * d), about["sides"], about.get("toroidal")
    for name, value in (("low", low), ("sides", sides)):
        if not isinstance(value, list) or len(value) != d:
            raise FormatError(path, f"{name!r} must be a list of {d} numbers; got {json.dumps(value)[:40]}")
    corner = tuple(_number(path, v, "'low': ") for v in low)
    lengths = tuple(_number(path, v, "'sides': ") for v in sides)
    if not all(0 < side < math.inf for side in lengths) or not all(map(math.isfinite, corner)):
        raise FormatError(path, "'sides' must be above 0, and 'low' finite")
    if toroidal is not None and not isinstance(toroidal, bool):
        raise FormatError(path, f"'toroidal' must be true or false; got {json.dumps(toroidal)[:40]}")
    return Box(corner, lengths, None if toroidal is None else (toroidal,) * d)


def _write(x: PointSets) -> bytes:
    sets = [s.tolist() for s in in_own_unit(x)]
    points = sets[0] if len(sets) == 1 else sets
    if x.sides is None:
        return json.dumps(points).encode() + b"\n"
    about = {"low": x.low, "sides": x.sides} | ({} if x.toroidal is None else {"toroidal": x.toroidal})
    return json.dumps({**about, "points": points}).encode() + b"\n"


JSON = Format(
    "JSON", (".json",), _recognises, _read, {".json": _write}, frozenset({"columns", "array"}), keeps_box=True
)
