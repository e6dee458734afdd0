"""Reasons of the numbers that are missing in the tables of a study of integration."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

SINGLE = "needs two integrands or two sets; both are single here"
UNKNOWN = "nothing is predicted: not periodic, or its spectrum not known or too long here"


def variance_reasons(row: Mapping[str, Any]) -> dict[str, str]:
    """Say why columns of the table of variances are nan.

    Parameters
    ----------
    row : mapping
        A row of ``IntegrationStudy.variance``.

    Returns
    -------
    dict of str
        A reason for each column that is nan.
    """
    single = row["instances"] == row["realizations"] == 1
    reasons = {
        "standard_error": f"a standard error {SINGLE}",
        "low": f"a band {SINGLE}" if single else "the logarithm of a variance of 0 has no band",
        "bias_error": f"a standard error {SINGLE}",
        "foretold": UNKNOWN,
        "foretold_error": UNKNOWN if _missing(row["foretold"]) else f"a standard error {SINGLE}",
        "beyond": UNKNOWN,
        "deviation": "the difference of variance and prediction has no standard error above 0",
    }
    reasons["high"] = reasons["low"]
    if _missing(row["foretold_error"]):
        reasons["deviation"] = reasons["foretold_error"]
    return {name: reason for name, reason in reasons.items() if _missing(row[name])}


def slope_reasons(row: Mapping[str, Any]) -> dict[str, str]:
    """Say why columns of the table of slopes are nan.

    Parameters
    ----------
    row : mapping
        A row of ``IntegrationStudy.slopes``.

    Returns
    -------
    dict of str
        A reason for each column that is nan.
    """
    zero = "the logarithm of a variance of 0 has no slope"
    error = zero if _missing(row["slope"]) else f"a standard error {SINGLE} at every n"
    reasons = {"slope": zero, "scatter": zero, "standard_error": error}
    return {name: reason for name, reason in reasons.items() if _missing(row[name])}


def _missing(value: object) -> bool:
    return isinstance(value, float) and math.isnan(value)
