"""The bytes of exported sets by the suffix of their file, and what each file says of its origin."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench import __version__
from gbnbench.api.exports import QUALITY_COLUMNS, ExportedSets, quality_row
from gbnbench.core.errors import InputError
from gbnbench.core.number_text import number
from gbnbench.core.readable_text import counted
from gbnbench.core.torus import FloatArray
from gbnbench.io.exports.c_header import c_header, c_name
from gbnbench.io.exports.number_types import NumberType, check_number_type
from gbnbench.io.exports.raw_numbers import raw_numbers, side_file
from gbnbench.io.points.point_sets import PointSets, in_own_unit
from gbnbench.io.points.writer import WRITTEN, encode, suffix_of

HEADER, RAW, JSON = ".h", (".bin", ".raw"), ".json"
PICTURES = (".png", ".exr")


def default_type(path: Path, number_type: str | None) -> NumberType:
    """Check the suffix of a file of sets against the type of its numbers.

    Parameters
    ----------
    path : Path
        File to write.
    number_type : str or None
        As the user gave it.

    Returns
    -------
    {"float32", "float64", "uint32"}
        The default where none was given.

    Raises
    ------
    InputError
        If sets are not written to such a file, or not in such numbers.
    """
    suffix = path.suffix.lower()
    if suffix in PICTURES:
        raise InputError(f"{path}: pictures hold masks; points go to .h, .bin, .raw or .json")
    compact = suffix == HEADER or suffix in RAW
    if not compact and suffix_of(path) not in WRITTEN:
        known = ", ".join((HEADER, *RAW, *WRITTEN))
        raise InputError(f"{path}: sets are exported as {known}; got extension {suffix!r}")
    if number_type is None:
        return "float32" if compact else "float64"
    checked = check_number_type(number_type)
    if checked == "uint32" and not compact:
        raise InputError(f"{path}: uint32 is written to .h, .bin and .raw; take float32 or float64")
    return checked


def written_files(path: Path) -> tuple[Path, ...]:
    """Return the files that an export of sets writes: its own, and the description of a binary one."""
    return (path, side_file(path)) if path.suffix.lower() in RAW else (path,)


def check_format(path: Path, sets: int, d: int, sides: Sequence[float] | None) -> None:
    """Refuse a file whose format cannot hold the sets, before they are drawn.

    Parameters
    ----------
    path : Path
        File to write, of a suffix that ``default_type`` knows.
    sets, d : int
        How many, and their dimension.
    sides : sequence of float or None
        Of the box; None for a cube.

    Raises
    ------
    InputError
        If it holds fewer sets or other dimensions, or no box.
    """
    if path.suffix.lower() not in (HEADER, *RAW, JSON):
        encode(path, _boxed([np.zeros((1, d))] * min(sets, 2), sides))


def encode_sets(
    path: Path,
    made: ExportedSets,
    values: NDArray[Any],
    identities: Sequence[dict[str, Any]],
    seed: int | None,
) -> dict[Path, bytes]:
    """Make the files of an export.

    Parameters
    ----------
    path : Path
        File to write; its suffix names the format.
    made : ExportedSets
        The points and what was measured of them.
    values : (sets, n, d) float32, float64 or uint32
        The numbers themselves.
    identities : sequence of dict
        What decides the points of each source, JSON-ready.
    seed : int or None
        Of generators, copies and random shifts; None where nothing was random.

    Returns
    -------
    dict of Path to bytes
        In the order in which they are to be written; the last is the file itself.

    Raises
    ------
    InputError
        If the format cannot hold the sets or their box.
    """
    suffix = path.suffix.lower()
    sets, n, d = values.shape
    if suffix == HEADER:
        name = c_name(path.stem)
        comments = list(comment_lines(made, f"{name}_points[set][point][axis]", seed))
        return {path: c_header(name, "points", values, {"count": sets, "n": n, "d": d}, comments)}
    about = description(made, identities, seed)
    if suffix in RAW:
        return raw_numbers(path, values, about)
    boxed = _boxed(list(made.points), made.sides)
    if suffix == JSON:
        return {path: _json(boxed, about)}
    return {path: encode(path, boxed)}


def description(made: ExportedSets, identities: Sequence[dict[str, Any]], seed: int | None) -> dict[str, Any]:
    """Describe what was made, of what, and how good it is.

    Parameters
    ----------
    made : ExportedSets
        The points and what was measured of them.
    identities : sequence of dict
        What decides the points of each source, JSON-ready.
    seed : int or None
        Of generators, copies and random shifts; None where nothing was random.

    Returns
    -------
    dict
        JSON-ready.
    """
    unit = "2^-32 of a side of the box" if made.number_type == "uint32" else "sides of the box, 0 to 1"
    return {
        "gbnbench": __version__,
        "sources": list(identities),
        "seed": seed,
        "number_type": made.number_type,
        "unit": unit,
        "box": None if made.sides is None else list(made.sides),
        "copies": [
            {"of": one.of, "done": [vars(step) for step in one.done if not step.is_identity()]}
            for one in made.copies
        ],
        "repeat": list(made.repeat),
        "sets_measured": made.measured,
        "noise_floor_before_rounding": _finite(made.unrounded.noise_floor),
        "quality": [
            dict(zip(QUALITY_COLUMNS, map(_finite, quality_row(one)), strict=True))
            for one in (made.quality, *made.projections)
        ],
        "remarks": list(made.remarks),
    }


def comment_lines(made: ExportedSets, array: str, seed: int | None) -> Iterator[str]:
    """Write the same for the reader of a header.

    Parameters
    ----------
    made : ExportedSets
        The points and what was measured of them.
    array : str
        The array with the meaning of its indices.
    seed : int or None
        Of generators, copies and random shifts; None where nothing was random.

    Yields
    ------
    str
        A line each.
    """
    sets, n, d = made.points.shape
    unit = "as counts of 2^-32 of a side" if made.number_type == "uint32" else "in [0, 1)"
    held = f"{counted(sets, 'set')} of {counted(n, 'point')} of the unit torus, d={d}"
    yield f"{array}: {held}, {made.number_type} {unit}."
    drawn = "" if seed is None else f", seed {seed}"
    yield f"Written by gbnbench {__version__} from {made.source}{drawn}."
    if made.sides is not None:
        yield f"They are fractions of a box of sides {' x '.join(f'{side:g}' for side in made.sides)}."
    if math.prod(made.repeat) > 1:
        yield f"A tile is repeated {' x '.join(map(str, made.repeat))} times within the unit torus."
    for k, one in enumerate(made.copies):
        if sets > 1 or not all(step.is_identity() for step in one.done):
            yield f"Set {k}: {one.words()}."
    measured = f", of the first {made.measured} sets" if made.measured < sets else ""
    yield f"Noise floor (1 for random points{measured}): {number(made.quality.noise_floor)}."
    for projection in made.projections:
        axes = f"{'axis' if len(projection.axes) == 1 else 'axes'} {'+'.join(map(str, projection.axes))}"
        yield (
            f"On {axes}: noise floor {number(projection.noise_floor)}, nearest points "
            f"{number(projection.over_random)} times as far apart as random ones."
        )
    yield from made.remarks


def _boxed(sets: list[FloatArray], sides: Sequence[float] | None) -> PointSets:
    if sides is None:
        return PointSets(sets)
    return PointSets(sets, tuple(sides), (0.0,) * len(sides))


def _json(x: PointSets, about: dict[str, Any]) -> bytes:
    box = {} if x.sides is None else {"low": list(x.low or ()), "sides": list(x.sides)}
    sets: list[FloatArray] = in_own_unit(x)
    points = (sets[0] if len(sets) == 1 else np.stack(sets)).tolist()
    unit = {"unit": "that of the box"} if box else {}
    return json.dumps({**about, **unit, **box, "points": points}).encode() + b"\n"


def _finite(value: str | float) -> str | float | None:
    return None if isinstance(value, float) and not math.isfinite(value) else value
