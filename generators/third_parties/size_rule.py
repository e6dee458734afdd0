"""Rules that numbers of points keep: ``m**d``, ``2**m``, or a list."""

from __future__ import annotations

from typing import Literal

SizeRule = Literal["any", "m**d", "2**m"] | tuple[int, ...]
FORMS = ("any", "m**d", "2**m")


def size_refusal(rule: SizeRule, name: str, n: int, d: int) -> str | None:
    """Say why a number of points breaks a rule, and which near by keeps it.

    Parameters
    ----------
    rule : {"any", "m**d", "2**m"} or tuple of int
        Any number, a power d of a whole number, a power of two, or the numbers that there are.
    name : str
        Of the generator, for the message.
    n, d : int
        Points and dimension.

    Returns
    -------
    str or None
        The reason; None where n keeps the rule.

    Examples
    --------
    >>> size_refusal("m**d", "mine", 60, 2)
    'n must be m**2 for mine; got n=60, nearest is 64'
    >>> size_refusal((100, 200), "mine", 120, 2), size_refusal("2**m", "mine", 16, 2)
    ('n must be one of 100, 200 for mine; got n=120, nearest is 100', None)
    """
    if rule == "any":
        return None
    if rule == "m**d":
        m = round(n ** (1 / d))
        sizes = tuple(side**d for side in range(max(m - 1, 1), m + 2))
        words = f"m**{d}"
    elif rule == "2**m":
        power = n.bit_length() - 1
        sizes = (2**power, 2 ** (power + 1))
        words = "2**m"
    else:
        sizes = rule
        words = f"one of {', '.join(map(str, sizes))}"
    nearest = min(sizes, key=lambda size: abs(size - n))
    return None if nearest == n else f"n must be {words} for {name}; got n={n}, nearest is {nearest}"
