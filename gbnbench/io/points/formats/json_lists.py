"""JSON: a list of points, a list of such lists, or an object whose ``points`` are one of these."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.io.points.columns import choose, fault_of_names
from gbnbench.io.points.formats.format import Format
from gbnbench.io.points.point_file import PointFile
from gbnbench.io.points.point_sets import Box, Coordinates, FileContent, PointSets, in_own_unit

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
        if key not in content:
            shown = ", ".join(map(repr, list(content)[:8])) or "nothing"
            raise FormatError(path, f"its object has no {key!r}: it has {shown}; --array takes another key")
        about = content if file.options.array is None else {}
        content = content[key]
    elif file.options.array is not None:
        raise FormatError(path, "--array means nothing to a list: it names a key of an object")
    if not isinstance(content, list) or not content:
        raise FormatError(path, f"holds no points: {_LISTS}")
    several = all(isinstance(part, list) and part and isinstance(part[0], (list, dict)) for part in content)
    parts = content if several else [content]
    columns = file.options.columns
    sets = [
        Coordinates(_points(path, part, columns, f"set {k}, " * several), where=f"set {k}: " * several)
        for k, part in enumerate(parts)
    ]
    return FileContent(sets, _box(path, about, sets[0].points.shape[1]))


def _parsed(path: Path, data: bytes) -> Any:
    try:
        text = data.decode("utf-8-sig")
        return json.loads(text, parse_constant=_no_constant, object_pairs_hook=_no_twice)
    except json.JSONDecodeError as error:
        raise FormatError(
            path,
            f"begins as JSON does and is none: {error.msg.lower()} in column {error.colno}",
            error.lineno,
        ) from None
    except UnicodeDecodeError:
        raise FormatError(path, "is no JSON: it is not UTF-8") from None
    except RecursionError:
        raise FormatError(path, f"its lists are nested too deeply: {_LISTS}") from None
    except ValueError as error:
        raise FormatError(path, f"is no JSON: {(str(error).splitlines() or [''])[0][:100]}") from None


def _no_constant(name: str) -> float:
    raise ValueError(f"{name} is not a number")


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
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise FormatError(path, f"{where}{json.dumps(value)[:40]} is not a number")
    try:
        return float(value)
    except OverflowError:
        return math.inf


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
