"""Keys of the tasks of a comparison, which are also the names of what they leave in its folder."""

from __future__ import annotations

PIECE = "measured-"  # begins the last part of a piece's key


def realization_key(source: str, k: int) -> str:
    """Name the task that makes a realization.

    Parameters
    ----------
    source : str
        The key of its source.
    k : int
        Its number.

    Returns
    -------
    str
    """
    return f"{source}/{k:06d}"


def piece_key(source: str, first: int) -> str:
    """Name the task that measures a piece of a source's realizations.

    Parameters
    ----------
    source : str
        The key of the source.
    first : int
        The number of the first of them.

    Returns
    -------
    str
    """
    return f"{source}/{PIECE}{first:06d}"
