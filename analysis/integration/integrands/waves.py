"""Band-limited sums of waves of random frequency and phase, whose variance a spectrum predicts exactly."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.integration.integrands.kernel_values import coordinate_rows, evaluate, run_kernel
from gbnbench.analysis.integration.integrands.limits import beyond_dimensions, check_count, check_share
from gbnbench.analysis.precision import Precision
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.integer_frequencies import MOST_FREQUENCIES, half_ball, half_count, to_half_space
from gbnbench.core.torus import FloatArray, fixed_point

POINTS = 512  # the unit of reach is the nominal frequency of so many points, as that of the Gaussians' width
RADIANS = 2 * math.pi / 2.0**64


@dataclass(frozen=True)
class Waves:
    """Sums of cos 2 pi (f . x + phase), frequencies f uniform over those with 0 < |f| <= reach 512^(1/d).

    Attributes
    ----------
    count : int
        Waves of a sum, >= 1; a frequency may come twice.
    reach : float
        Largest |f| in nominal frequencies of 512 points, > 0; at least |f| = 1 is reached.

    Notes
    -----
    For points shifted at random on the torus, the variance of the estimate is exactly the sum of energy times
    P(f) / n over these frequencies, since the integrand has no others.
    """

    name: ClassVar[str] = "waves"
    summary: ClassVar[str] = "band-limited sum of waves of random frequency and phase"
    periodic: ClassVar[bool] = True
    count: int = 64
    reach: float = 1.0

    def __post_init__(self) -> None:
        if self.count < 1:
            raise InputError(f"count of waves must be at least 1; got {self.count}")
        if not (math.isfinite(self.reach) and self.reach > 0):
            raise InputError(f"reach of waves must be positive; got {self.reach}")

    def square(self, d: int) -> int:
        """Largest |f|^2."""
        return max(1, math.floor((self.reach * math.pow(POINTS, 1 / d)) ** 2 * (1 + 1e-12)))

    def refusal(self, d: int) -> str | None:
        """Return the reason why there are no such integrands in d dimensions, or None."""
        if reason := beyond_dimensions("sums of waves", d):
            return reason
        try:
            check_count(
                f"reach={self.reach:g} of waves", d, half_count(d, self.square(d)), "take a smaller reach"
            )
        except RefusalError as error:
            return str(error)
        return None

    def draw(self, d: int, rng: np.random.Generator) -> WaveSum:
        """Draw a sum by its frequencies and phases.

        Parameters, returns and errors are those of ``Family.draw``.
        """
        if reason := self.refusal(d):
            raise RefusalError(reason)
        ball = _ball(d, self.square(d))
        return WaveSum(ball[rng.integers(len(ball), size=self.count)], rng.random(self.count))

    def mean_energy(self, frequencies: NDArray[np.int64]) -> FloatArray:
        """Mean of ``energy`` over draws: the same for every frequency in reach, (m, d) -> (m,)."""
        d = frequencies.shape[1]
        square = (frequencies**2).sum(axis=1)
        within = (square > 0) & (square <= self.square(d))
        energy: FloatArray = within * (self.count / (4 * half_count(d, self.square(d))))
        return energy

    def frequencies(self, d: int, share: float, most: int = MOST_FREQUENCIES) -> NDArray[np.int64]:
        """List one of each pair f, -f within the band; no share is left out.

        Parameters, returns and errors are those of ``Family.frequencies``.
        """
        check_share(share, self.refusal(d))
        count = half_count(d, self.square(d))
        check_count(f"reach={self.reach:g} of waves", d, count, "take a smaller reach", most=most)
        return _ball(d, self.square(d)).copy()


@lru_cache(maxsize=2)
def _ball(d: int, square: int) -> NDArray[np.int64]:
    return half_ball(d, square)


@dataclass(frozen=True, eq=False)
class WaveSum:
    """One sum of waves.

    Attributes
    ----------
    waves : (count, d) int64
        Frequencies, none of them 0.
    phases : (count,) float64
        In turns, [0, 1).
    """

    waves: NDArray[np.int64]
    phases: FloatArray

    @property
    def integral(self) -> float:
        """Exactly 0, as each wave's."""
        return 0.0

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values, (..., d) -> (...), to 4e-16 a wave: f . x is exact, in units of 2^-64 turns."""
        return evaluate(self, x)

    def by_numpy(self, points: FloatArray) -> FloatArray:
        """Values at (n, d) points in numpy."""
        total = np.zeros(len(points))
        turns = fixed_point(np.ascontiguousarray(points.T), 64)
        for multiple, phase in zip(self.waves.astype(np.uint64), fixed_point(self.phases, 64), strict=True):
            turn = np.full(len(points), phase)
            for m, coordinate in zip(multiple, turns, strict=True):
                if m:
                    turn += m * coordinate
            total += np.cos(turn.view(np.int64) * RADIANS)
        return total

    def on_device(self, points: FloatArray, device: Precision) -> FloatArray:
        """Values by waves.cl.

        Parameters
        ----------
        points : (n, d) float64
            Points of the unit torus.
        device : Precision
            A device in double precision.

        Returns
        -------
        (n,) float64
            The sum at each point.
        """
        rows = coordinate_rows(points, device, turns=True)
        multiples, phases = self.waves.astype(np.uint64), fixed_point(self.phases, 64)
        return run_kernel(device, ("waves.cl",), rows, len(points), multiples, phases, np.uint32(len(phases)))

    def energy(self, frequencies: NDArray[np.int64]) -> FloatArray:
        """|transform|^2 at integer frequencies, (m, d) -> (m,): |sum of exp(2 pi i phase)|^2 / 4."""
        known, amplitudes = self._spectrum
        energy: FloatArray = np.zeros(len(frequencies))
        half, _ = to_half_space(np.ascontiguousarray(frequencies))
        for k, row in enumerate(map(bytes, half)):
            if row in known:
                energy[k] = abs(amplitudes[known[row]]) ** 2
        return energy

    @cached_property
    def _spectrum(self) -> tuple[dict[bytes, int], NDArray[np.complex128]]:
        half, turned = to_half_space(self.waves)
        known: dict[bytes, int] = {}
        amplitudes = np.zeros(len(half), dtype=np.complex128)
        for row, sign, phase in zip(map(bytes, half), np.where(turned, -1, 1), self.phases, strict=True):
            amplitudes[known.setdefault(row, len(known))] += np.exp(2j * math.pi * sign * phase) / 2
        return known, amplitudes
