"""Limits of the families of integrands: dimensions, the length of a list of frequencies, shares of energy."""

from __future__ import annotations

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.integer_frequencies import MOST_FREQUENCIES

MOST_DIMENSIONS = 20  # as far as every family's numbers are proven


def beyond_dimensions(what: str, d: int) -> str | None:
    """Say why a family has no integrand in d dimensions.

    Parameters
    ----------
    what : str
        The family, in the plural.
    d : int
        Dimension.

    Returns
    -------
    str or None
        The reason; None where there is one.
    """
    if 1 <= d <= MOST_DIMENSIONS:
        return None
    return f"{what} are for d = 1 to {MOST_DIMENSIONS}; got d={d}"


def check_count(
    what: str,
    d: int,
    count: float,
    way_out: str = "leave out a larger share",
    most: int = MOST_FREQUENCIES,
) -> None:
    """Refuse a list of more frequencies than the caller or the memory can take.

    Parameters
    ----------
    what : str
        What has the frequencies, for the message.
    d : int
        Dimension.
    count : float
        Length of the list.
    way_out : str
        What to ask for instead.
    most : int
        Longest list.

    Raises
    ------
    RefusalError
        If count is above most.
    """
    if count > most:
        raise RefusalError(
            f"{what} in d={d} has {count:.0f} frequencies, one of each pair f, -f; "
            f"at most {most} are listed: {way_out}"
        )


def check_share(share: float, refusal: str | None) -> None:
    """Refuse a dimension that a family does not serve, and a share that is not between 0 and 1.

    Parameters
    ----------
    share : float
        Share of the energy to leave out.
    refusal : str or None
        The family's reason against this dimension.

    Raises
    ------
    RefusalError
        If there is a refusal.
    InputError
        If share is not between 0 and 1.
    """
    if refusal is not None:
        raise RefusalError(refusal)
    if not 0 < share < 1:
        raise InputError(f"share must be of the energy to leave out, 0 < share < 1; got {share}")
