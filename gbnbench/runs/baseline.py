"""The comparison of a run with an earlier one: changes of measures beyond three standard errors are told."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gbnbench.analysis.measure_definitions import DEFINITIONS, comparable_value
from gbnbench.runs.comparison_result import Run, SourceResult

LIMIT = 3.0  # standard errors of the difference
ROUNDING = 1e-9  # relative difference of two values that is none
FEW = 8  # sets below which a standard error is itself so uncertain that three of them are no rare event


@dataclass(frozen=True)
class Change:
    """One measure that moved beyond chance.

    Attributes
    ----------
    key, label, n, d
        The source in the new run.
    measure : str
        Name in the catalogue.
    before, after : float
        Its value in the baseline and now.
    deviations : float
        Size of the difference over its standard error; inf where neither run varies.
    verdict : {"better", "worse"}
        By the measure's direction.
    """

    key: str
    label: str
    n: int
    d: int
    measure: str
    before: float
    after: float
    deviations: float
    verdict: str


def judge(run: Run, baseline: Run) -> tuple[tuple[Change, ...], tuple[str, ...]]:
    """Compare two runs, source by source.

    Parameters
    ----------
    run, baseline : Run
        Rows are paired by label, n and d.

    Returns
    -------
    changes : tuple of Change
        Only where the difference exceeds three standard errors, sqrt(se1**2 + se2**2).
    notes : tuple of str
        Rows without a partner, rows that get no verdict because one side has a single realization, and
        rows of so few that a verdict may be chance.
    """
    old = {_row(source): source for source in baseline.sources}
    new = {_row(source): source for source in run.sources}
    notes = [f"{_say(row)}: not in the baseline" for row in new if row not in old]
    notes += [f"{_say(row)}: only in the baseline" for row in old if row not in new]
    changes: list[Change] = []
    for row, source in new.items():
        if row not in old:
            continue
        if source.sides != old[row].sides:
            notes.append(f"{_say(row)}: no verdict, its torus has other sides than in the baseline")
            continue
        if min(source.realizations, old[row].realizations) < 2:
            notes.append(f"{_say(row)}: no verdict from a single realization")
            continue
        if (fewest := min(source.realizations, old[row].realizations)) < FEW:
            notes.append(
                f"{_say(row)}: {fewest} realizations; below {FEW} chance alone often makes a verdict"
            )
        changes += _changes(source, old[row])
    return tuple(changes), tuple(notes)


def verdict(before: float, after: float, error: float, better: str) -> tuple[str, float]:
    """Return "better", "worse" or "" for one measure, and the difference in standard errors.

    Parameters
    ----------
    before, after : float
        The values.
    error : float
        Standard error of their difference; nan gives no verdict, 0 makes all but rounding count.
    better : {"lower", "higher"}
        The measure's direction.

    Returns
    -------
    word : {"better", "worse", ""}
        Empty where chance alone explains the difference.
    deviations : float
        Size of the difference in standard errors.
    """
    difference = after - before
    if not math.isfinite(difference) or math.isnan(error) or math.isclose(before, after, rel_tol=ROUNDING):
        return "", 0.0
    deviations = abs(difference) / error if error > 0 else math.inf
    if deviations <= LIMIT:
        return "", deviations
    return ("better" if (difference < 0) == (better == "lower") else "worse"), deviations


def _changes(after: SourceResult, before: SourceResult) -> list[Change]:
    changes = []
    for definition in DEFINITIONS:
        name = definition.name
        errors = [side.measures.standard_error.get(name, math.nan) for side in (before, after)]
        was, now = before.measures[name], after.measures[name]
        word, deviations = verdict(
            comparable_value(name, was, before.realizations),
            comparable_value(name, now, after.realizations),
            math.hypot(*errors),
            definition.better,
        )
        if word:
            changes.append(Change(after.key, after.label, after.n, after.d, name, was, now, deviations, word))
    return changes


def _row(source: SourceResult) -> tuple[str, int, int]:
    return source.label, source.n, source.d


def _say(row: tuple[str, int, int]) -> str:
    return f"{row[0]} (n={row[1]}, d={row[2]})"
