"""Checks of the weights and the listed frequencies that a spectrum is asked for."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray


def check_weights(weights: ArrayLike | None, sets: int, n: int) -> FloatArray | None:
    """Check weights, and divide each set's by its largest, so that their squares cannot overflow.

    Parameters
    ----------
    weights : (n,) or (sets, n) array_like, or None
        What the user gave.
    sets, n : int
        Number of sets, and of points in each.

    Returns
    -------
    (1 or sets, n) float64, or None
        None where there are no weights.

    Raises
    ------
    InputError
        If they are not finite numbers, one for each point, or all 0 in some set.
    """
    if weights is None:
        return None
    try:
        given = np.asarray(weights)
        if given.dtype.kind not in "fiub" or isinstance(weights, np.ma.MaskedArray):
            raise TypeError
        w = np.ascontiguousarray(given, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError("weights must be real numbers, one for each point, none of them masked") from None
    if w.shape not in ((n,), (sets, n)):
        raise InputError(f"weights must be ({n},) or ({sets}, {n}), one for each point; got shape {w.shape}")
    w = w.reshape(-1, n)
    if not np.isfinite(w).all():
        raise InputError(f"weights must be finite; got {float(w[~np.isfinite(w)][0])!r}")
    largest = np.abs(w).max(axis=1, keepdims=True)
    if (largest == 0).any():
        raise InputError("weights are all 0 in a set; at least one point must count")
    scaled: FloatArray = w / largest  # power does not change, and squares cannot overflow
    return scaled


def check_frequencies(frequencies: ArrayLike, d: int) -> NDArray[np.int64]:
    """Check listed frequencies.

    Parameters
    ----------
    frequencies : (m, d) array_like
        What the user gave; floats are taken if they are whole.
    d : int
        Dimension.

    Returns
    -------
    (m, d) int64

    Raises
    ------
    InputError
        If they are not integers of 64 bits, or not (m, d) with m at least 1.
    """
    f = np.asarray(frequencies)
    if f.ndim != 2 or f.shape[1] != d or len(f) == 0:
        raise InputError(f"frequencies must be (m, {d}), one row a frequency, m >= 1; got shape {f.shape}")
    if f.dtype.kind == "f" and np.array_equal(f, np.rint(f)) and np.abs(f).max() < 2.0**63:
        f = f.astype(np.int64)
    if f.dtype.kind not in "iu" or (f.dtype.kind == "u" and f.max() >= 2**63):
        raise InputError(f"frequencies must be integers of 64 bits (cycles per unit length); got {f.dtype}")
    return f.astype(np.int64)
