"""Published figures of sets made by cells: equal areas, capacities, farthest points."""

from __future__ import annotations

import math

from gbnbench.verification.published_figure import PublishedFigure

BNOT = "de Goes, Breeden, Ostromoukhov & Desbrun, Blue noise through optimal transport, SIGGRAPH Asia 2012"
BNOT_SETS = "measured on ten sets published by the deepsampling project"
CAPCVT = "measured on a set made by the method of Chen et al., Variational blue noise sampling, 2012"
CCVT = "measured on sets made by the method of Balzer, Schlömer & Deussen, SIGGRAPH 2009"
SLICED = "measured on 107 sets made by the program of Paulin et al., Sliced optimal transport sampling, 2020"
FPO = "Schlömer, Heck & Deussen, Farthest-point optimized point sets, HPG 2011"

CELLULAR = (
    PublishedFigure(
        "bnot", "noise_floor", "1.21e-4", 6e-5, 2.4e-4,
        "a factor of 2: it halves from 8 alternations to 20", BNOT_SETS,
    ),
    PublishedFigure(
        "bnot", "power_at_1", "5e-8 to 4e-7", 2e-8, 8e-7,
        "four frequencies a set, of which each is exponentially distributed", BNOT_SETS,
    ),
    PublishedFigure(
        "bnot", "min_distance", ".732 to .783", 0.70, 0.783,
        "the least of 1,024 distances spreads by .02 over sets", BNOT,
    ),
    PublishedFigure(
        "bnot", "mean_distance", ".872 to .899", 0.867, 0.899,
        "the spread over sets is .002; one alternation is .003", BNOT,
    ),
    PublishedFigure(
        "bnot", "bond_order", ".428 to .547", 0.415, 0.547, "the spread over sets is .01", BNOT,
    ),
    PublishedFigure(
        "bnot", "effective_nyquist", ".855 to .900", 0.845, 0.90,
        "steps of .01 in the published table", BNOT,
    ),
    PublishedFigure(
        "bnot", "oscillations", "2.00 to 2.81", 1.9, 2.81, "the spread over sets is .1", BNOT,
    ),
    PublishedFigure(
        "bnot", "peak", "2.79", 2.5, 3.1, "a tenth: one alternation is a twentieth", BNOT_SETS,
    ),
    PublishedFigure(
        "bnot", "valence6", ".581", 0.55, 0.61, "the spread over sets is .015", BNOT_SETS,
    ),
    PublishedFigure(
        "capcvt", "min_distance", ".751", 0.72, 0.79,
        "the price was chosen for it; the least of 1,024 distances", CAPCVT,
    ),
    PublishedFigure(
        "capcvt", "noise_floor", "1.2e-4", 0.9e-4, 1.6e-4,
        "the price was chosen for it; a few dozen frequencies: a third", CAPCVT,
    ),
    PublishedFigure(
        "capcvt", "peak", "5.2", 4.5, 6.0,
        "the price was chosen for it; a tenth more steps are a twelfth", CAPCVT,
    ),
    PublishedFigure(
        "ccvt", "mean_distance", ".872", 0.855, 0.880, "its samples a point are unknown", CCVT, sets=1,
    ),
    PublishedFigure(
        "ccvt", "effective_nyquist", ".860", 0.83, 0.87, "2,048 samples a point give .860", CCVT, sets=1,
    ),
    PublishedFigure(
        "ccvt", "oscillations", "2.01", 1.65, 2.15, "2,048 samples a point give 2.05", CCVT, sets=1,
    ),
    PublishedFigure(
        "fpo", "min_distance", "at least .925", 0.925, math.inf, "the method stops at this distance", FPO
    ),
    PublishedFigure(
        "fpo", "noise_floor", "7.9e-3", 6.3e-3, 9.9e-3, "a quarter: a few dozen frequencies a set",
        "measured on sets by the authors' method",
    ),
    PublishedFigure(
        "sliced", "noise_floor", "1.6e-3", 3e-4, 1.9e-3,
        "it falls as one over the directions a step; those of these sets are not known", SLICED, sets=3,
    ),
    PublishedFigure(
        "sliced", "power_at_1", "1.2e-4", 0.0, 2.4e-4, "likewise; less is no disagreement", SLICED, sets=3,
    ),
)  # fmt: skip
