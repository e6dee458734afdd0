"""A warning where points seem to keep away from the border of a box, and so are no set of the torus."""

from __future__ import annotations

import numpy as np

from gbnbench.analysis.radial.profile_measures import ROUNDING_POWER
from gbnbench.core.results.radial import RadialPower

EDGE_RATIO = 5.0  # power at |f| = 1 and 2 over the diagonals beside them that only a border explains


def border_warnings(radial: RadialPower, d: int) -> tuple[str, ...]:
    """Say where a set is not toroidal: a cut at the border puts power on the axes, not on the diagonals.

    Parameters
    ----------
    radial : RadialPower
        Mean power of the exact shells.
    d : int
        Dimension.

    Returns
    -------
    tuple of str
        One sentence, or none.
    """
    by_square = dict(
        zip(np.rint(radial.frequency**2).astype(int).tolist(), radial.power.tolist(), strict=True)
    )
    if d < 2 or not {1, 2, 4, 5} <= set(by_square):
        return ()
    axes, diagonals = min(by_square[1], by_square[4]), (by_square[2] + by_square[5]) / 2
    if axes < max(EDGE_RATIO * diagonals, ROUNDING_POWER):
        return ()
    return (
        f"not toroidal? power on the axes, {by_square[1]:.2g} at |f| = 1, is {axes / diagonals:.2g} times "
        "that of the diagonals beside them, as when points keep away from the border of a box: low-frequency "
        "numbers then measure the border",
    )
