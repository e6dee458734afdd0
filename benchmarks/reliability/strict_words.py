"""Literals, and the two ways not to read a file, that strict readings share."""

from __future__ import annotations

DECIMAL = r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?"
QUOTED = r'(?<![^\s,#])"([0-9.eE+-]+)"(?![^\s,])'


Sets = list[list[tuple[float, ...]]]


class NoPointsError(Exception):
    """The strict reading refuses the file."""


def need(condition: object) -> None:
    """Refuse the file unless the condition holds."""
    if not condition:
        raise NoPointsError


class UndecidedError(Exception):
    """The strict reading does not know this kind of file; our reader has to decide alone."""


def known(condition: object) -> None:
    """Leave the file undecided unless the condition holds."""
    if not condition:
        raise UndecidedError


def tokens_of(line: str) -> list[str]:
    """Part a line by commas, else by blanks.

    Parameters
    ----------
    line : str
        Without blanks at its ends.

    Returns
    -------
    list of str
    """
    return [t.strip() for t in line.split(",")] if "," in line else line.split()


def read_point(tokens: list[str], d: int) -> tuple[float, ...]:
    """Read d numbers of [0, 1], whose upper end is the lower.

    Parameters
    ----------
    tokens : list of str
        Literals.
    d : int
        How many there have to be.

    Returns
    -------
    tuple of float
    """
    need(len(tokens) == d)
    values = [float(t) for t in tokens]
    need(all(0 <= v <= 1 for v in values))
    return tuple(0.0 if v == 1 else v for v in values)
