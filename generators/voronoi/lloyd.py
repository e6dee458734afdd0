"""Centroidal Voronoi tessellations by Lloyd's method on the torus (Lloyd 1982; Du et al. 1999)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import FloatArray, spacing
from gbnbench.generators.protocol import Family
from gbnbench.generators.voronoi.cells import move_to_centroids, toroidal_cells


@dataclass(frozen=True)
class Lloyd:
    """Uniform points moved again and again to the centroids of their toroidal Voronoi cells.

    Parameters
    ----------
    iterations : int
        Most steps, >= 0.
    tolerance : float
        Stop when no point moves by as much as this many spacings, >= 0.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    Cells and centroids are exact but for rounding (``gbnbench.generators.voronoi.cells``), so the energy, the
    sum over points of the integral of |y - x|**2 over the cell, never rises. Convergence is slow: with 1,024
    points in 2D the largest move is still a hundredth of a spacing after the default 200 steps.

    References
    ----------
    Lloyd, "Least squares quantization in PCM", IEEE Trans. Information Theory 28(2), 1982.

    Examples
    --------
    >>> Lloyd(iterations=5)(16, 2, np.random.default_rng(0)).shape
    (16, 2)
    """

    name: ClassVar[str] = "lloyd"
    summary: ClassVar[str] = (
        "centroidal Voronoi tessellation by Lloyd's method on the torus, d <= 3 (Lloyd 1982)"
    )
    family: ClassVar[Family] = "cellular"
    dimensions: ClassVar[tuple[int, int | None]] = (1, 3)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Lloyd, 1982; Du, Faber & Gunzburger, 1999"
    iterations: int = 200
    tolerance: float = 1e-3

    def __post_init__(self) -> None:
        if self.iterations < 0:
            raise InputError(f"iterations must be >= 0; got {self.iterations}")
        if not self.tolerance >= 0:
            raise InputError(f"tolerance must be >= 0 spacings; got {self.tolerance}")

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
            The reason; None for d <= 3.
        """
        return None if d <= 3 else f"d must be 1, 2 or 3 for Lloyd's method; got d={d}, nearest is 3"

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization, (n, d) float64; RefusalError where ``refusal`` has a reason."""
        if reason := self.refusal(n, d):
            raise RefusalError(reason)
        x = rng.random((n, d))
        margin = None
        for _ in range(self.iterations):
            cells = toroidal_cells(x, margin)
            x = move_to_centroids(x, cells)
            if np.linalg.norm(cells.offset, axis=1).max() < self.tolerance * spacing(n, d):
                break
            margin = 1.05 * cells.reach  # cells even out, and the border with them
        return x
