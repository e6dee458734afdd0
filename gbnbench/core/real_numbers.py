"""Real numbers from what a caller hands over: what numpy would cast in silence is refused."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gbnbench.core.errors import InputError


def as_real_numbers(value: ArrayLike, rule: str) -> NDArray[np.float64]:
    """Return value as float64.

    Parameters
    ----------
    value : array_like
        Real numbers of any shape.
    rule : str
        What the error says.

    Returns
    -------
    array of float64
        The same numbers; may share memory with value.

    Raises
    ------
    InputError
        If value has masked or complex entries, texts, dates, or anything else that is no real number.

    Examples
    --------
    >>> as_real_numbers([1, 2.5], "x must be real")
    array([1. , 2.5])
    """
    try:
        array = np.asarray(value)
        if array.dtype.kind not in "fiubO" or np.ma.is_masked(value):
            raise TypeError
        return np.asarray(array, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError(rule) from None
