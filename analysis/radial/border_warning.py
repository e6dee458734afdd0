"""A warning where points seem to keep away from the border of a box, and so are no set of the torus."""

from __future__ import annotations

from itertools import permutations

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.radial.profile_measures import ROUNDING_POWER
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.results.spectrum import Spectrum

EDGE_RATIO = 5.0  # power at |f| = 1 and 2 over the diagonals beside them that only a border explains


def border_warnings(spectrum: Spectrum, radial: RadialPower) -> tuple[str, ...]:
    """Say where a set is not toroidal: a cut at the border puts power on the axes, not on the diagonals.

    Parameters
    ----------
    spectrum : Spectrum
        Of a cube, or of a box where the torus has unequal sides.
    radial : RadialPower
        Mean power of its exact shells.

    Returns
    -------
    tuple of str
        One sentence, or none.
    """
    by_square = (
        _of_box(spectrum)
        if spectrum.sides is not None
        else dict(zip(np.rint(radial.frequency**2).astype(int).tolist(), radial.power.tolist(), strict=True))
    )
    if spectrum.d < 2 or not {1, 2, 4, 5} <= set(by_square):
        return ()
    axes, diagonals = min(by_square[1], by_square[4]), (by_square[2] + by_square[5]) / 2
    if axes < max(EDGE_RATIO * diagonals, ROUNDING_POWER):
        return ()
    window = ",".join(f"0,{side:g}" for side in spectrum.sides or (1.0,) * spectrum.d)
    return (
        f"not toroidal? power on the axes, {by_square[1]:.2g} at |f| = 1, is {axes / diagonals:.2g} times "
        "that of the diagonals beside them, as when points keep away from the border of a box: low-frequency "
        "numbers then measure the border. Points that a window shows of a larger pattern are estimated by "
        f"gbnbench analyze FILE --window {window} (gbnbench.in_window), its ends in the file's unit",
    )


def _of_box(spectrum: Spectrum) -> dict[int, float]:
    """Mean power at f = e_a, e_a +- e_b, 2 e_a and 2 e_a +- e_b over all axes, by |f|^2."""
    if min(spectrum.harmonics) < 2:
        return {}
    centre = np.array(spectrum.harmonics)
    unit = np.eye(spectrum.d, dtype=np.int64)

    def mean(frequencies: list[NDArray[np.int64]]) -> float:
        return float(np.mean([spectrum.power[tuple(centre + f)] for f in frequencies]))

    pairs = [(unit[a], sign * unit[b]) for a, b in permutations(range(spectrum.d), 2) for sign in (1, -1)]
    return {
        1: mean(list(unit)),
        2: mean([a + b for a, b in pairs]),
        4: mean([2 * a for a in unit]),
        5: mean([2 * a + b for a, b in pairs]),
    }
