"""The sources of a study in Python: names, paths, arrays and generators, alone, listed or with labels."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.core.errors import InputError
from gbnbench.generators.protocol import Generator
from gbnbench.io.points import ReadingOptions
from gbnbench.runs.named_groups import is_group
from gbnbench.runs.sources import DEFAULT_READING, Source, array_source, resolve

SourceLike = Any  # str, Path, array_like, Generator or Source


def as_sources(
    given: SourceLike | Iterable[SourceLike] | Mapping[str, SourceLike],
    n: int | Sequence[int],
    d: int | Sequence[int],
    realizations: int,
    reading: ReadingOptions = DEFAULT_READING,
    sides: ArrayLike | None = None,
) -> tuple[tuple[Source, ...], tuple[str, ...]]:
    """Turn what Python was given into sources, in the order given.

    Parameters
    ----------
    given : str, path, array_like, Generator or Source, or a sequence or mapping of these
        A name such as ``"gbn[sigma=0.8]"``, a file or folder, points (n, d) or (realizations, n, d), an
        instance of a generator, or a Source. The keys of a mapping are the labels.
    n, d : int or sequence of int
        Sizes and dimensions for the generators; files and arrays bring their own.
    realizations : int
        Sets of each generator.
    reading : ReadingOptions
        How files are read.
    sides : (d,) array_like, optional
        Lengths of the sides of the torus on which arrays lie; a cube if not given.

    Returns
    -------
    sources : tuple of Source
        At least one.
    skipped : tuple of str
        A sentence for each generator, n and d that was refused.

    Raises
    ------
    InputError
        If something given is no source.
    RefusalError
        If nothing remains.
    """
    sizes, dimensions = _several("n", n), _several("d", d)
    if isinstance(given, Mapping):
        sources: list[Source] = []
        skipped: list[str] = []
        for label, item in given.items():
            if is_group(item):
                raise InputError(
                    f"{item} is several generators, which have their own names: give it no label"
                )
            found, left_out = resolve(
                [_source(item, str(label), sides)], sizes, dimensions, realizations, reading
            )
            sources += [replace(source, label=str(label)) for source in found]
            skipped += left_out
        found, _ = resolve(sources, sizes, dimensions, realizations)
        _check_used(reading, found)
        return found, tuple(skipped)
    items = [given] if _is_one(given) else list(given)
    arrays = sum(_is_array(item) for item in items)
    count = 0
    named = []
    for item in items:
        count += _is_array(item)
        label = "array" if arrays == 1 else f"array {count}"
        named.append(_source(item, label, sides))
    found, refused = resolve(named, sizes, dimensions, realizations, reading)
    _check_used(reading, found)
    return found, refused


def _check_used(reading: ReadingOptions, sources: Iterable[Source]) -> None:
    """Refuse options of reading where no source is read."""
    given = reading.record()
    if given and not any(source.kind == "files" for source in sources):
        raise InputError(
            f"{', '.join(given)} say how files are read, and no source is a file: leave them out"
        )


def _source(item: SourceLike, label: str, sides: ArrayLike | None) -> str | Path | Generator | Source:
    """Return an item as ``resolve`` takes it: an array becomes a source with this label."""
    if isinstance(item, (str, Path, Source)):
        return item
    return array_source(item, label, sides) if _is_array(item) else item


def _is_one(given: object) -> bool:
    """Whether this is one source, not a collection of them."""
    one = isinstance(given, (str, Path, Source)) or hasattr(given, "__array__")
    return one or not isinstance(given, Iterable)


def _is_array(item: object) -> bool:
    """Whether this holds points: an array, or lists of numbers."""
    return hasattr(item, "__array__") or isinstance(item, (list, tuple))


def _several(name: str, value: int | Sequence[int]) -> tuple[int, ...]:
    """Return one whole number or several as a tuple, or raise an error that names the argument."""
    array = np.atleast_1d(np.asarray(value))
    if array.ndim != 1 or array.dtype.kind not in "iu" or len(array) == 0:
        raise InputError(f"{name} must be a whole number or several; got {value!r}")
    return tuple(array.tolist())
