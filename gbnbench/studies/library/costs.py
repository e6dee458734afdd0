"""The CPU time of making ready sets, from costs that were measured: itself, or extrapolated in n."""

from __future__ import annotations

import csv
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # a worker loads the generators that it draws from, not all of them
    from gbnbench.studies.library.request import RequestedSets

COSTS = "measured_costs.csv"
MEASURING = "measuring"  # its name for the measures of eight sets
MEASURED_SETS = 8


@dataclass(frozen=True)
class CostEstimate:
    """CPU seconds of one thread.

    Attributes
    ----------
    seconds : float
        nan where nothing of the kind was measured.
    measured : bool
        Whether this very size was measured; otherwise the law between or beyond the nearest sizes is used.
    """

    seconds: float
    measured: bool


@dataclass(frozen=True)
class TotalCost:
    """CPU seconds of many files.

    Attributes
    ----------
    measured, extrapolated : float
        The parts whose sizes were measured, and those that are estimated from other sizes.
    unknown : int
        Files of whose generator or dimension nothing was measured; they are in neither part.
    """

    measured: float
    extrapolated: float
    unknown: int

    @property
    def seconds(self) -> float:
        """Both parts."""
        return self.measured + self.extrapolated


def set_cost(name: str, n: int, d: int) -> CostEstimate:
    """Estimate the cost of one set.

    Parameters
    ----------
    name : str
        A generator without settings, or ``"measuring"`` for the measures of eight sets.
    n, d : int
        Points and dimension.

    Returns
    -------
    CostEstimate

    Notes
    -----
    Between two measured sizes, and beyond the last, the cost is taken for a power of n: that of the two
    nearest measured sizes that are a factor of four apart or more, and linear at least beyond the last.
    """
    rows = _rows().get((name, d), [])
    for size, seconds in rows:
        if size == n:
            return CostEstimate(seconds, True)
    if len(rows) < 2:
        return CostEstimate(math.nan, False)
    above = next((k for k, (size, _) in enumerate(rows) if size > n), None)
    if above == 0:
        return CostEstimate(rows[0][1], False)  # smaller than any that was measured: no dearer
    if above is not None:
        (n0, c0), (n1, c1) = rows[above - 1], rows[above]
        return CostEstimate(c0 * (n / n0) ** (math.log(c1 / c0) / math.log(n1 / n0)), False)
    last, cost = rows[-1]
    size, before = next((row for row in reversed(rows) if row[0] * 4 <= last), rows[0])
    exponent = max(1.0, math.log(cost / before) / math.log(last / size))
    return CostEstimate(cost * (n / last) ** exponent, False)


def file_cost(sets: RequestedSets) -> tuple[CostEstimate, CostEstimate]:
    """Estimate the cost of one set of a file, and that of measuring all of them.

    Parameters
    ----------
    sets : RequestedSets
        Of the file.

    Returns
    -------
    set, measuring : CostEstimate
    """
    measuring = set_cost(MEASURING, sets.n, sets.d)
    share = sets.realizations / MEASURED_SETS
    return set_cost(sets.text, sets.n, sets.d), CostEstimate(measuring.seconds * share, measuring.measured)


def total_cost(requested: Sequence[RequestedSets]) -> TotalCost:
    """Add up what files cost.

    Parameters
    ----------
    requested : sequence of RequestedSets
        A file each.

    Returns
    -------
    TotalCost
    """
    parts = {True: 0.0, False: 0.0}
    unknown = 0
    for sets in requested:
        one, measuring = file_cost(sets)
        if math.isnan(one.seconds):
            unknown += 1
            continue
        parts[one.measured] += sets.realizations * one.seconds
        if not math.isnan(measuring.seconds):
            parts[measuring.measured] += measuring.seconds
    return TotalCost(parts[True], parts[False], unknown)


def cost_machine() -> str:
    """Return the machine on which costs were measured."""
    return next((line[1:].strip() for line in _lines() if line.startswith("#")), "")


@cache
def _rows() -> dict[tuple[str, int], list[tuple[int, float]]]:
    """Pairs of n and CPU seconds, ascending, by name and dimension."""
    found: dict[tuple[str, int], list[tuple[int, float]]] = {}
    for row in csv.DictReader(line for line in _lines() if not line.startswith("#")):
        pair = (int(row["n"]), float(row["cpu_seconds"]))
        found.setdefault((row["name"], int(row["d"])), []).append(pair)
    return {key: sorted(rows) for key, rows in found.items()}


def _lines() -> list[str]:
    return files("gbnbench.studies.library").joinpath(COSTS).read_text(encoding="utf-8").splitlines()
