"""Electrostatic halftoning as a uniform sampler (Schmaltz, Gwosdek, Bruhn & Weickert 2010)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.gbn.ewald import EwaldEnergy
from gbnbench.generators.protocol import MOST_ITERATIONS, Family
from gbnbench.generators.ranges import check_above, check_range, too_many
from gbnbench.generators.set_by_set import SetBySet, Told

FORCE = {2: 2 * math.pi, 3: 4 * math.pi}  # of transforms 1 / k**2, over forces 1 / r and 1 / r**2
EVERY = 10  # iterations from one shaking to the next
STRONGEST = 1000.0  # of factors on the shaking: a hundred spacings or so
MOST = 20_000


@dataclass(frozen=True)
class Electrostatic(SetBySet):
    """Equal charges that repel one another in a uniform background, shaken ever less.

    Parameters
    ----------
    iterations : int
        Steps of all charges, >= 0.
    tau : float
        Step length over force, in squared spacings, above 0 and at most 0.3, beyond which steps overshoot.
    shaking : float
        Factor of the published shaking, 0 to 1000; 0 leaves it out.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    A charge moves by tau times the sum of forces 1/r (2D; 1/r**2 in 3D, which is ours) from the others and
    from the picture, here a black one whose pixels are the spacing. Every tenth step i each is shaken in a
    random direction by max(0, log2(iterations) - 6) exp(-i / 1000) / 10 pixels; ten steps follow the last
    shaking. The publication stops at the
    picture's border; on the torus all images of all charges act, by Ewald's sum, and the background with
    them: the nearest image alone would leave forces of its own at the border of its cell. From random points
    a step is at most one spacing. More iterations approach a triangular lattice.

    References
    ----------
    Schmaltz, Gwosdek, Bruhn & Weickert, "Electrostatic halftoning", Computer Graphics Forum 29(8), 2010.

    Examples
    --------
    >>> Electrostatic(iterations=3)(16, 2, np.random.default_rng(0)).shape
    (16, 2)
    """

    name: ClassVar[str] = "electrostatic"
    summary: ClassVar[str] = "electrostatic halftoning of a uniform density, d = 2, 3 (Schmaltz et al. 2010)"
    family: ClassVar[Family] = "kernel-based"
    dimensions: ClassVar[tuple[int, int | None]] = (2, 3)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Schmaltz, Gwosdek, Bruhn & Weickert, Electrostatic halftoning, 2010"
    iterations: int = 250
    tau: float = 0.1
    shaking: float = 1.0

    def __post_init__(self) -> None:
        check_range("iterations", self.iterations, 0, MOST_ITERATIONS)
        check_above("tau", self.tau, 0, 0.3, "squared spacings")
        check_range("shaking", self.shaking, 0, STRONGEST)

    def refusal(self, n: int, d: int) -> str | None:
        """Say why the charges are not moved.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason.
        """
        if d not in FORCE:
            return f"d must be 2 or 3 for forces 1/r and 1/r**2; got d={d}, nearest is {2 if d < 2 else 3}"
        return too_many(n, MOST, "for the sums to take no more than minutes")

    def one_set(self, n: int, d: int, rng: np.random.Generator, told: Told) -> FloatArray:
        """Draw one realization, as ``SetBySet.one_set`` says."""
        x = rng.random((n, d))
        if n == 1:
            return x
        energy = EwaldEnergy(n, d, 2.0 - d)
        for i in range(1, self.iterations + 1):
            told((i - 1) / self.iterations)
            step = -self.tau * FORCE[d] * energy(x)[1]
            length = np.linalg.norm(step, axis=1, keepdims=True)
            step /= np.maximum(length, 1.0)
            if i % EVERY == 0 and i + EVERY <= self.iterations and self.shaking:
                direction = rng.standard_normal((n, d))
                direction /= np.linalg.norm(direction, axis=1, keepdims=True)
                step += self.shaking * shaking_length(i, self.iterations) * direction
            x = wrap(x + step / energy.side)
        return x


def shaking_length(i: int, iterations: int) -> float:
    """Give the published length of the i-th shaking.

    Parameters
    ----------
    i : int
        Iteration, from 1.
    iterations : int
        All of them.

    Returns
    -------
    float
        In pixels.
    """
    return max(0.0, math.log2(iterations) - 6) * math.exp(-i / 1000) / 10
