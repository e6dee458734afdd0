"""Rows of tables for JSON, each with the reasons of its numbers that are missing."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from gbnbench.cli.json_text import records

if TYPE_CHECKING:
    import pandas as pd

ONE_SET = "one value has no spread: more realizations or instances give one"
NOT_PREDICTED = "the integrand is not periodic, or its spectrum is not known or too long to sum here"
VARIANCE = {
    "standard_error": ONE_SET,
    "low": ONE_SET,
    "high": ONE_SET,
    "bias_error": ONE_SET,
    "foretold": NOT_PREDICTED,
    "foretold_error": f"{NOT_PREDICTED}; or {ONE_SET}",
    "beyond": NOT_PREDICTED,
    "deviation": f"{NOT_PREDICTED}; or {ONE_SET}",
}
SLOPE = "a variance is 0 to rounding, whose logarithm is unknown"
SLOPES = {"slope": SLOPE, "scatter": SLOPE, "standard_error": f"{SLOPE}; or {ONE_SET}"}
SPECTRUM = {
    "anisotropy_db": "the ring holds a single pair of frequencies on each shell, or power that is rounding"
}
MEASURES = {"value": "", "standard_error": "the value is missing, or of a single set, which has no spread"}


def with_reasons(table: pd.DataFrame, reasons: Mapping[str, str]) -> list[dict[str, Any]]:
    """Return the rows of a table, with an object ``reasons`` where a number is missing.

    Parameters
    ----------
    table : DataFrame
        Missing numbers are nan.
    reasons : mapping of str
        Why a number of a column may be missing. A column of the table that is called ``reason`` holds that of
        the row's ``value``.

    Returns
    -------
    list of dict
    """
    rows = records(table)
    for row in rows:
        missing = [name for name in reasons if name in row and row[name] != row[name]]  # nan alone differs
        if missing:
            row["reasons"] = {name: reasons[name] or str(row.get("reason", "")) for name in missing}
    return rows
