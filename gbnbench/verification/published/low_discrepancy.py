"""Published figures of sets of low discrepancy: nets, lattices and sequences, all of them exact."""

from __future__ import annotations

import numpy as np

from gbnbench.core.torus import FloatArray
from gbnbench.generators.low_discrepancy.net_quality import net_quality
from gbnbench.verification.published_figure import PublishedFigure

EXACT = "a whole number, which is met or not"
NETS = "Niederreiter, Random number generation and quasi-Monte Carlo methods, 1992"


def zaremba_figure_of_merit(x: FloatArray) -> float:
    """Least product of max(1, |h_a|) over the dual lattice of an unshifted rank-1 lattice in 2D without 0."""
    n = len(x)
    generator = round(float(x[1, 1]) * n)  # the point that follows 0 on the first axis
    second = np.arange(1, n // 2 + 1)
    first = generator * second % n
    return float((second * np.maximum(1, np.minimum(first, n - first))).min())


def lengths_of_gaps(x: FloatArray) -> float:
    """Count the different lengths of gaps between neighbours on a circle, to 1e-12."""
    ordered = np.sort(x[:, 0])
    return float(len(np.unique(np.round(np.diff(ordered, append=ordered[0] + 1), 12))))


LOW_DISCREPANCY = (
    *(
        PublishedFigure(name, net_quality, "t = 0", -0.5, 0.5, EXACT, source)
        for name, source in (
            ("sobol", NETS),
            ("pmj02", "Christensen, Kensler & Kilpatrick, 2018"),
            ("bluenets", "Ahmed & Wonka, Optimizing dyadic nets, 2021"),
            ("hammersley[shift=false]", NETS),
        )
    ),
    PublishedFigure(
        "sobol", net_quality, "t at most 1", -0.5, 1.5, EXACT, "Sobol, 1967: by its polynomials",
        n=256, d=3,
    ),
    PublishedFigure(
        "hammersley[shift=false]", "discrepancy_star", "1.8132e-3", 1.81315e-3, 1.81335e-3,
        "rounding of a closed form", "Halton & Zaremba, 1969", sets=1,
    ),
    PublishedFigure(
        "rank1[shift=false]", zaremba_figure_of_merit, "377 = F(14)", 376.5, 377.5, EXACT,
        "Zaremba, 1966: of the Fibonacci lattice", n=987, sets=1,
    ),
    PublishedFigure(
        "kronecker", lengths_of_gaps, "at most 3", 1.5, 3.5, EXACT, "Sós, 1958: three gaps", n=1000, d=1
    ),
)  # fmt: skip
