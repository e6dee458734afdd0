"""``gbnbench.export_sets``: point sets as files for renderers, and what was measured of what was written."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np

from gbnbench.analysis.radial.projection_quality import (
    projection_quality,
    qualities,
    renderers_projections,
)
from gbnbench.api.export_files import check_format, default_type, encode_sets
from gbnbench.api.exports import ExportedSets, SetCopy
from gbnbench.api.source_arguments import SourceLike, as_sources
from gbnbench.core.atomic_write import check_folder
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.least_values import whole_number
from gbnbench.core.memory import too_large
from gbnbench.core.repeated_tile import check_counts, repeated
from gbnbench.core.sides import as_sides
from gbnbench.core.torus import FloatArray
from gbnbench.core.torus_isometry import isometry, random_isometries
from gbnbench.generators.monitor import Monitor
from gbnbench.generators.registry import generate
from gbnbench.io.exports.number_types import NumberType, fractions, rounded
from gbnbench.io.points.point_sets import NO_TORUS
from gbnbench.io.points.writer import write_atomically
from gbnbench.opencl import use_device
from gbnbench.runs.sources import Source

MEASURED_SETS, MEASURED_POINTS = 8, 2**17  # of which quality is measured, at most, but of one set at least
COSTLY = 1.1  # times the noise floor: what rounding may make of it before it is remarked upon
NOTHING = 1e-26  # power at or below which only rounding of the measurement is left
COPIES_STREAM = (0, 1)  # of the seed; the realizations have (0,), (1,), ...

Progress = Callable[[int, int, str], None]


def export_sets(
    path: str | Path,
    source: SourceLike | Sequence[SourceLike],
    *,
    n: int = 1024,
    d: int = 2,
    realizations: int = 1,
    seed: int = 0,
    number_type: NumberType | None = None,
    swap: Sequence[Sequence[int]] = (),
    flip: Sequence[int] = (),
    shift: Literal["random"] | Sequence[float] | None = None,
    copies: int = 1,
    repeat: Sequence[int] | None = None,
    progress: Progress | None = None,
    device: str | None = None,
) -> ExportedSets:
    """Write point sets for a renderer, and measure what was written.

    Parameters
    ----------
    path : path-like
        Ends in .h (a C header), .bin or .raw (numbers alone, lowest byte first, with a description beside
        them in FILE.json), .json (the points with their description), or as ``gbnbench.save`` takes it.
    source : str, path, array_like, Generator or Source, or a sequence of these
        As ``gbnbench.compare`` takes it; all sets of one n and d.
    n, d, realizations : int
        Of a generator; files and arrays bring their own.
    seed : int
        Of a generator's sets, of copies and of a random shift.
    number_type : {"float32", "float64", "uint32"}, optional
        Of the numbers: float32 by default in .h, .bin and .raw, else float64. uint32 counts 2**-32 of a side.
    swap : sequence of pairs of int
        Axes that are exchanged, one pair after another; counted from 0.
    flip : sequence of int
        Axes that are reflected then, x to 1 - x.
    shift : "random" or (d,) sequence of float, optional
        Added then on the torus, in sides.
    copies : int
        Copies of each set, which differ: the first is the set itself, others have axes exchanged and
        reflected by turns and a random shift each.
    repeat : (d,) sequence of int, optional
        Tiles along each axis, at last; points are fractions of the whole.
    progress : callable, optional
        Called with (steps done, steps in all, what is being done).
    device : str, optional
        Part of the name of the OpenCL device, or its position, as in ``GBNBENCH_DEVICE``.

    Returns
    -------
    ExportedSets
        The numbers as they were written, and the quality of whole sets, of every axis and of pairs of axes.

    Raises
    ------
    InputError
        If an argument breaks its rule, sets differ in n, d or sides, or the file cannot be written.
    RefusalError
        If the generator cannot make such sets, or they do not fit in memory.
    DeviceError
        If a device is named and fits none or several.

    Notes
    -----
    Swaps, flips and shifts keep all distances; shifts keep the spectrum, swaps and flips take its frequencies
    to others of their shell. A repeated tile has zeros of power between the frequencies of the tile.

    Examples
    --------
    >>> import tempfile
    >>> from pathlib import Path
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     made = export_sets(f"{folder}/sets.h", "gbn[iterations=10]", n=16, copies=2)
    ...     lines = Path(folder, "sets.h").read_text().splitlines()
    >>> next(line for line in lines if line.startswith("static"))
    'static const float sets_points[2][16][2] = {'
    """
    path = Path(path)
    numbers = default_type(path, number_type)
    check_folder(path)
    copies, seed = whole_number("copies", copies, 1), whole_number("seed", seed, 0)
    sources, _ = as_sources(source, n, d, realizations)
    first = _alike(sources)
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=COPIES_STREAM))
    sides = None if as_sides(first.sides, first.d) is None else first.sides
    asked = isometry(first.d, swap, flip, _shift(shift, first.d, rng), sides)
    tiles = (1,) * first.d if repeat is None else check_counts(repeat, first.d)
    whole = None if sides is None and len(set(tiles)) == 1 else _whole(sides, tiles)
    sets = sum(one.realizations for one in sources) * copies
    check_format(path, sets, first.d, whole)
    if reason := too_large(3 * 8.0 * sets * first.n * first.d * math.prod(tiles)):
        raise RefusalError(f"{sets} sets of n={first.n * math.prod(tiles)} points {reason}; export fewer")
    with use_device(device):
        drawn = np.concatenate([_drawn(one, seed, progress) for one in sources])
        made: list[FloatArray] = []
        what: list[SetCopy] = []
        for k, x in enumerate(drawn):
            for own in random_isometries(copies, first.d, rng, sides):
                made.append(own(asked(x)))
                what.append(SetCopy(k, (asked, own)))
        x = repeated(np.stack(made), tiles)
        some = max(1, min(MEASURED_SETS, len(x), MEASURED_POINTS // x.shape[1]))
        every = tuple(range(first.d))
        values = rounded(x, numbers)
        points = fractions(values)
        exported = ExportedSets(
            files=(),
            points=points,
            number_type=numbers,
            source=", ".join(dict.fromkeys(one.label for one in sources)),
            copies=tuple(what),
            repeat=tiles,
            sides=whole,
            measured=some,
            unrounded=projection_quality(x[:some], every, whole),
            quality=projection_quality(points[:some], every, whole),
            projections=qualities(points[:some], renderers_projections(first.d), whole, progress),
            remarks=(),
        )
    exported = replace(exported, remarks=_remarks(exported, sources, x))
    identities = [one.identity() for one in sources]
    random = copies > 1 or shift == "random" or any(one.generator is not None for one in sources)
    files = encode_sets(path, exported, values, identities, seed if random else None)
    for file, data in files.items():
        write_atomically(file, data)
    return replace(exported, files=tuple(reversed(files)))


def _alike(sources: Sequence[Source]) -> Source:
    """Return the first of sources that are of one n, d and box."""
    first = sources[0]
    for other in sources[1:]:
        if (other.n, other.d) != (first.n, first.d):
            raise InputError(
                f"the sets of one file must be of one n and d; got n={first.n}, d={first.d} of {first.label} "
                f"and n={other.n}, d={other.d} of {other.label}: export them one by one"
            )
        if as_sides(other.sides, other.d) != as_sides(first.sides, first.d):
            raise InputError(f"the boxes of {first.label} and {other.label} differ: export them one by one")
    return first


def _drawn(source: Source, seed: int, progress: Progress | None) -> FloatArray:
    if source.sets is not None:
        return source.sets
    assert source.generator is not None  # noqa: S101 - a source has the one or the other
    x = generate(source.generator, source.n, source.d, seed, source.realizations, monitor=Monitor(progress))
    return x.reshape(source.realizations, source.n, source.d)


def _shift(
    shift: Literal["random"] | Sequence[float] | None, d: int, rng: np.random.Generator
) -> Sequence[float] | None:
    if isinstance(shift, str):
        if shift != "random":
            raise InputError(f"shift must be random or {d} numbers, one for each axis; got {shift!r}")
        return tuple(rng.random(d).tolist())
    return shift


def _whole(sides: Sequence[float] | None, tiles: Sequence[int]) -> tuple[float, ...]:
    """Return the sides of the box that the tiles make."""
    return tuple(float(side * count) for side, count in zip(sides or (1.0,) * len(tiles), tiles, strict=True))


def _remarks(made: ExportedSets, sources: Sequence[Source], unrounded: FloatArray) -> tuple[str, ...]:
    """Say what the user should know: rounding that costs, points that coincide, boxes that are no torus."""
    remarks = [f"{one.label}: {NO_TORUS}" for one in sources if one.toroidal is False]
    before, after = made.unrounded.noise_floor, made.quality.noise_floor
    if after > COSTLY * before + NOTHING:
        remarks.append(
            f"rounding to {made.number_type} raises the noise floor from {before:.3g} to {after:.3g}"
            + ("; float64 keeps it" if made.number_type != "float64" else "")
        )
    pairs = () if made.number_type == "float64" else zip(unrounded, made.points, strict=True)
    if any(_different(y) < _different(x) for x, y in pairs):
        remarks.append(f"rounding to {made.number_type} makes points coincide")
    return tuple(remarks)


def _different(x: FloatArray) -> int:
    """Count the points of a set, (n, d), of which no two are the same."""
    ordered = x[np.lexsort(x.T)]
    return 1 + int((ordered[1:] != ordered[:-1]).any(axis=1).sum())
