"""What the benchmark of the periodogram runs over: cases with all rivals, and sweeps of ours alone."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class Case:
    """Random sets of one size.

    Attributes
    ----------
    n, d, fmax, sets : int
        Points, dimension, largest harmonic, realizations.
    quoted : (str, float) or None
        Another program's name and its CPU seconds, where they are known and it cannot be run here.
    """

    n: int
    d: int
    fmax: int
    sets: int = 1
    quoted: tuple[str, float] | None = None

    @property
    def title(self) -> str:
        """What tables and pictures call it."""
        sets = f", {self.sets} sets" if self.sets > 1 else ""
        return f"n={self.n} {self.d}D F={self.fmax}{sets}"

    @property
    def flops(self) -> float:
        """Operations of the two-group product: one multiply-add a frequency of the cube and point."""
        return 2.0 * self.n * float((2 * self.fmax + 1) ** self.d) * self.sets

    def points(self) -> FloatArray:
        """Draw (sets, n, d) random points on the 2^-53 grid, always the same."""
        rng = np.random.default_rng([self.n, self.d, self.fmax, self.sets])
        x: FloatArray = rng.integers(0, 2**53, (self.sets, self.n, self.d)) / 2.0**53
        return x


@dataclass(frozen=True)
class Plan:
    """How much of it is done.

    Attributes
    ----------
    cases : tuple of Case
        With every rival.
    sweeps : dict of str to tuple of Case
        Ours alone, by what grows.
    seconds, sweep_seconds : float
        For a case, for one size of a sweep.
    longest : float
        Seconds a call of the naive kernel may take.
    probes : int
        Frequencies at which the error is taken.
    quick : bool
        Whether the hard cases leave out a million points.
    core_rounds, core_seconds : int, float
        Of the throughput of two cores; 0 rounds leave it out.
    """

    cases: tuple[Case, ...]
    sweeps: dict[str, tuple[Case, ...]]
    seconds: float
    sweep_seconds: float
    longest: float
    probes: int
    quick: bool
    core_rounds: int
    core_seconds: float

    def steps(self) -> int:
        """Count the steps of progress."""
        return len(self.cases) + sum(map(len, self.sweeps.values())) + 2


# PSA v1.1 takes 1.55 CPU seconds for 319^2 frequencies of 1024 points on a core such as this was written on.
PSA = Case(1024, 2, 159, quoted=("PSA v1.1 (quoted)", 1.55))
CASES = (
    Case(1024, 2, 64),
    Case(1024, 2, 64, 16),
    Case(4096, 3, 16),
    Case(4096, 2, 128),
    Case(4096, 8, 1),
    PSA,
    Case(1024, 1, 4096),
)
# In each dimension the F whose cube is nearest to 20,000 frequencies, then what 3^d gives.
BY_DIMENSION = ((1, 10_000), (2, 70), (3, 13), (4, 6), (5, 3), (6, 2), (7, 2), (8, 1), (9, 1), (10, 1))


def _sweeps(most: float) -> Iterator[tuple[str, tuple[Case, ...]]]:
    sweeps = {
        "n": [Case(2**k, 2, 64) for k in range(6, 19)],
        "F": [Case(1024, 2, 2**k) for k in range(3, 10)],
        "d": [Case(1024, d, f) for d, f in BY_DIMENSION],
        "realizations": [Case(1024, 2, 64, 2**k) for k in range(8)],
    }
    for name, cases in sweeps.items():
        yield name, tuple(case for case in cases if case.flops <= most)


def full() -> Plan:
    """Under five minutes on two cores."""
    return Plan(CASES, dict(_sweeps(1e10)), 14.0, 1.2, 2.0, 200, False, 3, 2.0)


def quick() -> Plan:
    """Under half a minute."""
    sweeps = {name: cases[:: 3 if len(cases) > 8 else 2] for name, cases in _sweeps(3e9)}
    return Plan(CASES, sweeps, 1.0, 0.1, 0.1, 40, True, 1, 0.7)


def tiny() -> Plan:
    """Seconds: what tests run."""
    cases = (
        Case(64, 2, 8),
        Case(64, 2, 8, 3),
        Case(50, 3, 3),
        Case(40, 4, 1),
        Case(30, 1, 9, quoted=PSA.quoted),
    )
    sweeps: dict[str, tuple[Case, ...]] = {
        "n": (Case(32, 2, 8), Case(64, 2, 8)),
        "d": (Case(64, 1, 20), Case(64, 2, 4)),
    }
    return Plan(cases, sweeps, 0.01, 0.01, 0.1, 10, True, 0, 0.1)
