"""Sources of point sets, each of one n and d, made from the names of generators, files and folders."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.least_values import require
from gbnbench.core.settings import specification
from gbnbench.core.sides import as_sides
from gbnbench.core.torus import FloatArray, as_realizations
from gbnbench.generators.kind_check import of_instance
from gbnbench.generators.protocol import Generator
from gbnbench.generators.third_parties.faults import refusal_of
from gbnbench.io.points import ReadingOptions
from gbnbench.runs.file_sets import read_groups
from gbnbench.runs.generator_identity import generator_identity
from gbnbench.runs.named_groups import expanded
from gbnbench.runs.source_names import generator_named, told_apart

DEFAULT_READING = ReadingOptions()
DEFAULT_SOURCES = ("random", "jittered", "sobol", "lloyd", "fpo", "gbn")


@dataclass(frozen=True)
class Source:
    """One row of a comparison: a generator, or sets read from files, at one n and d.

    Attributes
    ----------
    key : str
        Unique among the sources and safe as a folder name.
    label : str
        What the user reads; unique for its n and d.
    n, d, realizations : int
        Points a set, dimension, number of sets.
    generator : Generator or None
        None for files.
    sets : (realizations, n, d) float64 or None
        None for generators.
    digest : str
        SHA-256 of the contents of files and of how they are read, or of an array; empty for generators.
    kind : {"generator", "files", "array"}
        Where the points come from.
    reading : mapping
        What the user said of how the files are read, as ``ReadingOptions.record`` writes it.
    sides : tuple of float or None
        Sides of the box, in the files' unit or in that of the caller; None where nobody told any.
    toroidal : bool or None
        Whether the box is a torus, where the files or the user say so.
    """

    key: str
    label: str
    n: int
    d: int
    realizations: int
    generator: Generator | None = None
    sets: FloatArray | None = None
    digest: str = ""
    kind: Literal["generator", "files", "array"] = "generator"
    reading: Mapping[str, Any] = field(default_factory=dict)
    sides: tuple[float, ...] | None = None
    toroidal: bool | None = None

    def identity(self) -> dict[str, Any]:
        """Return what decides its points, JSON-ready: sources of equal identity give equal results."""
        same = {
            "key": self.key, "label": self.label, "n": self.n, "d": self.d, "realizations": self.realizations
        }  # fmt: skip
        if self.generator is None:
            read = {"reading": dict(self.reading)} if self.reading else {}
            box = {} if as_sides(self.sides, self.d) is None else {"sides": list(self.sides or ())}
            return {**same, "kind": self.kind, "sha256": self.digest, **read, **box}
        return {
            **same,
            "kind": "generator",
            "generator": self.generator.name,
            **generator_identity(self.generator),
        }


def array_source(x: ArrayLike, label: str = "array", sides: ArrayLike | None = None) -> Source:
    """Return points that are in memory as a source, known by a checksum of their values.

    Parameters
    ----------
    x : (n, d) or (realizations, n, d) array_like
        Points on the unit torus.
    label : str
        What the user reads.
    sides : (d,) array_like, optional
        Lengths of the torus's sides, whose ratios count; a cube if not given.

    Returns
    -------
    Source
        Of kind "array".

    Raises
    ------
    InputError
        If x is no array of points in [0, 1)^d, the label is empty, or sides are not d lengths.
    """
    if not label:
        raise InputError("a source needs a name; got an empty one")
    sets = as_realizations(x)
    digest = hashlib.sha256(repr(sets.shape).encode() + sets.tobytes()).hexdigest()
    realizations, n, d = sets.shape
    told = None if as_sides(sides, d) is None else tuple(np.asarray(sides, dtype=np.float64).tolist())
    return Source("", label, n, d, realizations, sets=sets, digest=digest, kind="array", sides=told)


def resolve(
    names: Iterable[str | Path | Generator | Source],
    n: Sequence[int],
    d: Sequence[int],
    realizations: int,
    reading: ReadingOptions = DEFAULT_READING,
) -> tuple[tuple[Source, ...], tuple[str, ...]]:
    """Turn names into sources, in their order.

    Parameters
    ----------
    names : iterable of str, Path, Generator or Source
        Generators such as ``gbn[iterations=1000]``, files and folders. A name that is both is a generator;
        with a path separator (``./gbn``) or as a Path it is a path. An instance is a generator of your own,
        whose class the workers must be able to import. ``family:cellular`` is every generator of a family,
        ``preset:paper`` the methods of the paper's figures 1 and 8.
    n, d : sequence of int
        Sizes and dimensions for the generators: each is made at every pair. Files bring their own.
    realizations : int
        Sets for each generator. Files bring their own.
    reading : ReadingOptions
        How the files are read.

    Returns
    -------
    sources : tuple of Source
        At least one.
    skipped : tuple of str
        A sentence for each generator, n and d that was refused, and for each method of a preset without a
        generator.

    Raises
    ------
    InputError
        If a name is neither a generator nor a path, a file cannot be read, or a number is below 1.
    RefusalError
        If nothing remains.
    """
    require(n=(min(n, default=1), 1), d=(min(d, default=1), 1), realizations=(realizations, 1))
    sources: list[Source] = []
    names, told = expanded(names)
    skipped = list(told)
    paths = dict.fromkeys(str(name) for name in names if isinstance(name, (str, Path)))
    stems = Counter(_title(Path(path)) for path in paths)
    for name in names:
        if isinstance(name, Source):
            sources.append(name)
            continue
        if isinstance(name, Path) and not name.exists():
            raise InputError(f"{name} is neither a file nor a folder")
        generator: Generator | None = None
        if isinstance(name, str):
            generator = generator_named(name)
        elif not isinstance(name, Path):
            generator = of_instance(name)
        if generator is None:
            path = Path(str(name))
            title = _title(path)
            sources.extend(_read(path, title if stems[title] == 1 else str(path), reading))
            continue
        text = specification(generator)
        for size, dimension in dict.fromkeys((size, dimension) for dimension in d for size in n):
            why = refusal_of(generator, size, dimension)
            if why is None:
                sources.append(Source("", text, size, dimension, realizations, generator))
            else:
                skipped.append(f"{text} at n={size}, d={dimension}: {why}")
    if not sources:
        raise RefusalError("; ".join(skipped) if skipped else "no source given: name one")
    apart = told_apart(
        sources, lambda source: (source.n, source.d), lambda source: f"_n{source.n}_d{source.d}"
    )
    return apart, tuple(skipped)


def _title(path: Path) -> str:
    """Short label of a path: the folder's name, or the file's without its suffix."""
    return path.resolve().name if path.is_dir() else path.stem


def _read(path: Path, title: str, reading: ReadingOptions) -> list[Source]:
    """Read the sets of a file or folder, a source for each (n, d) among them."""
    return [
        Source("", title, found.sets.shape[1], found.sets.shape[2], len(found.sets), sets=found.sets,
               digest=found.digest, kind="files", reading=reading.record(), sides=found.sides,
               toroidal=found.toroidal)
        for found in read_groups(path, reading)
    ]  # fmt: skip
