"""A claim of the paper, and the rows that measuring it gives."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import dataclass

from gbnbench.benchmarks.claims.sets import DrawnSets, SetCache

COLUMNS = (
    "claim", "row", "place", "quantity", "paper", "measured", "standard_error", "n", "d", "sets", "holds",
    "cpu_s",
)  # fmt: skip
YES, NO, PARTLY, UNTRIED, BESIDE = "yes", "no", "partly", "cannot be tried here", "-"
VERDICTS = (YES, PARTLY, NO, UNTRIED)


@dataclass(frozen=True)
class ClaimRow:
    """One measured number.

    Attributes
    ----------
    row : str
        What it is called within its claim.
    quantity : str
        What was measured, in words with its unit.
    paper : str
        The paper's value, or what would have to be met.
    measured, standard_error : float
        nan where there is none.
    n, d, sets : int
        Of the sets, 0 where there are none.
    holds : str
        One of ``VERDICTS``, or ``BESIDE`` for a number that decides nothing.
    """

    row: str
    quantity: str
    paper: str = ""
    measured: float = math.nan
    standard_error: float = math.nan
    n: int = 0
    d: int = 0
    sets: int = 0
    holds: str = BESIDE


Measure = Callable[[SetCache], Iterable[ClaimRow]]


@dataclass(frozen=True)
class Claim:
    """One statement of the paper.

    Attributes
    ----------
    name : str
        By which it is asked for.
    subject : str
        Under which the page has it.
    place : str
        Section, figure or equation of the paper.
    says : str
        What the paper states.
    note : str
        Why it holds or not; ``{row}`` stands for a measured number of this claim, ``{claim.row}`` of another.
    measure : callable
        Gives the rows; one that needs sets which are not there raises ``sets.MissingError``.
    """

    name: str
    subject: str
    place: str
    says: str
    note: str
    measure: Measure


def reported(
    name: str,
    quantity: str,
    paper: str = "",
    measured: float = math.nan,
    error: float = math.nan,
    *,
    of: DrawnSets | None = None,
    n: int = 0,
    d: int = 0,
    sets: int = 0,
    holds: str = BESIDE,
) -> ClaimRow:
    """Make a row of the table of claims.

    Parameters
    ----------
    name, quantity : str
        The row, and what was measured.
    paper : str
        What the paper says of it.
    measured, error : float
        The value and its standard error.
    of : DrawnSets, optional
        Sets that were measured; n, d and their number are taken from them.
    n, d, sets : int
        Points in a set, dimension and number of sets, where there are no drawn sets.
    holds : str
        The verdict.

    Returns
    -------
    ClaimRow
    """
    if of is not None:
        sets, n, d = of.x.shape
    return ClaimRow(name, quantity, paper, measured, error, n, d, sets, holds)


def holds(condition: bool, otherwise: str = NO) -> str:
    """Return the verdict of a criterion.

    Parameters
    ----------
    condition : bool
        Whether the criterion is met.
    otherwise : str
        The verdict where it is not.

    Returns
    -------
    str
    """
    return YES if condition else otherwise


def verdict(rows: Iterable[str]) -> str:
    """Return the verdict of a claim whose rows have these.

    Examples
    --------
    >>> verdict(["yes", "-"]), verdict(["yes", "no"]), verdict(["cannot be tried here"])
    ('yes', 'partly', 'cannot be tried here')
    """
    found = {row for row in rows if row not in (BESIDE, UNTRIED)}
    if not found:
        return UNTRIED
    return found.pop() if len(found) == 1 else PARTLY
