"""Published shape of spectra: isotropic, and an exponential or a power law at low frequencies."""

from __future__ import annotations

import math

from gbnbench.analysis.measures import measures
from gbnbench.core.torus import FloatArray
from gbnbench.verification.published_figure import PublishedFigure

ISOTROPIC = "Lagae & Dutré, A comparison of methods for generating Poisson disk distributions, 2008"
ROOM = 1.2  # dB: the mean over rings of few sets spreads by half of it
LAW = "Ahmed, Ren & Wonka, Gaussian blue noise, 2022, Fig. 1(g)"
EXPONENTIAL = {"gbn": 4, "kdm": 4, "voidcluster": 8, "fpo": 16}  # sets that settle the sign
POWER_LAW = {"bnot": 4, "jittered": 8}


def exponential_less_power_law(x: FloatArray) -> float:
    """Residual of the exponential fitted to a set's low frequencies less that of a power law, in dB."""
    found = measures(x)
    return float(found["profile_residual_db"] - found["powerlaw_residual_db"])


def _isotropic(generator: str, sets: int) -> PublishedFigure:
    level = -10 * math.log10(sets)
    return PublishedFigure(
        generator, "anisotropy_db", f"isotropic: {level:.1f} dB", level - ROOM, level + ROOM,
        f"{ROOM} dB, twice what the mean over rings spreads by; the level is that of {sets} isotropic sets",
        ISOTROPIC, sets=sets,
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
            name, exponential_less_power_law, "below 0: exponential", -math.inf, 0.0, "a sign", LAW, sets=sets
        )
        for name, sets in EXPONENTIAL.items()
    ),
    *(
        PublishedFigure(
            name, exponential_less_power_law, "above 0: power law", 0.0, math.inf, "a sign", LAW, sets=sets
        )
        for name, sets in POWER_LAW.items()
    ),
)
