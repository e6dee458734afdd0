"""Least values of whole numbers that a user gives."""

from __future__ import annotations

import numbers

from gbnbench.core.errors import InputError


def require(**whole: tuple[int, int]) -> None:
    """Refuse numbers that are not whole or too small.

    Parameters
    ----------
    **whole : (int, int)
        By name, a value and the least that is allowed.

    Raises
    ------
    InputError
        If a value is no whole number, or below its least.

    Examples
    --------
    >>> require(n=(8, 1), seed=(0, 0))
    """
    for name, (value, least) in whole.items():
        if isinstance(value, bool) or not isinstance(value, numbers.Integral):
            raise InputError(f"{name} must be a whole number; got {value!r}")
        if value < least:
            raise InputError(f"{name} must be at least {least}; got {value}")


def whole_number(name: str, value: object, least: int) -> int:
    """Return a whole number that a user gives, of any type of integer, as a plain int.

    Parameters
    ----------
    name : str
        Of the argument.
    value : object
        What was given.
    least : int
        The least that it may be.

    Returns
    -------
    int

    Raises
    ------
    InputError
        If it is no whole number, or below its least.

    Examples
    --------
    >>> whole_number("copies", 3, 1)
    3
    """
    if not isinstance(value, numbers.Integral) or isinstance(value, bool) or int(value) < least:
        raise InputError(f"{name} must be a whole number >= {least}; got {value!r}")
    return int(value)
