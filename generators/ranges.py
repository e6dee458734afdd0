"""Ranges of settings and of sizes, and what is said where one is left."""

from __future__ import annotations

import math

from gbnbench.core.errors import InputError, RefusalError


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
        raise InputError(f"{name} must lie in [{_end(least)}, {_end(most)}]{_of(unit)}; got {value}")


def check_least(name: str, value: float, least: float, unit: str = "") -> None:
    """Refuse a setting that is too small, infinite or no number.

    Parameters
    ----------
    name : str
        Of the setting.
    value, least : float
        The setting, and the least that it may be.
    unit : str
        What it counts, for the message.

    Raises
    ------
    InputError
        If it is.

    Examples
    --------
    >>> check_least("passes", 3, 1)
    """
    if not least <= value < math.inf:
        finite = " and finite" if value == math.inf else ""
        raise InputError(f"{name} must be >= {_end(least)}{_of(unit)}{finite}; got {value}")


def check_above(name: str, value: float, above: float, most: float = math.inf, unit: str = "") -> None:
    """Refuse a setting that is no larger than a bound, larger than another, infinite or no number.

    Parameters
    ----------
    name : str
        Of the setting.
    value, above : float
        The setting, and what it must exceed.
    most : float
        The largest that it may be; without it any finite number will do.
    unit : str
        What it counts, for the message.

    Raises
    ------
    InputError
        If it is.

    Examples
    --------
    >>> check_above("tau", 0.1, 0, 0.3, "squared spacings")
    """
    if not (above < value <= most and value < math.inf):
        end = f"{_of(unit)} and finite" if most == math.inf else f" and at most {_end(most)}{_of(unit)}"
        raise InputError(f"{name} must be above {_end(above)}{end}; got {value}")


def _end(value: float) -> str:
    return str(value) if isinstance(value, int) else f"{value:g}"


def _of(unit: str) -> str:
    return f" {unit}" if unit else ""


def raise_refusal(reason: str | None) -> None:
    """Raise what a generator answers when it is asked why a set cannot be made.

    Parameters
    ----------
    reason : str or None
        From ``refusal``; with None nothing is raised.

    Raises
    ------
    RefusalError
        If there is a reason.

    Examples
    --------
    >>> raise_refusal(None)
    """
    if reason:
        raise RefusalError(reason)


def outside_plane(d: int, why: str) -> str | None:
    """Say that a method is one of the plane, with the reason.

    Parameters
    ----------
    d : int
        Dimension.
    why : str
        What the method does; "cmj is a method of the plane".

    Returns
    -------
    str or None
        The reason; None for d = 2.

    Examples
    --------
    >>> outside_plane(3, "cmj is a method of the plane")
    'cmj is a method of the plane; got d=3, use d=2'
    """
    return None if d == 2 else f"{why}; got d={d}, use d=2"


def too_many_axes(d: int, most: int, what: str) -> str | None:
    """Say that d is too large, with the largest that is not.

    Parameters
    ----------
    d, most : int
        Dimension, and the most it may be.
    what : str
        For what; "for Bridson's method".

    Returns
    -------
    str or None
        The reason; None for d <= most.

    Examples
    --------
    >>> too_many_axes(4, 3, "for a raster of densities")
    'd must be at most 3 for a raster of densities; got d=4, nearest is 3'
    """
    return None if d <= most else f"d must be at most {most} {what}; got d={d}, nearest is {most}"


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
