"""Least values of whole numbers that a user gives."""

from __future__ import annotations

from gbnbench.core.errors import InputError


def require(**whole: tuple[int, int]) -> None:
    """Refuse numbers that are too small.

    Parameters
    ----------
    **whole : (int, int)
        By name, a value and the least that is allowed.

    Raises
    ------
    InputError
        If a value is below its least.

    Examples
    --------
    >>> require(n=(8, 1), seed=(0, 0))
    """
    for name, (value, least) in whole.items():
        if value < least:
            raise InputError(f"{name} must be at least {least}; got {value}")
