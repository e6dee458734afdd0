"""Balls on the torus: 1 within a distance of a random centre, 0 beyond."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.integration.integrands.ball_volume import ball_volume, radius_of
from gbnbench.analysis.integration.integrands.limits import beyond_dimensions, check_count, check_share
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.integer_frequencies import MOST_FREQUENCIES, half_ball, shell_counts
from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class Balls:
    """Indicators of balls that hold a given share of the torus, round uniform centres.

    Attributes
    ----------
    volume : float
        The share, 0 < volume < 1.

    Notes
    -----
    Functions of the torus, whose spectrum is known in closed form as long as the ball does not meet its own
    images: up to radius 1/2, which at volume 0.5 is up to 3 dimensions. Beyond, ``frequencies`` refuses.
    """

    name: ClassVar[str] = "ball"
    summary: ClassVar[str] = "ball about a random point of the torus: discontinuous in every direction"
    periodic: ClassVar[bool] = True
    volume: float = 0.5

    def __post_init__(self) -> None:
        if not 0 < self.volume < 1:
            raise InputError(
                f"volume of ball must be a share of the torus, 0 < volume < 1; got {self.volume}"
            )

    def refusal(self, d: int) -> str | None:
        """Return the reason why there are no such integrands in d dimensions, or None."""
        return beyond_dimensions("balls", d)

    def radius(self, d: int) -> float:
        """Radius of the ball, in box sides."""
        return radius_of(d, self.volume)

    def draw(self, d: int, rng: np.random.Generator) -> Ball:
        """Draw a ball by a uniform centre.

        Parameters, returns and errors are those of ``Family.draw``.
        """
        if reason := self.refusal(d):
            raise RefusalError(reason)
        return Ball(rng.random(d), self.radius(d))

    def mean_energy(self, frequencies: NDArray[np.int64]) -> FloatArray:
        """Energy of every ball, which does not depend on its centre: (m, d) -> (m,)."""
        return ball_energy(frequencies, self.radius(frequencies.shape[1]))

    def frequencies(self, d: int, share: float, most: int = MOST_FREQUENCIES) -> NDArray[np.int64]:
        """List half a ball of frequencies; those outside it hold less than a share of the energy.

        Parameters, returns and errors are those of ``Family.frequencies``.

        Notes
        -----
        The total is volume (1 - volume), by Parseval. Energy falls as |f|^-(d + 1), so that a share s lies
        beyond |f| of about 1/s, and small shares need too many frequencies.
        """
        check_share(share, self.refusal(d))
        radius = self.radius(d)
        volume = ball_volume(d, radius)
        target, longest = (1 - share) * volume * (1 - volume), 4
        while True:
            squares, counts = shell_counts(d, longest)
            energy = np.cumsum(counts[1:] * _shell_energy(d, np.sqrt(squares[1:]), radius))
            if energy[-1] > target:
                break
            check_count(
                f"even a ball that leaves out more than {share:g} of the energy",
                d,
                counts[1:].sum() / 2,
                most=most,
            )
            longest *= 2
        last = int(np.searchsorted(energy, target, side="right"))
        check_count(
            f"the ball that leaves out {share:g} of the energy", d, counts[1 : last + 2].sum() / 2, most=most
        )
        return half_ball(d, int(squares[last + 1]))


@dataclass(frozen=True, eq=False)
class Ball:
    """One ball: 1 within radius of the centre, toroidal distance.

    Attributes
    ----------
    centre : (d,) float64
        On the unit torus.
    radius : float
        In box sides.
    """

    centre: FloatArray
    radius: float

    @property
    def integral(self) -> float:
        """Volume, to 1e-13 (``ball_volume``)."""
        return ball_volume(len(self.centre), self.radius)

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values: (..., d) -> (...). Points within a rounding of the surface may fall on either side."""
        square = np.zeros(x.shape[:-1])
        for axis, c in enumerate(self.centre):
            u = x[..., axis] - c
            u -= np.rint(u)
            square += u * u
        values: FloatArray = (square <= self.radius**2).astype(np.float64)
        return values

    def energy(self, frequencies: NDArray[np.int64]) -> FloatArray:
        """|transform|^2 at integer frequencies, (m, d) -> (m,); RefusalError for a radius above 1/2."""
        return ball_energy(frequencies, self.radius)


def ball_energy(frequencies: NDArray[np.int64], radius: float) -> FloatArray:
    """Energy of a ball: (radius / |f|)^d J_{d/2}(2 pi radius |f|)^2, the squared volume at f = 0.

    Parameters
    ----------
    frequencies : (m, d) int64
        Frequencies, cycles per box side.
    radius : float
        Box sides, at most 1/2.

    Returns
    -------
    (m,) float64
        |transform of the indicator|^2.

    Raises
    ------
    RefusalError
        For a radius above 1/2: the ball meets its images.
    """
    length = np.sqrt((frequencies.astype(np.float64) ** 2).sum(axis=1))
    return _shell_energy(frequencies.shape[1], length, radius)


def _shell_energy(d: int, length: FloatArray, radius: float) -> FloatArray:
    from scipy.special import jv

    if radius > 0.5:
        raise RefusalError(
            f"the spectrum of a ball is known up to radius 1/2, where it begins to meet its images; got "
            f"{radius:.4g} in d={d}: take a volume up to {ball_volume(d, 0.5):.3g}"
        )
    safe = np.maximum(length, 0.5)
    energy: FloatArray = (radius / safe) ** d * jv(d / 2, 2 * math.pi * radius * safe) ** 2
    return np.where(length == 0, ball_volume(d, radius) ** 2, energy)
