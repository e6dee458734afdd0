"""Verdicts on measured values: the departure from what is expected, its side, and a sentence for it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from gbnbench.analysis.measure_definitions import BY_NAME
from gbnbench.core.number_text import number
from gbnbench.regression.cases import Case, Expectation, Values

Word = Literal["ok", "better", "worse", "skipped"]


@dataclass(frozen=True)
class Verdict:
    """One measure of one case.

    Attributes
    ----------
    case : Case
        Which.
    measure : str
        Its name.
    found : tuple of float
        What was measured; empty where nothing could be.
    word : {"ok", "better", "worse", "skipped"}
        What it comes to.
    departure : float
        On the measure's scale: a factor, a signed difference, or a relative error; nan where unknown.
    text : str
        One sentence that names the case, empty where all is well.
    """

    case: Case
    measure: str
    found: Values
    word: Word
    departure: float
    text: str = ""

    @property
    def expectation(self) -> Expectation:
        """What it is judged against."""
        return self.case.measures[self.measure]


def judge(case: Case, measure: str, found: Values) -> Verdict:
    """Judge one measure.

    Parameters
    ----------
    case : Case
        With the expectation.
    measure : str
        Name of the measure.
    found : tuple of float
        What it is now; nan, or another number of values than expected, is worse than anything.

    Returns
    -------
    Verdict
    """
    expectation = case.measures[measure]
    name = f"{case.name}: {title(measure)}"
    if len(found) != len(expectation.expected) or not all(map(math.isfinite, found)):
        return Verdict(case, measure, found, "worse", math.nan, f"{name} is undefined; expected a number")
    departure, limit = departed(expectation, found), expectation.tolerance
    if expectation.scale == "ratio":
        size, higher = max(departure, 1 / departure if departure else math.inf), departure > 1
    else:
        size, higher = abs(departure), departure > 0
    if size <= limit:
        return Verdict(case, measure, found, "ok", departure)
    word: Word = "better" if expectation.better == ("higher" if higher else "lower") else "worse"
    return Verdict(case, measure, found, word, departure, f"{name} {_said(expectation, found, departure)}")


def failed(case: Case, failure: str) -> list[Verdict]:
    """Judge a case that could not be measured.

    Parameters
    ----------
    case : Case
        The case.
    failure : str
        What went wrong.

    Returns
    -------
    list of Verdict
        One a measure.
    """
    return _once(case, "worse", f"{case.name}: could not be measured: {failure}")


def skipped(case: Case, reason: str) -> list[Verdict]:
    """Pass over a case that this device cannot run.

    Parameters
    ----------
    case : Case
        The case.
    reason : str
        Why it cannot run.

    Returns
    -------
    list of Verdict
        One a measure.
    """
    return _once(case, "skipped", f"{case.name}: skipped: {reason}")


def _once(case: Case, word: Word, text: str) -> list[Verdict]:
    """Give every measure of a case one verdict, said once."""
    return [
        Verdict(case, measure, (), word, math.nan, "" if k else text)
        for k, measure in enumerate(case.measures)
    ]


def departed(expectation: Expectation, found: Values) -> float:
    """Compute the departure on the measure's scale, the largest where there are several values.

    Parameters
    ----------
    expectation : Expectation
        What is expected, and the scale.
    found : tuple of float
        What was measured.

    Returns
    -------
    float
        A factor, a signed difference, or a relative error.
    """
    if expectation.scale == "ratio":
        return found[0] / expectation.expected[0]
    difference = max((f - e for f, e in zip(found, expectation.expected, strict=True)), key=abs)
    if expectation.scale == "difference":
        return difference
    return difference / max(map(abs, expectation.expected))


def title(measure: str) -> str:
    """Call a measure what tables call it."""
    return BY_NAME[measure].title if measure in BY_NAME else measure.replace("_", " ")


def shown(values: Values) -> str:
    """Write a value, or the largest of several and how many they are."""
    if len(values) == 1:
        return number(values[0])
    return f"{len(values)} to {number(max(map(abs, values)))}" if values else number(math.nan)


def allowed(expectation: Expectation) -> str:
    """Write the tolerance as a table shows it."""
    if expectation.scale == "ratio":
        sign = {"lower": "≤ ×", "higher": "≥ /", "neither": "×/÷ "}[expectation.better]
        return f"{sign}{number(expectation.tolerance)}"
    if expectation.scale == "relative":
        return f"rel. {number(expectation.tolerance)}"
    sign = {"lower": "≤ +", "higher": "≥ −", "neither": "±"}[expectation.better]
    return f"{sign}{number(expectation.tolerance)}"


def _said(expectation: Expectation, found: Values, departure: float) -> str:
    limit, expected = expectation.tolerance, list(expectation.expected)
    if expectation.scale == "relative":
        values = "the exact value" if len(expected) == 1 else f"the {len(expected)} exact values"
        return f"departs from {values} by {number(abs(departure))} of the largest (at most {number(limit)})"
    if expectation.scale == "ratio":
        bound = f"at most {number(limit)}" if departure > 1 else f"at least {number(1 / limit)}"
        return (
            f"{number(found[0])} is {number(departure)} times the expected {number(expected[0])} "
            f"({bound} times)"
        )
    if len(expected) > 1:
        return (
            f"departs by {number(abs(departure))} from the {len(expected)} expected (at most {number(limit)})"
        )
    side = "above" if departure > 0 else "below"
    return (
        f"{number(found[0])} is {number(abs(departure))} {side} the expected {number(expected[0])} "
        f"(at most {number(limit)})"
    )
