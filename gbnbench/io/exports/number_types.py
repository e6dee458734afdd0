"""The types in which coordinates are exported, and what rounding to them makes of the points of a torus."""

from __future__ import annotations

from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, fixed_point

NumberType = Literal["float32", "float64", "uint32"]
TURN = 2.0**32  # of uint32, where whole numbers are fractions of a turn


def check_number_type(name: str) -> NumberType:
    """Return the name of a type, or raise an InputError that lists those there are."""
    if name not in get_args(NumberType):
        raise InputError(f"type must be one of {', '.join(get_args(NumberType))}; got {name!r}")
    return name  # type: ignore[return-value]


def rounded(x: FloatArray, number_type: NumberType) -> NDArray[Any]:
    """Round points to a type.

    Parameters
    ----------
    x : (...) float64
        Coordinates in [0, 1).
    number_type : {"float32", "float64", "uint32"}
        uint32 counts 2**-32 of a side.

    Returns
    -------
    (...) float32, float64 or uint32
        The nearest numbers. What would be rounded up to 1 is 0, the same place on a torus, so that all stay
        below 1.
    """
    if number_type == "uint32":
        return fixed_point(x, 32)
    near = x.astype(np.dtype(number_type))
    near[near >= 1] = 0
    return near


def fractions(values: NDArray[Any]) -> FloatArray:
    """Return rounded coordinates as float64 fractions, exactly.

    Parameters
    ----------
    values : (...) float32, float64 or uint32
        As ``rounded`` returns them.

    Returns
    -------
    (...) float64
        In [0, 1).
    """
    exact: FloatArray = values.astype(np.float64)
    return exact / TURN if values.dtype == np.uint32 else exact
