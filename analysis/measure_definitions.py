"""Definitions of all scalar measures, with unit, direction and source, for every table and page."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class Definition:
    """Definition of one scalar measure.

    Attributes
    ----------
    name : str
        Key in ``Measures``.
    title : str
        Column head, short.
    unit : str
        Unit of the value; empty for pure numbers.
    better : {"lower", "higher"}
        Direction in which blue noise improves, by which "best" and a baseline's verdict are decided.
    text : str
        The definition in a sentence or two.
    source : str
        Whose definition it is.
    """

    name: str
    title: str
    unit: str
    better: str
    text: str
    source: str


DEFINITIONS: tuple[Definition, ...] = (
    Definition(
        "noise_floor",
        "noise floor",
        "power",
        "lower",
        "Mean power over 0 < nu <= 0.25 of the mean spectrum; over the lowest shell where that band is "
        "empty.",
        "Ahmed, Ren & Wonka 2022, Sec. 3",
    ),
    Definition(
        "power_at_1",
        "P(|f|=1)",
        "power",
        "lower",
        "Mean power at the lowest frequencies, |f| = 1.",
        "Ahmed, Ren & Wonka 2022, Fig. 1(g)",
    ),
    Definition(
        "evacuated_energy",
        "evacuated",
        "nats a point",
        "higher",
        "-sum of ln P over all frequencies with 0 < nu < 1 and P < 1, divided by n; each realization, then "
        "the mean.",
        "Ahmed, Ren & Wonka 2022, Sec. 4.3",
    ),
    Definition(
        "profile_epsilon",
        "eps",
        "power",
        "lower",
        "epsilon of the exponential profile P = epsilon exp(c nu^2), fitted to ln P over exact shells with "
        "0.05 <= nu <= 0.6, unweighted.",
        "Ahmed, Ren & Wonka 2022, Eq. 19",
    ),
    Definition(
        "profile_c",
        "c",
        "",
        "higher",
        "Exponent of the same fit; an ideal Gaussian blue noise with sigma = 1 has 4 pi^2 = 39.5.",
        "Ahmed, Ren & Wonka 2022, Eq. 19",
    ),
    Definition(
        "profile_residual_db",
        "eps, c residual",
        "dB",
        "lower",
        "Root mean square departure of ln P from the exponential profile, over the same shells: the family "
        "with "
        "the smaller residual is the set's own.",
        "Ahmed, Ren & Wonka 2022, Fig. 1(g)",
    ),
    Definition(
        "powerlaw_exponent",
        "power law",
        "",
        "higher",
        "b of the power-law profile ln P = a + b ln nu, fitted over the same shells; cellular methods "
        "follow it.",
        "Pilleboue et al. 2015",
    ),
    Definition(
        "powerlaw_residual_db",
        "power law residual",
        "dB",
        "lower",
        "Root mean square departure of ln P from the power law, over the same shells.",
        "Pilleboue et al. 2015",
    ),
    Definition(
        "peak",
        "peak",
        "power",
        "lower",
        "Largest mean power over the whole rings round(|f|) = k, k < fmax, with 0.5 <= nu <= 2.",
        "Schlömer & Deussen 2011",
    ),
    Definition(
        "peak_nu",
        "peak nu",
        "nu",
        "higher",
        "nu of that ring.",
        "the same",
    ),
    Definition(
        "anisotropy_db",
        "anisotropy",
        "dB",
        "lower",
        "Relative variance of the mean power around each exact shell's own mean, pooled over 0.1 <= nu <= 1, "
        "in decibels and unbiased against the number of sets M: isotropic noise reads -10 log10(M), "
        "and the height over that line is what is judged.",
        "Ulichney 1988, with the shell's own mean",
    ),
    Definition(
        "min_distance",
        "min dist",
        "densest spacings",
        "higher",
        "Smallest toroidal distance between two points over that of the densest lattice (d_hex in 2D), each "
        "set, then the mean.",
        "Lagae & Dutré 2008; PSA",
    ),
    Definition(
        "mean_distance",
        "mean dist",
        "densest spacings",
        "higher",
        "Mean toroidal distance to the nearest neighbour, in the same unit.",
        "PSA (Schlömer & Deussen 2011)",
    ),
    Definition(
        "bond_order",
        "Q6",
        "",
        "lower",
        "Sum over points of |sum exp(6 i theta)|, theta the direction of the edge between consecutive "
        "Delaunay "
        "neighbours, over the total number of neighbours; 1 on the hexagonal lattice.",
        "Heck et al. 2013, as in PSA",
    ),
    Definition(
        "psi6",
        "psi6",
        "",
        "lower",
        "Mean over points of |mean over Delaunay neighbours of exp(6 i angle of the bond)|; 1 on the "
        "hexagonal lattice.",
        "Halperin & Nelson 1978",
    ),
    Definition(
        "valence6",
        "v6",
        "",
        "lower",
        "Share of points with exactly six Delaunay neighbours on the torus, that is six Voronoi edges of "
        "positive "
        "length; 1 on the hexagonal lattice, 0 on the square one.",
        "Ahmed, Ren & Wonka 2022, Fig. 8",
    ),
    Definition(
        "effective_nyquist",
        "nu_eff",
        "Nyquist",
        "higher",
        "Largest frequency below which the accumulated power stays under a tenth, over the Nyquist "
        "frequency sqrt(n)/2.",
        "Heck et al. 2013, as in PSA",
    ),
    Definition(
        "oscillations",
        "Omega",
        "",
        "lower",
        "Ten times the root mean square departure of the radial power from 1 beyond its first rise.",
        "Heck et al. 2013, as in PSA",
    ),
    Definition(
        "discrepancy_wd",
        "WD",
        "",
        "lower",
        "Wrap-around L2 discrepancy, squared, as SciPy has it; the discrepancy that belongs to the torus.",
        "Hickernell 1998",
    ),
    Definition(
        "discrepancy_star",
        "L2*",
        "",
        "lower",
        "Star L2 discrepancy: root mean square error of the count in boxes that begin at the origin.",
        "Warnock 1972",
    ),
)

BY_NAME: dict[str, Definition] = {definition.name: definition for definition in DEFINITIONS}


def comparable_value(name: str, value: float, realizations: int) -> float:
    """Value by which sources of different numbers of sets can be compared.

    Parameters
    ----------
    name : str
        Name of the measure.
    value : float
        Its value.
    realizations : int
        Sets that were averaged.

    Returns
    -------
    float
        Anisotropy over its reference line, -10 log10(realizations); every other measure unchanged.
    """
    return value + 10 * math.log10(realizations) if name == "anisotropy_db" else value
