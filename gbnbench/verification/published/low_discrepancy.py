"""Published figures of sets of low discrepancy: nets, lattices and sequences, all of them exact."""

from __future__ import annotations

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.low_discrepancy.net_quality import net_quality
from gbnbench.verification.published_figure import THEORY, PublishedFigure

EXACT = "a whole number, which is met or not"
NETS = "Niederreiter, Random number generation and quasi-Monte Carlo methods, 1992"


def of_whole(least: int, most: int) -> tuple[float, float]:
    """Bounds of a mean over at most nine sets that one set outside already breaks.

    Parameters
    ----------
    least, most : int
        What agrees, both counted.

    Returns
    -------
    low, high : float
        A tenth below and above: one set of nine that is 1 off moves the mean of exact ones by a ninth.
    """
    return least - 0.1, most + 0.1


def zaremba_figure_of_merit(x: FloatArray) -> float:
    """Least max(1, |h_1|) max(1, |h_2|) over all h != 0 of the dual of an unshifted rank-1 lattice in 2D."""
    n = len(x)
    generator = round(float(x[1, 1]) * n)  # the point that follows 0 on the first axis
    second = np.arange(1, n // 2 + 1)
    first = generator * second % n
    return float((second * np.maximum(1, np.minimum(first, n - first))).min())


def lengths_of_gaps(x: FloatArray) -> float:
    """Count of the different lengths of the gaps between neighbours on a circle, to 1e-12."""
    ordered = np.sort(x[:, 0])
    return float(len(np.unique(np.round(np.diff(ordered, append=ordered[0] + 1), 12))))


LOW_DISCREPANCY = (
    *(
        PublishedFigure(name, net_quality, "t = 0", *of_whole(0, 0), EXACT, source, kind=THEORY, whole=True)
        for name, source in (
            ("sobol", NETS),
            ("pmj02", "Christensen, Kensler & Kilpatrick, 2018"),
            ("bluenets", "Ahmed & Wonka, Optimizing dyadic nets, 2021"),
            ("hammersley[shift=false]", NETS),
        )
    ),
    PublishedFigure(
        "sobol", net_quality, "t at most 1", *of_whole(0, 1), EXACT, "Sobol, 1967: by its polynomials",
        n=256, d=3, kind=THEORY, whole=True,
    ),
    PublishedFigure(
        "hammersley[shift=false]", "discrepancy_star", "1.8132e-3", 1.81315e-3, 1.81335e-3,
        "five digits of a closed form", "Halton & Zaremba, 1969", sets=1, kind=THEORY,
    ),
    PublishedFigure(
        "rank1[shift=false]", zaremba_figure_of_merit, "377 = F(14)", *of_whole(377, 377), EXACT,
        "Zaremba, 1966: of the Fibonacci lattice", n=987, sets=1, kind=THEORY, whole=True,
    ),
    PublishedFigure(
        "kronecker", lengths_of_gaps, "at most 3", *of_whole(2, 3), EXACT, "Sós, 1958: three gaps",
        n=1000, d=1, kind=THEORY, whole=True,
    ),
)  # fmt: skip
