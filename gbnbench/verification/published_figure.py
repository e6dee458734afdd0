"""A figure that was published of a generator's sets, and what counts as agreeing with it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class PublishedFigure:
    """One published figure.

    Attributes
    ----------
    generator : str
        As commands take it, with settings: ``"fpo"``, ``"gbn[sigma=0.8]"``.
    measure : str or callable
        A scalar of ``gbnbench.measures``, measured of all sets together; or a function of one set, (n, d)
        float64, whose mean over the sets is taken, and whose name says what it measures.
    published : str
        The figure as it was published, such as ``".748"`` or ``".742 to .783"``.
    low, high : float
        What agrees with it: low <= ours <= high; -inf or inf for one side alone.
    reason : str
        Why so far apart is still agreement: one clause.
    source : str
        Where it was published or measured.
    n, d, sets, seed : int
        The sets that are drawn.
    """

    generator: str
    measure: str | Callable[[FloatArray], float]
    published: str
    low: float
    high: float
    reason: str
    source: str
    n: int = 1024
    d: int = 2
    sets: int = 4
    seed: int = 0

    @property
    def measure_name(self) -> str:
        """Name of the measure, as lists show it."""
        return self.measure if isinstance(self.measure, str) else self.measure.__name__

    @property
    def same_sets(self) -> tuple[str, int, int, int, int]:
        """What figures of the same sets have in common: generator, n, d, number of sets and seed."""
        return self.generator, self.n, self.d, self.sets, self.seed
