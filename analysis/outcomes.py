"""Outcomes of measures as arrays: values, or the words in which a measure was refused."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gbnbench.core.errors import RefusalError, ShortSpectrumError

Arrays = Mapping[str, NDArray[Any]]
REFUSALS = {kind.__name__: kind for kind in (RefusalError, ShortSpectrumError)}


def outcome(compute: Callable[[], ArrayLike]) -> NDArray[Any]:
    """Compute a measure, and keep a refusal.

    Parameters
    ----------
    compute : callable
        Gives numbers, or raises RefusalError.

    Returns
    -------
    array
        The numbers, or (2,) str: which error it was and its text.
    """
    try:
        return np.asarray(compute())
    except RefusalError as refusal:
        return np.array([type(refusal).__name__, str(refusal)])


def values_of(outcomes: Sequence[NDArray[Any]]) -> list[NDArray[Any]]:
    """Give the numbers of outcomes, one a piece.

    Parameters
    ----------
    outcomes : sequence of array
        As ``outcome`` returns them.

    Returns
    -------
    list of array

    Raises
    ------
    RefusalError
        That of the first piece which was refused.
    """
    for each in outcomes:
        if each.dtype.kind == "U":
            raise REFUSALS[str(each[0])](str(each[1]))
    return list(outcomes)


def is_refused(found: NDArray[Any]) -> bool:
    """Tell whether an outcome is a refusal.

    Parameters
    ----------
    found : array
        As ``outcome`` returns it.

    Returns
    -------
    bool
    """
    return found.dtype.kind == "U"


def within(piece: Arrays, name: str) -> dict[str, NDArray[Any]]:
    """Give the arrays of a piece whose names begin with ``name/``, without that beginning.

    Parameters
    ----------
    piece : mapping of arrays
        By name.
    name : str
        What the names begin with.

    Returns
    -------
    dict
    """
    start = f"{name}/"
    return {key.removeprefix(start): array for key, array in piece.items() if key.startswith(start)}
