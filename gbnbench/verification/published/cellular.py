"""Published figures of sets made by cells: equal areas, capacities, farthest points."""

from __future__ import annotations

import math

from gbnbench.verification.published.bnot import BNOT_FIGURES, BNOT_SETS
from gbnbench.verification.published.set_figures import gain_in_integration, spread_of_voronoi_areas
from gbnbench.verification.published_figure import SETS, STATEMENT, PublishedFigure

CAPCVT = "measured on a set made by the method of Chen et al., Variational blue noise sampling, 2012"
CAPCVT_PROGRAM = "capcvt[energy=program]"  # the published sets are those of the authors' program
CCVT = "measured on a set made by the method of Balzer, Schlömer & Deussen, SIGGRAPH 2009"
SLICED = "measured on 107 sets made by the program of Paulin et al., Sliced optimal transport sampling, 2020"
SLICED_PAPER = "Paulin, Bonneel, Coeurjolly, Iehl, Webanck, Desbrun & Ostromoukhov, 2020"
FPO = "Schlömer, Heck & Deussen, Farthest-point optimized point sets, HPG 2011"
# One published set and the mean of two or four of ours differ by 1.2 spreads of one set; it is twice that.
SPREADS = "2.5 times the spread over sets,"

CELLULAR = (
    *BNOT_FIGURES,
    PublishedFigure(
        "capcvt",
        "min_distance",
        ".751",
        0.698,
        0.804,
        f"{SPREADS} .021",
        CAPCVT,
        kind=SETS,
    ),
    PublishedFigure(
        "capcvt",
        "noise_floor",
        "1.2e-4",
        7e-5,
        1.7e-4,
        f"{SPREADS} 1.8e-5, and two digits",
        CAPCVT,
        kind=SETS,
    ),
    PublishedFigure(
        "capcvt",
        "peak",
        "5.2",
        4.35,
        6.05,
        f"{SPREADS} .32, and two digits",
        CAPCVT,
        kind=SETS,
    ),
    PublishedFigure(
        CAPCVT_PROGRAM,
        "min_distance",
        ".751",
        0.698,
        0.804,
        f"{SPREADS} .021",
        CAPCVT,
        kind=SETS,
    ),
    PublishedFigure(
        CAPCVT_PROGRAM,
        "noise_floor",
        "1.2e-4",
        7e-5,
        1.7e-4,
        f"{SPREADS} 1.8e-5, and two digits",
        CAPCVT,
        kind=SETS,
    ),
    PublishedFigure(
        CAPCVT_PROGRAM,
        "peak",
        "5.2",
        4.35,
        6.05,
        f"{SPREADS} .32, and two digits",
        CAPCVT,
        kind=SETS,
    ),
    PublishedFigure(
        CAPCVT_PROGRAM,
        "min_distance",
        ".692",
        0.617,
        0.767,
        f"{SPREADS} .030",
        CAPCVT,
        kind=SETS,
        n=4096,
    ),
    PublishedFigure(
        CAPCVT_PROGRAM,
        "noise_floor",
        "1.4e-4",
        1.17e-4,
        1.63e-4,
        f"{SPREADS} 7e-6, and two digits",
        CAPCVT,
        kind=SETS,
        n=4096,
    ),
    PublishedFigure(
        CAPCVT_PROGRAM,
        "peak",
        "4.6",
        4.3,
        4.9,
        f"{SPREADS} .10, and two digits",
        CAPCVT,
        kind=SETS,
        n=4096,
    ),
    PublishedFigure(
        "ccvt",
        "min_distance",
        ".748",
        0.715,
        0.781,
        f"{SPREADS} .013",
        CCVT,
        kind=SETS,
        sets=2,
    ),
    PublishedFigure(
        "ccvt",
        "mean_distance",
        ".872",
        0.865,
        0.879,
        f"{SPREADS} .0025; the samples a point were inferred from this figure",
        CCVT,
        kind=SETS,
        sets=2,
    ),
    PublishedFigure("ccvt", "bond_order", ".450", 0.417, 0.483, f"{SPREADS} .013", CCVT, kind=SETS, sets=2),
    PublishedFigure(
        "ccvt",
        "effective_nyquist",
        ".860",
        0.849,
        0.871,
        f"{SPREADS} .0025, and steps of .01",
        CCVT,
        kind=SETS,
        sets=2,
    ),
    PublishedFigure("ccvt", "oscillations", "2.01", 1.87, 2.15, f"{SPREADS} .054", CCVT, kind=SETS, sets=2),
    PublishedFigure(
        "fpo", "min_distance", "at least .925", 0.925, math.inf, "the method stops at this distance", FPO
    ),
    PublishedFigure(
        "fpo",
        "noise_floor",
        "7.9e-3",
        6.3e-3,
        9.9e-3,
        "a quarter: a few dozen frequencies a set",
        "measured on sets by the authors' method",
        kind=SETS,
    ),
    PublishedFigure(
        "sliced",
        "noise_floor",
        "1.6e-3",
        3e-4,
        1.9e-3,
        "it falls as one over the directions a step; those of these sets are not known",
        SLICED,
        kind=SETS,
        sets=3,
    ),
    PublishedFigure(
        "sliced",
        "power_at_1",
        "at most 1.2e-4",
        -math.inf,
        2.4e-4,
        "a factor of 2 for two independent frequencies a set; less is no disagreement",
        SLICED,
        kind=SETS,
        sets=3,
    ),
    PublishedFigure(
        "ccvt",
        spread_of_voronoi_areas,
        "that of bnot, .047",
        0.040,
        0.054,
        "capacities are equal for cells by weights in both",
        BNOT_SETS,
        kind=SETS,
        sets=2,
    ),
    *(
        PublishedFigure(
            "sliced",
            gain_in_integration,
            "above 1",
            1.0,
            math.inf,
            f"a gain over independent points in {d} dimensions",
            SLICED_PAPER,
            kind=STATEMENT,
            n=1024,
            d=d,
            sets=2,
        )
        for d in (2, 3, 5)
    ),
)
