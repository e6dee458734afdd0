"""The layout of floats without a header, told by which one gives points of the unit torus."""

from __future__ import annotations

import numpy as np

TINY = 1e-9
LAYOUTS = {"float32": "<f4", ">float32": ">f4", "float64": "<f8", ">float64": ">f8"}


def better_layout(data: bytes | memoryview, dtype: np.dtype) -> str | None:
    """Find the layout that gives points of the unit torus, where the one that is told does not.

    Parameters
    ----------
    data : bytes or memoryview
        Numbers alone.
    dtype : dtype
        What they are told to be.

    Returns
    -------
    str or None
        As ``--raw`` takes it, without the dimension; of doubles, floats where those fit too.
    """
    others = {name: np.dtype(layout) for name, layout in LAYOUTS.items() if np.dtype(layout) != dtype}
    if _plausible(data, dtype):
        # two floats of [0, 1] make one double of [0, 0.008]; one such double makes two floats only by zeros
        others = {name: other for name, other in others.items() if 2 * other.itemsize == dtype.itemsize}
        others = {
            name: other for name, other in others.items() if np.mean(np.frombuffer(data, other) != 0) > 0.5
        }
    return next((name for name, other in others.items() if _plausible(data, other)), None)


def _plausible(data: bytes | memoryview, dtype: np.dtype) -> bool:
    """Whether all lie in [0, 1], and none is as tiny as a float in the wrong order often is."""
    if len(data) % dtype.itemsize:
        return False
    values = np.frombuffer(data, dtype)
    with np.errstate(invalid="ignore"):  # signalling nan
        return bool(((values == 0) | ((values > TINY) & (values <= 1))).all())
