"""Cases of the benchmark of Gaussian Blue Noise: sizes, and the optimisers that race on each."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

SIGMA = 1.0  # spacings, the paper's
CUTOFFS = (3.0, 4.0, 5.0, 6.0, 7.5, 9.0)  # sigmas
FIRST, A_DECADE = 10, 4  # the first stop, and stops a decade


@dataclass(frozen=True)
class Curve:
    """One optimiser, and how far it is taken.

    Attributes
    ----------
    method : {"nesterov", "descent"}
        Ours, or the paper's fixed steps.
    gradients : int
        The last stop.
    precision : {"double", "float"}
        Of the forces.
    step : {"auto", "authors"}
        1.2 over the largest curvature, or the authors' 0.25 n^(2/d) / n, in squared spacings.
    cutoff : float
        Where the kernel itself ends, in sigmas; 0 leaves it whole.
    """

    method: Literal["nesterov", "descent"]
    gradients: int
    precision: Literal["double", "float"] = "double"
    step: Literal["auto", "authors"] = "auto"
    cutoff: float = 0.0

    @property
    def title(self) -> str:
        """What tables and pictures call it, without its precision."""
        name = "Nesterov" if self.method == "nesterov" else "descent"
        step = ", authors' step" if self.step == "authors" else ""
        end = f", kernel to {self.cutoff:g} sigma" if self.cutoff else ""
        return name + step + end

    def stops(self) -> list[int]:
        """Return the counts of gradients at which the floor is taken: geometric, the last one always.

        Examples
        --------
        >>> Curve("nesterov", 320).stops()
        [10, 18, 32, 56, 100, 178, 320]
        """
        ladder = [round(FIRST * 10 ** (k / A_DECADE)) for k in range(10 * A_DECADE)]
        return [k for k in ladder if 1.2 * k < self.gradients] + [self.gradients]


@dataclass(frozen=True)
class FloorCase:
    """Sets of one size and what races on them.

    Attributes
    ----------
    n, d : int
        Size.
    curves : tuple of Curve
        Run in turn, stop by stop.
    sets : int
        Seeds, each run by itself.
    """

    n: int
    d: int
    curves: tuple[Curve, ...]
    sets: int = 3

    @property
    def title(self) -> str:
        """What tables and pictures call it."""
        return f"n={self.n} {self.d}D"

    @property
    def gradients(self) -> int:
        """All gradients of all curves and sets."""
        return self.sets * sum(curve.gradients for curve in self.curves)

    @property
    def cost(self) -> float:
        """Gradients of one set times its coordinates: about in proportion to its time."""
        return float(self.n * self.d * sum(curve.gradients for curve in self.curves))


@dataclass(frozen=True)
class FloorBenchmark:
    """The sizes that the benchmark runs over, and the time given to each.

    Attributes
    ----------
    cases : tuple of FloorCase
        Noise floor against time.
    forces : tuple of (int, int)
        Sizes (n, d) whose forces are timed and checked at every cut-off.
    seconds : float
        Time given to the forces of one of these sizes, all cut-offs together.
    probes : int
        Points whose exact forces are taken.
    """

    cases: tuple[FloorCase, ...]
    forces: tuple[tuple[int, int], ...]
    seconds: float
    probes: int

    @property
    def steps(self) -> int:
        """Steps of progress: gradients."""
        return sum(case.gradients for case in self.cases)


def race(ours: int, descent: int, authors: int = 0, in_float: int = 0) -> tuple[Curve, ...]:
    """List the curves of a race: Nesterov's method in both precisions, and descents.

    Parameters
    ----------
    ours : int
        Gradients of Nesterov's method, in double and again in float.
    descent : int
        Gradients of the paper's descent in double, with our step.
    authors : int
        Gradients of the descent in double with the authors' step; 0 leaves it out.
    in_float : int
        Gradients of the paper's descent in float; 0 leaves it out.

    Returns
    -------
    tuple of Curve
    """
    curves = [Curve("nesterov", ours), Curve("nesterov", ours, "float"), Curve("descent", descent)]
    if in_float:
        curves.append(Curve("descent", in_float, "float"))
    if authors:
        curves.append(Curve("descent", authors, step="authors"))
    return tuple(curves)


def truncated(gradients: int, cutoffs: tuple[float, ...] = CUTOFFS) -> tuple[Curve, ...]:
    """List the curves of Nesterov's method on kernels that end at each cut-off.

    Parameters
    ----------
    gradients : int
        Gradients of each.
    cutoffs : tuple of float
        Cut-offs, in sigma.

    Returns
    -------
    tuple of Curve
    """
    return tuple(Curve("nesterov", gradients, cutoff=cutoff) for cutoff in cutoffs)


def full() -> FloorBenchmark:
    """Return the benchmark that takes under five minutes on one quiet core."""
    cases = (
        FloorCase(256, 1, race(1000, 3162)),
        FloorCase(256, 2, race(1000, 15_000)),
        FloorCase(1024, 2, race(1000, 15_000, authors=1000, in_float=3162) + truncated(1000)),
        FloorCase(4096, 2, race(562, 1778)),
        FloorCase(16384, 2, race(320, 320), sets=1),
        FloorCase(1000, 3, race(320, 320, authors=178)),
        FloorCase(4096, 3, race(100, 100, authors=100), sets=1),
        FloorCase(1024, 8, race(100, 100, authors=100)),
    )
    return FloorBenchmark(cases, ((1024, 2), (4096, 2), (4096, 3)), 3.0, 200)


def quick() -> FloorBenchmark:
    """Return the benchmark that takes under half a minute."""
    cases = (
        FloorCase(256, 2, race(320, 1000), sets=2),
        FloorCase(1024, 2, race(320, 1000, in_float=320) + truncated(320), sets=1),
        FloorCase(4096, 2, race(100, 100), sets=1),
        FloorCase(1000, 3, race(56, 56, authors=56), sets=1),
        FloorCase(1024, 8, race(18, 18, authors=18), sets=1),
    )
    return FloorBenchmark(cases, ((1024, 2),), 0.8, 50)


def tiny() -> FloorBenchmark:
    """Return the benchmark that tests run, which takes seconds."""
    cases = (
        FloorCase(100, 2, race(56, 178, authors=56), sets=2),
        FloorCase(400, 2, truncated(100, (3.0, 9.0)), sets=1),
        FloorCase(64, 3, race(32, 32), sets=1),
        FloorCase(100, 6, race(18, 18, authors=18), sets=1),
    )
    return FloorBenchmark(cases, ((400, 2),), 0.02, 20)
