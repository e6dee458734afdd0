"""Centroidal Voronoi tessellations on the torus, by Lloyd's method or L-BFGS (Liu et al. 2009)."""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray, spacing, wrap
from gbnbench.generators.protocol import MOST_ITERATIONS, Family
from gbnbench.generators.ranges import check_least, check_range, too_many_axes
from gbnbench.generators.set_by_set import SetBySet, Told
from gbnbench.generators.voronoi.cells import Cells, move_to_centroids, toroidal_cells


@dataclass(frozen=True)
class Lloyd(SetBySet):
    """Uniform points moved again and again to the centroids of their toroidal Voronoi cells.

    Parameters
    ----------
    iterations : int, optional
        Most steps, >= 0; without it 200 of Lloyd's, and 30 of L-BFGS, which lower the energy about as far.
    tolerance : float
        Stop when no centroid is as far as this many spacings from its point, >= 0.
    method : {"auto", "lloyd", "lbfgs"}
        Lloyd's steps, or those of a quasi-Newton method for the same energy; auto takes Lloyd's for d <= 2.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    Cells and centroids are exact but for rounding (``gbnbench.generators.voronoi.cells``), so with Lloyd's
    steps the energy, the sum over points of the integral of |y - x|**2 over the cell, never rises.
    Convergence is slow: with 1,024 points in 2D the largest move is still a hundredth of a spacing after 200
    steps. L-BFGS (Liu et al. 2009) goes by the same centroids, which are the energy's gradient, and is some
    seven times faster: of 1,000 points in 3D the energy is as low after 30 steps as after 170 of Lloyd's.

    A set of 1,000 points takes twice as long in 3D as in 2D, and some hundred times as long in 4D.

    References
    ----------
    Lloyd, "Least squares quantization in PCM", IEEE Trans. Information Theory 28(2), 1982. Liu, Wang, Lévy,
    Sun, Yan, Lu & Yang, "On centroidal Voronoi tessellation - energy smoothness and fast computation", ACM
    Trans. Graphics 28(4), 2009.

    Examples
    --------
    >>> Lloyd(iterations=5)(16, 2, np.random.default_rng(0)).shape
    (16, 2)
    """

    name: ClassVar[str] = "lloyd"
    summary: ClassVar[str] = (
        "centroidal Voronoi tessellation by Lloyd's method on the torus, d <= 4 (Lloyd 1982)"
    )
    family: ClassVar[Family] = "cellular"
    dimensions: ClassVar[tuple[int, int | None]] = (1, 4)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Lloyd, 1982; Liu et al., 2009"
    iterations: int | None = None
    tolerance: float = 1e-3
    method: Literal["auto", "lloyd", "lbfgs"] = "auto"

    def __post_init__(self) -> None:
        check_range("iterations", self.iterations or 0, 0, MOST_ITERATIONS)
        check_least("tolerance", self.tolerance, 0, "spacings")

    def refusal(self, n: int, d: int) -> str | None:  # noqa: ARG002 (the protocol's arguments)
        """Say why there are no Voronoi cells in d dimensions.

        Parameters
        ----------
        n : int
            Points; any number will do.
        d : int
            Dimension.

        Returns
        -------
        str or None
            The reason; None for d <= 4.
        """
        return too_many_axes(d, 4, "for Lloyd's method")

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        x = rng.random((n, d))
        if self.method == "lloyd" or (self.method == "auto" and d <= 2):
            return self._by_lloyd(x, 200 if self.iterations is None else self.iterations, told)
        return self._by_lbfgs(x, 30 if self.iterations is None else self.iterations, told)

    def _by_lloyd(self, x: FloatArray, iterations: int, told: Told) -> FloatArray:
        """Move all points to the centroids of their cells, again and again."""
        margin = None
        for done in range(iterations):
            told(done / iterations)
            cells = toroidal_cells(x, margin)
            x = move_to_centroids(x, cells)
            if self._at_rest(cells):
                break
            margin = 1.05 * cells.reach  # cells even out, and the border with them
        return x

    def _by_lbfgs(self, x: FloatArray, iterations: int, told: Told) -> FloatArray:
        """Lower the energy by L-BFGS, whose first step is one of Lloyd's where cells are equal."""
        from scipy.optimize import minimize

        n, margin = len(x), None

        def objective(places: NDArray[np.float64]) -> tuple[float, FloatArray]:
            nonlocal margin
            at = wrap(places.reshape(x.shape))
            cells = toroidal_cells(at, margin)
            margin = 1.05 * cells.reach
            if self._at_rest(cells):
                raise _AtRest(move_to_centroids(at, cells))
            return float(n * cells.energy.sum() / 2), -(n * cells.volume[:, None] * cells.offset).ravel()

        if iterations == 0:
            return x
        steps = itertools.count(1)

        def advance(xk: FloatArray) -> None:  # noqa: ARG001 (SciPy goes by the name)
            told(next(steps) / (iterations + 1))

        try:
            found = minimize(
                objective,
                x.ravel(),
                jac=True,
                method="L-BFGS-B",
                callback=advance,
                options={"maxiter": iterations, "maxfun": 20 * iterations, "ftol": 0.0, "gtol": 0.0},
            )
        except _AtRest as rest:
            return rest.points
        return wrap(found.x.reshape(x.shape))

    def _at_rest(self, cells: Cells) -> bool:
        """Tell whether no centroid is as far from its point as the tolerance."""
        largest = np.linalg.norm(cells.offset, axis=1).max()
        return bool(largest < self.tolerance * spacing(*cells.offset.shape))


class _AtRest(Exception):  # noqa: N818 (no error: the way out of the minimiser)
    """Points whose cells are within the tolerance of their centroids."""

    def __init__(self, points: FloatArray) -> None:
        super().__init__()
        self.points = points
