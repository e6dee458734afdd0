"""The text of ``gbnbench library``: the plan of the files to be made, and the list of those there are."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from gbnbench.core.number_text import NOTHING, duration, number
from gbnbench.core.text_table import aligned

if TYPE_CHECKING:
    from gbnbench.io.set_library.manifest import Manifest
    from gbnbench.studies.set_library.request import LibraryRequest, RequestedSets

LISTED = ("noise_floor", "power_at_1", "peak", "min_distance", "psi6")
HEADS = ("noise floor", "P(|f|=1)", "peak", "min dist", "psi6")


def count(number_of: int, what: str) -> str:
    """Write a number of things, such as ``1 file`` and ``1,584 files``.

    Parameters
    ----------
    number_of : int
        How many.
    what : str
        One of them.

    Returns
    -------
    str
    """
    return f"{number_of:,} {what}{'' if number_of == 1 else 's'}"


def plan_lines(request: LibraryRequest, there: Sequence[RequestedSets]) -> Iterator[str]:
    """Say which files are to be made, which sets are refused and by which rule, and what all costs.

    Parameters
    ----------
    request : LibraryRequest
        What is asked for.
    there : sequence of RequestedSets
        Files that the library has already.

    Yields
    ------
    str
        A line.
    """
    from gbnbench.studies.set_library.costs import cost_machine, total_cost

    missing = [sets for sets in request.sets if sets not in there]
    groups: dict[tuple[str, int], list[RequestedSets]] = {}
    for sets in missing:
        groups.setdefault((sets.text, sets.d), []).append(sets)
    rows = []
    for (text, d), group in sorted(groups.items()):
        cost = total_cost(group)
        known = duration(cost.seconds) if cost.unknown < len(group) else NOTHING
        time = f"{'~' if cost.extrapolated else ''}{known}"
        megabytes = sum(sets.bytes for sets in group) / 1e6
        rows.append((text, f"{d}D", _sizes([s.n for s in group]), len(group), f"{megabytes:.3g}", time))
    if rows:
        yield from aligned(("generator", "", "n", "files", "MB", "CPU time"), rows)
    realizations = sum(sets.realizations for sets in missing)
    megabytes = sum(sets.bytes for sets in missing) / 1e6
    beside = f", {len(there):,} there already" if there else ""
    drawn = count(realizations, "set")
    yield f"{count(len(missing), 'file')} to be made{beside}: {drawn}, {megabytes:.3g} MB"
    yield from _refused_lines(request)
    cost = total_cost(missing)
    if not missing or cost.unknown == len(missing):
        return
    told = f"CPU time of one core: {duration(cost.measured)} for sizes whose cost was measured"
    if cost.extrapolated:
        told += f", about {duration(cost.extrapolated)} (~) for others, extrapolated from them"
    if cost.unknown:
        told += f", and {count(cost.unknown, 'file')} of unknown cost"
    yield f"{told} ({cost_machine()})"


def list_lines(manifest: Manifest) -> Iterator[str]:
    """List the files of a library with some of their measures.

    Parameters
    ----------
    manifest : Manifest
        Of the library.

    Yields
    ------
    str
        A line.
    """
    rows = [
        (entry.file, len(entry.realizations), *(number(entry.measures.get(m, math.nan)) for m in LISTED))
        for entry in manifest.files
    ]
    if rows:
        yield from aligned(("file", "sets", *HEADS), rows)
    yield (
        f"{count(len(rows), 'file')}, seed {manifest.seed}, gbnbench {manifest.gbnbench}; float64, "
        "(sets, n, d), on the torus [0, 1)^d"
    )
    if refused := len(manifest.refused):
        yield f"{refused:,} more were refused by their generators; manifest.json has the reasons"


def _refused_lines(request: LibraryRequest) -> Iterator[str]:
    """Say what each generator refuses, with its first reason."""
    by_generator: dict[str, list[tuple[int, int, str]]] = {}
    for entry in request.refused:
        by_generator.setdefault(entry.generator, []).append((entry.d, entry.n, entry.reason))
    for text, found in by_generator.items():
        found.sort()
        dimensions: dict[int, list[int]] = {}
        for d, n, _ in found:
            dimensions.setdefault(d, []).append(n)
        where = "; ".join(f"{d}D, n={_sizes(sizes)}" for d, sizes in dimensions.items())
        yield f"refused, {text}, {count(len(found), 'file')} ({where}), such as: {found[0][2]}"


def _sizes(n: Sequence[int]) -> str:
    """Write numbers of points, of many only the first and the last."""
    return ",".join(map(str, n)) if len(n) <= 3 else f"{n[0]}..{n[-1]}"
