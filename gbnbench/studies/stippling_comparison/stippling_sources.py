"""Sources of sets for one density: adaptive generators by name, files of points by anybody, and arrays."""

from __future__ import annotations

import dataclasses
import hashlib
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import numpy as np

from gbnbench.core.errors import FormatError, InputError, RefusalError
from gbnbench.core.settings import nearest, specification
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.protocol import AdaptiveGenerator
from gbnbench.generators.adaptive.registry import ADAPTIVE_GENERATORS, adaptive_generator
from gbnbench.io.points import ReadingOptions
from gbnbench.runs.source_names import told_apart
from gbnbench.studies.stippling_comparison.points_of_image import on_pixels, sets_on_image

StipplingSourceLike = Any  # str, Path, array_like or AdaptiveGenerator


@dataclass(frozen=True)
class StipplingSource:
    """One row of a comparison: a generator, or sets of points that are there.

    Attributes
    ----------
    key : str
        Unique among the sources and safe as a folder name.
    label : str
        What the user reads; unique.
    n, realizations : int
        Points a set, number of sets.
    generator : AdaptiveGenerator or None
        None for sets that are there.
    sets : (realizations, n, 2) float64 or None
        Positions in pixels, rows first; None for generators.
    digest : str
        SHA-256 of what the sets were read from; empty for generators.
    kind : {"generator", "files", "array"}
        Where the points come from.
    reading : mapping
        What the user said of how files are read.
    """

    key: str
    label: str
    n: int
    realizations: int
    generator: AdaptiveGenerator | None = None
    sets: FloatArray | None = None
    digest: str = ""
    kind: Literal["generator", "files", "array"] = "generator"
    reading: Mapping[str, Any] = dataclasses.field(default_factory=dict)

    def identity(self) -> dict[str, Any]:
        """Return what decides its points, JSON-ready: sources of equal identity give equal results."""
        same = {"key": self.key, "label": self.label, "n": self.n, "d": 2, "realizations": self.realizations}
        if self.generator is None:
            return {**same, "kind": self.kind, "sha256": self.digest, "reading": dict(self.reading)}
        settings = dataclasses.asdict(self.generator)  # type: ignore[call-overload]
        return {**same, "kind": "generator", "generator": self.generator.name, "settings": settings}


def stippling_sources(
    given: Sequence[tuple[str, StipplingSourceLike]],
    density: Density,
    n: int,
    realizations: int,
    reading: ReadingOptions,
) -> tuple[tuple[StipplingSource, ...], tuple[str, ...], tuple[str, ...]]:
    """Turn what was given into sources, in its order.

    Parameters
    ----------
    given : sequence of (label, source)
        Generators such as ``"gbn[sigma=0.85]"`` or instances of them, files and folders, arrays (n, 2) or
        (realizations, n, 2) in the unit square, x to the right and y up. A name that is both a generator and
        a file is the generator. Where the label is empty, one is found.
    density : Density
        Of an image.
    n, realizations : int
        Points a set, and sets, of generators; at least 1.
    reading : ReadingOptions
        How files are read.

    Returns
    -------
    sources : tuple of StipplingSource
        At least one.
    skipped : tuple of str
        A sentence for each generator that refuses this density and n.
    unread : tuple of str
        A sentence for each file or folder that cannot be read.

    Raises
    ------
    InputError
        If something is no source, options of reading are given where no file is read, or what is left is
        nothing but files that cannot be read.
    RefusalError
        If nothing remains.
    """
    sources: list[StipplingSource] = []
    skipped: list[str] = []
    unread: list[str] = []
    stems = Counter(Path(item).stem for _, item in given if isinstance(item, (str, Path)))
    for label, item in given:
        generator = _generator(item)
        if generator is not None:
            text = label or specification(generator)
            if why := generator.refusal(density, n):
                skipped.append(f"{text} at n={n}: {why}")
            else:
                sources.append(StipplingSource("", text, n, realizations, generator))
        elif isinstance(item, (str, Path)):
            path = Path(item)
            title = label or (path.stem if stems[path.stem] == 1 else str(path))
            try:
                sources += _files(path, title, density, reading)
            except (InputError, OSError) as error:
                unread.append(str(error) if isinstance(error, FormatError) else f"{title}: {error}")
        else:
            sources.append(_array(item, label or "array", density))
    said = reading.record()
    if said and not unread and not any(source.kind == "files" for source in sources):
        raise InputError(f"{', '.join(said)} say how files are read, and no source is a file: leave them out")
    if not sources and unread:
        raise InputError("; ".join([*unread, *skipped]))
    if not sources:
        raise RefusalError("; ".join(skipped) if skipped else "no source given: name one")
    return told_apart(sources), tuple(skipped), tuple(unread)


def _generator(item: StipplingSourceLike) -> AdaptiveGenerator | None:
    """Return the generator that is meant; None for a path and for points."""
    if isinstance(item, AdaptiveGenerator):
        return item
    if not isinstance(item, str):
        return None
    name = item.partition("[")[0].strip()
    if name in ADAPTIVE_GENERATORS:
        return adaptive_generator(item)
    if Path(item).exists():
        return None
    known = ", ".join(ADAPTIVE_GENERATORS)
    raise InputError(
        f"{item!r} is neither a generator for densities nor an existing file or folder"
        f"{nearest(name, ADAPTIVE_GENERATORS)}; the generators are {known}"
    )


def _files(path: Path, label: str, density: Density, reading: ReadingOptions) -> list[StipplingSource]:
    """Read the sets of a file or folder, a source for each n among them."""
    said = reading.record()
    return [
        StipplingSource("", label, x.shape[1], len(x), sets=x, digest=digest, kind="files", reading=said)
        for x, digest in sets_on_image(path, (density.shape[0], density.shape[1]), reading)
    ]


def _array(item: StipplingSourceLike, label: str, density: Density) -> StipplingSource:
    try:
        x = np.asarray(item, np.float64)
    except (TypeError, ValueError):
        raise InputError(f"{label}: a source is a name, a path or an array of points") from None
    if x.size == 0:
        raise InputError(f"{label} holds no points: a source has at least one")
    if x.ndim not in (2, 3) or x.shape[-1] != 2:
        raise InputError(
            f"{label}: points must be (n, 2) or (realizations, n, 2); got an array of shape {x.shape}"
        )
    if not ((x >= 0) & (x <= 1)).all():
        raise InputError(
            f"{label}: points must lie in the unit square, x to the right and y up, as Stippling.points do"
        )
    sets = on_pixels(x if x.ndim == 3 else x[None], (density.shape[0], density.shape[1]))
    digest = hashlib.sha256(repr(sets.shape).encode() + sets.tobytes()).hexdigest()
    return StipplingSource("", label, sets.shape[1], len(sets), sets=sets, digest=digest, kind="array")
