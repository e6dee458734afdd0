"""Groups of axes and their frequencies, of which a spectrum is the product of two."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.spectrum.digits import Axes, half_size


@dataclass(frozen=True)
class Group:
    """All or some frequencies of the half space of a group of axes.

    Attributes
    ----------
    axes : tuple of Axis
        The axes.
    order : (count,) uint64 or None
        Indices of the frequencies in base-(2F+1) digits; None for the whole half space in its own order.
    """

    axes: Axes
    order: NDArray[np.uint64] | None = None

    @property
    def count(self) -> int:
        """Number of frequencies."""
        return half_size(self.axes) if self.order is None else len(self.order)
