"""The CPU time of making ready sets, from costs that were measured at some n."""

from __future__ import annotations

import csv
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files

from gbnbench.studies.set_library.operations import draw_operations
from gbnbench.studies.set_library.request import RequestedSets

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
        Whether this very size was measured; otherwise it is carried over from others.
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


def file_cost(sets: RequestedSets) -> tuple[CostEstimate, CostEstimate]:
    """Estimate the cost of one set of a file, and that of measuring all of them.

    Parameters
    ----------
    sets : RequestedSets
        Of the file.

    Returns
    -------
    set, measuring : CostEstimate

    Notes
    -----
    A cost that was measured is taken at another n in the ratio of the operations that the generator's own
    plan counts (``operations``), from the nearest measured size. Where nobody counts them it is taken for a
    power of n, which goes through the two nearest measured sizes, beyond the largest through sizes a factor
    of four apart and no less than linear.
    """

    def operations(n: int) -> float | None:
        return draw_operations(sets.generator, n, sets.d)

    measuring = _estimate(_rows().get((MEASURING, sets.d), []), sets.n, lambda _: None)
    share = sets.realizations / MEASURED_SETS
    one = _estimate(_rows().get((sets.text, sets.d), []), sets.n, operations)
    return one, CostEstimate(measuring.seconds * share, measuring.measured)


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


def _estimate(
    rows: Sequence[tuple[int, float]], n: int, operations: Callable[[int], float | None]
) -> CostEstimate:
    """Estimate the cost at n from pairs of n and CPU seconds, ascending."""
    for size, seconds in rows:
        if size == n:
            return CostEstimate(seconds, True)
    if len(rows) < 2:
        return CostEstimate(math.nan, False)
    nearest, cost = min(rows, key=lambda row: abs(math.log(n / row[0])))
    wanted, known = operations(n), operations(nearest)
    if wanted and known:
        return CostEstimate(cost * wanted / known, False)
    (n0, c0), (n1, c1) = _two_rows(rows, n)
    exponent = math.log(c1 / c0) / math.log(n1 / n0)
    if n > rows[-1][0]:
        exponent = max(1.0, exponent)
    return CostEstimate(cost * (n / nearest) ** exponent, False)


def _two_rows(rows: Sequence[tuple[int, float]], n: int) -> tuple[tuple[int, float], tuple[int, float]]:
    """Choose the rows that the law goes through."""
    above = next((k for k, (size, _) in enumerate(rows) if size > n), None)
    if above is not None:
        k = max(above, 1)
        return rows[k - 1], rows[k]
    last = rows[-1]
    return next((row for row in reversed(rows) if row[0] * 4 <= last[0]), rows[0]), last


@cache
def _rows() -> dict[tuple[str, int], list[tuple[int, float]]]:
    """Pairs of n and CPU seconds, ascending, by name and dimension."""
    found: dict[tuple[str, int], list[tuple[int, float]]] = {}
    for row in csv.DictReader(line for line in _lines() if not line.startswith("#")):
        pair = (int(row["n"]), float(row["cpu_seconds"]))
        found.setdefault((row["name"], int(row["d"])), []).append(pair)
    return {key: sorted(rows) for key, rows in found.items()}


def _lines() -> list[str]:
    return files("gbnbench.studies.set_library").joinpath(COSTS).read_text(encoding="utf-8").splitlines()
