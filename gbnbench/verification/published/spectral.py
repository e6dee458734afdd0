"""Published figures of sets that aim at a spectrum: step and stair blue noise."""

from __future__ import annotations

import math

from gbnbench.analysis.measures import measures
from gbnbench.core.torus import FloatArray
from gbnbench.verification.published_figure import SETS, PublishedFigure

STEP = "Heck, Schlömer & Deussen, Blue noise sampling with controlled aliasing, ACM Trans. Graph. 32(3), 2013"
MATCHED = "step[method=correlation]"
STEP_SETS = "measured on sets published by the deepsampling project"


def oscillations_of_one_set(x: FloatArray) -> float:
    """Mean over the sets of the ``oscillations`` of each; of several together, noise partly cancels."""
    return float(measures(x)["oscillations"])


SPECTRAL = (
    PublishedFigure(
        "step", "min_distance", ".23", 0.20, 0.26, "the least distances of sets spread by .02", STEP,
    ),
    PublishedFigure(
        "step", "mean_distance", ".65", 0.635, 0.655,
        "the spread over sets is .003; published to two digits", STEP,
    ),
    PublishedFigure("step", "bond_order", ".36", 0.345, 0.375, "the spread over sets is .01", STEP),
    PublishedFigure(
        "step", "effective_nyquist", ".570", 0.5645, 0.5755, "it is found in steps of .005", STEP,
    ),
    PublishedFigure(
        "step", oscillations_of_one_set, ".11 to .15", 0.10, 0.20,
        "the spread over sets is .03; ring means are flat, shells within them as scattered as noise", STEP,
    ),
    PublishedFigure(
        "step", "noise_floor", "at most 6.9e-3", -math.inf, 6.0e-3, "less is no disagreement",
        STEP_SETS, kind=SETS,
    ),
    PublishedFigure(
        "step", "power_at_1", "at most 7e-5", -math.inf, 7e-5,
        "two sets have 5e-5 and 7e-5; less is no disagreement",
        STEP_SETS, kind=SETS,
    ),
    PublishedFigure(
        MATCHED, "min_distance", ".22 to .23", 0.20, 0.26, "the least distances of sets spread by .02", STEP,
    ),
    PublishedFigure(
        MATCHED, "mean_distance", ".65", 0.64, 0.665, "the spread over sets is .006; published to two digits",
        STEP,
    ),
    PublishedFigure(MATCHED, "bond_order", ".36", 0.345, 0.375, "the spread over sets is .01", STEP),
    PublishedFigure(
        MATCHED, "effective_nyquist", ".570", 0.5595, 0.5755, "it is found in steps of .005", STEP,
    ),
    PublishedFigure(
        MATCHED, oscillations_of_one_set, ".11 to .15", 0.09, 0.20,
        "the spread over sets is .03 by this method too", STEP,
    ),
    PublishedFigure(
        MATCHED, "noise_floor", "6.3e-3 to 6.9e-3", 4e-3, 1.6e-2,
        "sets by this method have 5e-3 to 1.7e-2; two were published", STEP_SETS, kind=SETS,
    ),
    PublishedFigure(
        "staircase", "power_at_1", "at most 9e-3", -math.inf, 9e-3,
        "the sets have 2.5e-3 to 9e-3; less is no disagreement",
        STEP_SETS, kind=SETS,
    ),
)  # fmt: skip
