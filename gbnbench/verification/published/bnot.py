"""Published figures of blue noise through optimal transport (de Goes et al. 2012)."""

from __future__ import annotations

from gbnbench.verification.published.bnot_radial_power import PowerOverPublished
from gbnbench.verification.published.set_figures import spread_of_voronoi_areas
from gbnbench.verification.published_figure import SETS, PublishedFigure

BNOT = "de Goes, Breeden, Ostromoukhov & Desbrun, Blue noise through optimal transport, SIGGRAPH Asia 2012"
BNOT_SETS = "measured on ten sets published by the deepsampling project"
BNOT_SETS_HERE = "measured on four of these sets, tests/data/bnot-1024"

BNOT_FIGURES = (
    PublishedFigure(
        "bnot",
        "noise_floor",
        "1.21e-4",
        6e-5,
        2.4e-4,
        "a factor of 2: it halves from 8 alternations to 20",
        BNOT_SETS,
        kind=SETS,
    ),
    PublishedFigure(
        "bnot",
        "power_at_1",
        "5e-8 to 4e-7",
        2e-8,
        8e-7,
        "four frequencies a set, of which each is exponentially distributed",
        BNOT_SETS,
        kind=SETS,
    ),
    PublishedFigure(
        "bnot",
        "min_distance",
        ".732 to .783",
        0.712,
        0.803,
        "one published set spreads by .01 about the rest; twice that",
        BNOT,
    ),
    PublishedFigure(
        "bnot",
        "mean_distance",
        ".872 to .899",
        0.866,
        0.905,
        "one published set spreads by .003 about the rest; twice that",
        BNOT,
    ),
    PublishedFigure(
        "bnot",
        "bond_order",
        ".428 to .547",
        0.394,
        0.581,
        "one published set spreads by .017 about the rest; twice that",
        BNOT,
    ),
    PublishedFigure(
        "bnot",
        "effective_nyquist",
        ".855 to .900",
        0.842,
        0.913,
        "one published set spreads by .0063 about the rest; twice that",
        BNOT,
    ),
    PublishedFigure(
        "bnot",
        "oscillations",
        "2.00 to 2.81",
        1.84,
        2.97,
        "one published set spreads by .08 about the rest; twice that",
        BNOT,
    ),
    PublishedFigure(
        "bnot",
        "peak",
        "2.79",
        2.5,
        3.1,
        "a tenth: one alternation is a twentieth",
        BNOT_SETS,
        kind=SETS,
    ),
    PublishedFigure(
        "bnot",
        "valence6",
        ".581",
        0.533,
        0.629,
        "one published set spreads by .024 about the rest; twice that",
        BNOT_SETS,
        kind=SETS,
    ),
    PublishedFigure(
        "bnot",
        spread_of_voronoi_areas,
        ".0448 to .0502",
        0.042,
        0.053,
        "four published sets spread by .002 about .047",
        BNOT_SETS,
        kind=SETS,
    ),
    *(
        PublishedFigure(
            "bnot",
            PowerOverPublished(first, last),
            "1: radial power of four sets",
            0.85,
            1.15,
            "twice the 7% by which means of 4 and of 16 sets differ in the lowest band",
            BNOT_SETS_HERE,
            kind=SETS,
            sets=16,
        )
        for first, last in ((3, 7), (8, 15), (16, 23), (24, 31), (32, 48))
    ),
)
