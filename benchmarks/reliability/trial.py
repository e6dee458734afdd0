"""The record of trials: how many of a kind came out in which way, and whether that is as it should be."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

WELL, FAULT, UNTRIED = "as it should be", "fault", "not tried"
NOTE = 300  # signs that are kept of what was said


@dataclass(frozen=True)
class Trials:
    """Trials of one kind that came out alike.

    Attributes
    ----------
    subject : str
        The format or command that was tried.
    tried : str
        What was done to it.
    outcome : str
        What came of it, in words.
    verdict : str
        ``WELL``, ``FAULT`` or ``UNTRIED``.
    count : int
        How many; 0 where nothing could be tried.
    note : str
        What was said in the first fault, or why nothing was tried.
    slowest : float
        Longest time of one, seconds; 0 where it was not taken.
    memory : float
        Most memory that one took, MB; 0 where it was not taken.
    """

    subject: str
    tried: str
    outcome: str
    verdict: str = WELL
    count: int = 1
    note: str = ""
    slowest: float = 0.0
    memory: float = 0.0


def summed(trials: Iterable[Trials]) -> list[Trials]:
    """Add up the trials of one subject, kind and outcome, in the order in which they first came."""
    found: dict[tuple[str, str, str, str], list[Trials]] = {}
    for one in trials:
        found.setdefault((one.subject, one.tried, one.outcome, one.verdict), []).append(one)
    return [
        Trials(
            *key,
            sum(one.count for one in alike),
            next((one.note for one in alike if one.note), ""),
            max(one.slowest for one in alike),
            max(one.memory for one in alike),
        )
        for key, alike in found.items()
    ]


def shortened(text: str) -> str:
    """Return a text in one line that fits a cell of the table."""
    line = " ".join(text.split())
    return line if len(line) <= NOTE else f"{line[: NOTE - 4]} ..."
