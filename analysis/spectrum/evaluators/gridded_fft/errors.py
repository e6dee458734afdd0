"""Errors of the gridded FFT, which grow where many points reach the same nodes."""

from __future__ import annotations

import math
from functools import lru_cache

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.coordinate_rounding import Coordinates, rounded_at_worst
from gbnbench.analysis.spectrum.error_model import UNIT, Errors
from gbnbench.analysis.spectrum.evaluators.gridded_fft.grid import RealGrid, transform_of_window

# In units of rounding. Typical: of scattered points, and for each point of the fullest bin; those that
# scattered points have there too are summed in runs. Worst, times what the window's gain magnifies: of any
# frequency, and for each addition at a node. The former is three times what was met on lattices and on points
# on a line. The latter is the proven bound of a sum of equal numbers on a line, of which a share is left for
# each further axis, since the nodes that a point reaches round differently: five times what was met on 600
# sets of points at one to five places.
TYPICAL, TYPICAL_CROWD = {"double": 5.0, "float": 3.0}, 0.04
WORST, WORST_ADDITION, SHARE_OF_AN_AXIS = 8.0, 0.5, 0.7
WINDOW_TYPICAL = {"double": 0.0, "float": 5e-8}  # of the window itself, where it is not below rounding


@lru_cache(maxsize=256)
def fft_errors(p: Precision, grid: RealGrid, n: int, crowd: int, runs: int, at: Coordinates) -> Errors:
    """State the errors of sqrt(power).

    Parameters
    ----------
    p : Precision
        Precision on the device.
    grid : RealGrid
        The grid.
    n : int
        Points of a set.
    crowd : int
        Points in the fullest bin, as deal_points.cl counts them.
    runs : int
        Runs in which the points are summed, at least 1.
    at : Coordinates
        Rounding of the coordinates.

    Returns
    -------
    Errors
        The typical error is that of scattered points as crowded as these. Unlike those of the products the
        bound is not proven, since no useful one is known for the FFT: its constants are three times what was
        met on lattices, lines, clusters and coincident points.
    """
    unit, magnified = UNIT[p.name], magnification(grid)
    rounded = 2 * math.pi * grid.fmax
    usual = min(crowd, usual_crowd(grid, n))
    typical = unit * math.hypot(TYPICAL[p.name], TYPICAL_CROWD * (usual / runs + crowd - usual))
    typical = math.hypot(typical, WINDOW_TYPICAL[p.name], rounded / math.sqrt(6) * at.scattered)
    additions = min(n, 2**grid.d * crowd) / runs + runs
    addition = WORST_ADDITION * SHARE_OF_AN_AXIS ** (grid.d - 1)
    relative = unit * magnified * (WORST + addition * additions) + grid.d * grid.window.left_out
    return Errors(typical, min(at.share * relative + rounded * at.coherent, 1.001 * at.share))


@lru_cache(maxsize=64)
def magnification(grid: RealGrid) -> float:
    """Give the ratio of the window's gain at zero frequency to that at the corner of the cube."""
    transform = transform_of_window(grid)
    return float(transform[0] / transform.min()) ** grid.d


@lru_cache(maxsize=64)
def usual_crowd(grid: RealGrid, n: int) -> int:
    """Count the points in the fullest bin of scattered points.

    Parameters
    ----------
    grid : RealGrid
        The grid.
    n : int
        Points of a set.

    Returns
    -------
    int
        Four standard deviations above the mean, and four points; at most n.
    """
    mean = n * (grid.width / grid.nodes) ** grid.d
    return min(n, math.ceil(mean + 4 * math.sqrt(mean) + 4))


def too_crowded(p: Precision, grid: RealGrid, n: int, crowd: int, runs: int, allowed: float) -> bool:
    """Tell whether a set is more crowded than by chance, and its typical error larger than is allowed.

    Parameters
    ----------
    p, grid, n, crowd, runs
        As in ``fft_errors``; ``runs`` may be 0 for a set that was given up.
    allowed : float
        Of sqrt(power).

    Returns
    -------
    bool
    """
    if runs == 0:
        return True
    if crowd <= usual_crowd(grid, n):
        return False
    return fft_errors(p, grid, n, crowd, runs, rounded_at_worst(n, grid.d, p.name)).rms > allowed


@lru_cache(maxsize=64)
def most_crowd(p: Precision, grid: RealGrid, n: int, allowed: float) -> int:
    """Count the points in the fullest bin beyond which a set is too crowded in any number of runs.

    Parameters
    ----------
    p, grid, n, allowed
        As in ``too_crowded``.

    Returns
    -------
    int
        At most n.
    """
    beyond_usual = allowed / (UNIT[p.name] * TYPICAL_CROWD)
    return n if beyond_usual >= n else min(n, usual_crowd(grid, n) + math.ceil(beyond_usual))
