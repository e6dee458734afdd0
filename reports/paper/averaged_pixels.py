"""Large images made smaller by averages over squares of pixels."""

from __future__ import annotations

from gbnbench.core.torus import FloatArray


def averaged(values: FloatArray, most: int | None) -> FloatArray:
    """Average squares of pixels, so that at most so many remain along the longer side.

    Parameters
    ----------
    values : (rows, columns) float64
        An image.
    most : int, optional
        Pixels; all of them if not given.

    Returns
    -------
    (rows, columns) float64
        Rows and columns that fill no square are left out.
    """
    part = 1 if most is None else -(-max(values.shape) // most)
    rows, columns = (size // part for size in values.shape)
    cut = values[: rows * part, : columns * part]
    found: FloatArray = cut.reshape(rows, part, columns, part).mean(axis=(1, 3))
    return found
