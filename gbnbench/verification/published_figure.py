"""A figure to hold a generator's sets against, where it is from, and what counts as agreeing."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import dataclass

from gbnbench.core.torus import FloatArray

FIGURE = "published figure"
STATEMENT = "published statement"
SETS = "measured on others' sets"
THEORY = "theory"
KINDS = {
    FIGURE: "a number that a publication states or plots",
    STATEMENT: "what a publication says in words, such as that a quantity is above another",
    SETS: "measured by this suite on sets that others made, published or free to use",
    THEORY: "what follows from the method's definition or from a theorem",
}


@dataclass(frozen=True)
class PublishedFigure:
    """One figure to agree with.

    Attributes
    ----------
    generator : str
        As commands take it, with settings: ``"fpo"``, ``"gbn[sigma=0.8]"``.
    measure : str or callable
        A scalar of ``gbnbench.measures``, measured of all sets together; or a function of one set, (n, d)
        float64, whose mean over the sets is taken, and whose name says what it measures.
    published : str
        The figure to agree with, such as ``".748"``, ``".742 to .783"`` or ``"at most 1e-8"``.
    low, high : float
        What agrees with it: low <= ours <= high; -inf or inf for one side alone.
    reason : str
        Why so far apart is still agreement: one clause.
    source : str
        Where it was published or what it was measured on.
    kind : str
        What kind of reference it is, one of ``KINDS``.
    whole : bool
        Whether the measure is a whole number of every set.
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
    kind: str = FIGURE
    whole: bool = False
    n: int = 1024
    d: int = 2
    sets: int = 4
    seed: int = 0

    @property
    def measure_name(self) -> str:
        """Name of the measure, as lists show it."""
        return self.measure if isinstance(self.measure, str) else self.measure.__name__

    @property
    def definition(self) -> str:
        """What a measure beside those of ``gbnbench.measures`` is, in a sentence; empty for one of these."""
        return (
            "" if isinstance(self.measure, str) else (inspect.getdoc(self.measure) or "").partition("\n\n")[0]
        )

    @property
    def same_sets(self) -> tuple[str, int, int, int, int]:
        """What figures of the same sets have in common: generator, n, d, number of sets and seed."""
        return self.generator, self.n, self.d, self.sets, self.seed
