"""A study of integration in words and numbers, as ``gbnbench integrate`` prints it."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from gbnbench.analysis.integration.variance import MOST_SCATTER
from gbnbench.cli.json_text import records
from gbnbench.core.footnotes import footnotes
from gbnbench.core.text_table import aligned, number
from gbnbench.studies.integration.reasons import slope_reasons, variance_reasons
from gbnbench.studies.integration.study_folder import IntegrationStudy

if TYPE_CHECKING:
    import pandas as pd

ABSENT = "this source has no sets of that size"
ONE_SIZE = "a slope needs two sizes n or more"


def as_record(study: IntegrationStudy) -> dict[str, Any]:
    """Return a study for JSON.

    Parameters
    ----------
    study : IntegrationStudy
        What was found.

    Returns
    -------
    dict
        ``variance`` and ``slopes``, the rows of its tables, each with ``reasons`` why numbers in it are null.
    """
    return {
        "variance": [{**row, "reasons": variance_reasons(row)} for row in records(study.variance)],
        "slopes": [{**row, "reasons": slope_reasons(row)} for row in records(study.slopes)],
    }


def as_lines(study: IntegrationStudy) -> Iterator[str]:
    """Lay out a table for each family and d: a row a source, a column an n, and the slope.

    Parameters
    ----------
    study : IntegrationStudy
        What was found.

    Returns
    -------
    iterator of str
        The lines; below each table the reasons of what is missing in it.
    """
    width = shutil.get_terminal_size((100, 24)).columns
    for _, part in study.variance.groupby(["integrand", "d"], sort=False):
        family, d = str(part["integrand"].iloc[0]), int(part["d"].iloc[0])
        slopes = study.slopes[(study.slopes["d"] == d) & (study.slopes["integrand"] == family)]
        sizes = sorted(part["n"].unique())
        predicted = ", [what the points' spectrum predicts]" if part["foretold"].notna().any() else ""
        yield f"\n{family}, d={d}: variance, its standard error{predicted}"
        groups = [(str(label), rows) for label, rows in part.groupby("source", sort=False)]
        yield from aligned(
            ("source", *(f"n={n}" for n in sizes), "slope"),
            [(label, *(_cell(rows, n) for n in sizes), _slope(slopes, label)) for label, rows in groups],
        )
        yield from footnotes(_missing(groups, slopes, sizes), width)


def _missing(
    groups: list[tuple[str, pd.DataFrame]], slopes: pd.DataFrame, sizes: list[int]
) -> Iterator[tuple[str, str]]:
    """Titles and reasons of the numbers that are missing in one table."""
    yield from ((f"n={n}", ABSENT) for n in sizes if any(n not in set(rows["n"]) for _, rows in groups))
    for label, rows in groups:
        for row in records(rows):
            reasons = variance_reasons(row)
            yield "standard error", reasons.get("standard_error", "")
            yield "prediction", reasons.get("foretold", "")
        mine = slopes[slopes["source"] == label]
        if mine.empty:
            yield "slope", ONE_SIZE
        for row in records(mine):
            reasons = slope_reasons(row)
            yield "slope", reasons.get("slope", "")
            yield "standard error of the slope", reasons.get("standard_error", "")


def _cell(rows: pd.DataFrame, n: int) -> str:
    there = rows[rows["n"] == n]
    if there.empty:
        return "-"
    row = there.iloc[0]
    known = row["foretold"] == row["foretold"]
    predicted = f" [{_predicted(row['foretold'], row['beyond'])}]" if known else ""
    spread = "" if row["standard_error"] != row["standard_error"] else f" ± {number(row['standard_error'])}"
    return f"{number(row['variance'])}{spread}{predicted}"


def _predicted(least: float, beyond: float) -> str:
    """Write what is predicted, as a range where the frequencies left out may matter."""
    most = f" to {number(least + beyond)}" if beyond > 0.02 * least else ""
    return number(least) + most


def _slope(slopes: pd.DataFrame, label: str) -> str:
    found = slopes[slopes["source"] == label]
    if found.empty:
        return "-"
    row = found.iloc[0]
    if row["slope"] != row["slope"]:
        return "-"
    spread = f" ± {row['standard_error']:.2f}" if row["standard_error"] == row["standard_error"] else ""
    bent = " bent" if row["scatter"] > MOST_SCATTER else ""
    return f"{row['slope']:.2f}{spread}{bent}"
