"""Polish, an extension of the paper: the lowest band emptied to rounding by the least move."""

from __future__ import annotations

from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gauss_newton.solver import solve_for_amplitudes

WITH_ITS_END = 1e-9  # of the edge: shells that lie on it belong to the band


def empty_band(x: FloatArray, edge: float) -> FloatArray:
    """Empty the band 0 < nu <= edge of one set.

    Parameters
    ----------
    x : (n, d) float64
        Gaussian Blue Noise on the torus; the farther it has come, the less it moves: 1e-5 spacings at the
        paper's quality and edge 0.25.
    edge : float
        In nu.

    Returns
    -------
    (n, d) float64

    Raises
    ------
    RefusalError
        If the band cannot be emptied.
    """
    outcome = solve_for_amplitudes(x, 0.0, edge * (1 + WITH_ITS_END))
    if not outcome.converged:
        raise RefusalError(f"polish={edge:g} cannot empty its band: {outcome.reason}; take a lower edge")
    return outcome.x
