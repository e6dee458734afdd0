"""Shape of spectra: isotropic as expected, exponential or a power law as published."""

from __future__ import annotations

import math

from gbnbench.analysis.measures import measures
from gbnbench.core.torus import FloatArray
from gbnbench.verification.published_figure import STATEMENT, THEORY, PublishedFigure

ISOTROPIC = "an expectation, in the measure of Ulichney, Digital halftoning, 1987"
ROOM = 1.2  # dB: the mean over rings of few sets spreads by half of it
LAW = "Ahmed, Ren & Wonka, Gaussian blue noise, 2022, Fig. 1(g)"
EXPONENTIAL = {"gbn": 4, "kdm": 4, "voidcluster": 8, "fpo": 16}  # sets that settle the sign
POWER_LAW = {"bnot": 4, "jittered": 8}


def exponential_less_power_law(x: FloatArray) -> float:
    """``profile_residual_db`` minus ``powerlaw_residual_db`` of a set; if < 0 the exponential fits better."""
    found = measures(x)
    return float(found["profile_residual_db"] - found["powerlaw_residual_db"])


def _isotropic(generator: str, sets: int) -> PublishedFigure:
    level = -10 * math.log10(sets)
    return PublishedFigure(
        generator, "anisotropy_db", f"{level:.1f} dB: isotropic", level - ROOM, level + ROOM,
        f"{ROOM} dB, twice what the mean over rings spreads by",
        ISOTROPIC, sets=sets, kind=THEORY,
    )  # fmt: skip


SPECTRAL_SHAPE = (
    *(_isotropic(name, 4) for name in ("darts", "maximalpoisson", "bridson", "elimination")),
    *(_isotropic(name, 4) for name in ("lloyd", "bnot", "capcvt", "fpo")),
    _isotropic("ccvt", 2),
    _isotropic("sliced", 3),
    *(_isotropic(name, 4) for name in ("kdm", "sph", "gbn", "deep", "step", "staircase")),
    _isotropic("voidcluster", 20),
    *(
        PublishedFigure(
            name,
            exponential_less_power_law,
            "below 0: exponential",
            -math.inf,
            0.0,
            "a sign",
            LAW,
            sets=sets,
            kind=STATEMENT,
        )
        for name, sets in EXPONENTIAL.items()
    ),
    *(
        PublishedFigure(
            name,
            exponential_less_power_law,
            "above 0: power law",
            0.0,
            math.inf,
            "a sign",
            LAW,
            sets=sets,
            kind=STATEMENT,
        )
        for name, sets in POWER_LAW.items()
    ),
)
