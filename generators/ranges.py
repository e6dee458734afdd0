"""Ranges of settings and of sizes, and what is said where one is left."""

from __future__ import annotations

from gbnbench.core.errors import InputError


def check_range(name: str, value: float, least: float, most: float, unit: str = "") -> None:
    """Refuse a setting that lies outside of its range or is no number.

    Parameters
    ----------
    name : str
        Of the setting.
    value, least, most : float
        The setting, and the ends of its range, which belong to it.
    unit : str
        What it counts, for the message.

    Raises
    ------
    InputError
        If it does.

    Examples
    --------
    >>> check_range("power", 16, 2, 100)
    """
    if not least <= value <= most:
        of = f" {unit}" if unit else ""
        raise InputError(f"{name} must lie in [{least:g}, {most:g}]{of}; got {value}")


def too_many(n: int, most: int, what: str) -> str | None:
    """Say that n is too large, with the largest that is not.

    Parameters
    ----------
    n, most : int
        Points, and the most there may be.
    what : str
        For whom; "for Bridson's method".

    Returns
    -------
    str or None
        The reason; None for n <= most.

    Examples
    --------
    >>> too_many(101, 100, "for a set by hand")
    'n must be at most 100 for a set by hand; got n=101, nearest is 100'
    """
    return None if n <= most else f"n must be at most {most} {what}; got n={n}, nearest is {most}"
