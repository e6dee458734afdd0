"""Cases of the benchmark of spectra: sizes with all rivals, and sweeps of gbnbench alone."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class SpectrumCase:
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
class SpectrumBenchmark:
    """The sizes that the benchmark runs over, and the time given to each.

    Attributes
    ----------
    cases : tuple of SpectrumCase
        Sizes on which every rival is timed.
    sweeps : dict of str to tuple of SpectrumCase
        Sizes on which gbnbench alone is timed, by the quantity that grows.
    seconds, sweep_seconds : float
        Time given to one case, and to one size of a sweep.
    longest : float
        Seconds a call of the naive kernel may take.
    probes : int
        Frequencies at which the error is taken.
    quick : bool
        Whether the hard cases leave out a million points.
    core_rounds, core_seconds : int, float
        Rounds of measuring the throughput of two cores, and the time of each; 0 rounds leave it out.
    """

    cases: tuple[SpectrumCase, ...]
    sweeps: dict[str, tuple[SpectrumCase, ...]]
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
PSA = SpectrumCase(1024, 2, 159, quoted=("PSA v1.1 (quoted)", 1.55))
CASES = (
    SpectrumCase(1024, 2, 64),
    SpectrumCase(1024, 2, 64, 16),
    SpectrumCase(4096, 3, 16),
    SpectrumCase(4096, 2, 128),
    SpectrumCase(4096, 8, 1),
    PSA,
    SpectrumCase(1024, 1, 4096),
)
MORE_CASES = (
    SpectrumCase(4096, 2, 319),
    SpectrumCase(65_536, 2, 512),
    SpectrumCase(1024, 3, 8),
    SpectrumCase(4096, 3, 32),
)
# In each dimension the F whose cube is nearest to 20,000 frequencies, then what 3^d gives.
BY_DIMENSION = ((1, 10_000), (2, 70), (3, 13), (4, 6), (5, 3), (6, 2), (7, 2), (8, 1), (9, 1), (10, 1))


def _sweeps(most: float) -> Iterator[tuple[str, tuple[SpectrumCase, ...]]]:
    sweeps = {
        "n": [SpectrumCase(2**k, 2, 64) for k in range(6, 19)],
        "F": [SpectrumCase(1024, 2, 2**k) for k in range(3, 10)],
        "d": [SpectrumCase(1024, d, f) for d, f in BY_DIMENSION],
        "realizations": [SpectrumCase(1024, 2, 64, 2**k) for k in range(8)],
    }
    for name, cases in sweeps.items():
        yield name, tuple(case for case in cases if case.flops <= most)


def full() -> SpectrumBenchmark:
    """Return the benchmark that takes under five minutes on two cores."""
    return SpectrumBenchmark((*CASES, *MORE_CASES), dict(_sweeps(1e10)), 10.0, 1.2, 2.0, 200, False, 3, 2.0)


def quick() -> SpectrumBenchmark:
    """Return the benchmark that takes under half a minute."""
    sweeps = {name: cases[:: 3 if len(cases) > 8 else 2] for name, cases in _sweeps(3e9)}
    return SpectrumBenchmark(CASES, sweeps, 1.0, 0.1, 0.1, 40, True, 1, 0.7)


def tiny() -> SpectrumBenchmark:
    """Return the benchmark that tests run, which takes seconds."""
    cases = (
        SpectrumCase(64, 2, 8),
        SpectrumCase(64, 2, 8, 3),
        SpectrumCase(50, 3, 3),
        SpectrumCase(40, 4, 1),
        SpectrumCase(30, 1, 9, quoted=PSA.quoted),
    )
    sweeps: dict[str, tuple[SpectrumCase, ...]] = {
        "n": (SpectrumCase(32, 2, 8), SpectrumCase(64, 2, 8)),
        "d": (SpectrumCase(64, 1, 20), SpectrumCase(64, 2, 4)),
    }
    return SpectrumBenchmark(cases, sweeps, 0.01, 0.01, 0.1, 10, True, 0, 0.1)
