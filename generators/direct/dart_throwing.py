"""Dart throwing: uniform points, each refused that falls within a radius of an earlier one (Cook 1986)."""

from __future__ import annotations

import math
import warnings
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import HERMITE, FloatArray, densest_spacing
from gbnbench.generators.direct.poisson_disk import throw_darts
from gbnbench.generators.protocol import Family
from gbnbench.generators.ranges import check_above, check_range, too_many, too_many_axes
from gbnbench.generators.set_by_set import SetBySet, Told

SHRINK = 0.99  # the radius, when no dart finds room
CELL_DIMENSIONS = 6  # beyond, discs hold few cells and nearly all darts are thrown
MOST_POINTS = 4096  # there, at a hundred darts a point: a few minutes


@dataclass(frozen=True)
class DartThrowing(SetBySet):
    """Points no two of which are nearer than a radius, drawn one after another from those that are left.

    Parameters
    ----------
    radius : float
        Least distance of two points, in that of the densest lattice of n points (Lagae & Dutré's relative
        radius, d_hex in 2D); above 0, at most 1.
    attempts : int
        Most darts for each point before the radius gives way, in [1, 1e6].

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    The first n darts that stand. Where no room is left for the n-th, or the attempts are spent, the radius is
    made smaller by a hundredth and the throwing goes on (McCool & Fiume 1992): with the default this happens
    in 1D, where .7476 is all that fits in the mean, and from 6D on, to .69 or more; of another radius that
    gives way a ``RuntimeWarning`` tells.

    Darts are thrown only at cells that no single disc covers, which are halved as they grow fewer (Ebeida et
    al. 2012). Every dart left out would be refused, so that the sets are those of plain dart throwing on the
    torus, at seven or eight darts a point in 2D where plain throwing takes a hundred.

    References
    ----------
    Dippé & Wold, "Antialiasing through stochastic sampling", SIGGRAPH 1985. Cook, "Stochastic sampling in
    computer graphics", ACM TOG 5(1), 1986. McCool & Fiume, "Hierarchical Poisson disk sampling
    distributions", Graphics Interface 1992. Lagae & Dutré, "A comparison of methods for generating Poisson
    disk distributions", CGF 27(1), 2008.

    Examples
    --------
    >>> DartThrowing()(64, 2, np.random.default_rng(0)).shape
    (64, 2)
    """

    name: ClassVar[str] = "darts"
    summary: ClassVar[str] = "dart throwing on the torus at a relative radius (Cook 1986; Lagae & Dutré 2008)"
    family: ClassVar[Family] = "direct"
    dimensions: ClassVar[tuple[int, int | None]] = (1, len(HERMITE))
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Dippé & Wold, 1985; Cook, 1986; Lagae & Dutré, 2008"
    radius: float = 0.75
    attempts: int = 100

    def __post_init__(self) -> None:
        check_above("radius", self.radius, 0, 1, "densest spacings")
        check_range("attempts", self.attempts, 1, 10**6)

    def refusal(self, n: int, d: int) -> str | None:
        """Say why there is no relative radius in d dimensions, or why n is too large where d is.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason, with the nearest numbers that can; None where they can.
        """
        if reason := too_many_axes(d, len(HERMITE), "for a radius relative to the densest lattice"):
            return reason
        most = n if d <= CELL_DIMENSIONS else int(MOST_POINTS * math.sqrt(100 / self.attempts))
        return too_many(n, most, f"for dart throwing with {self.attempts} darts a point in d={d}")

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        unit = densest_spacing(n, d)
        radius = wanted = self.radius * unit
        x: FloatArray = np.empty((0, d))
        while len(x) < n:  # ends: any n points fit at some radius, and it halves in 69 rounds
            x, _ = throw_darts(x, radius, n, rng, darts_a_point=self.attempts, told=told)
            last, radius = radius, radius * SHRINK
        if last < wanted and self.radius != type(self).radius:
            warnings.warn(
                f"darts: n={n} points in d={d} found room at a relative radius of {last / unit:.3g}; "
                f"radius={self.radius:g} was asked for",
                RuntimeWarning,
                stacklevel=2,
            )
        return x
