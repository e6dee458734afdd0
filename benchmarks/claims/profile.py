"""Claims about the profile: Eq. (11) to (19), the families of Fig. 1(g), noise floors, the peak."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from gbnbench.analysis.radial.profile_measures import exponential_fit
from gbnbench.benchmarks.claims.claim import BESIDE, NO, PARTLY, ClaimRow, holds, reported
from gbnbench.benchmarks.claims.sets import FAST, MILLION, PAPER, DrawnSets, SetCache
from gbnbench.generators.gbn import kernel
from gbnbench.generators.gbn.kernel_profile import theta

STEEPNESS = 4 * math.pi**2  # of Eq. (19), omega being 2 pi nu
NEAR = 0.05  # relative departure of a fitted c that still counts as the formula's
BETTER = 1.25  # ratio of residuals from which one fit is the better; below it the data tell nothing
SIDE = 16.0  # spacings of the torus whose kernel is transformed


def over(high: DrawnSets, low: DrawnSets, measure: str) -> tuple[float, float]:
    """Compare a measure of two groups of sets.

    Parameters
    ----------
    high, low : DrawnSets
        The sets whose measure is divided, and those by which it is.
    measure : str
        Name of the measure.

    Returns
    -------
    orders, standard_error : float
        Decimal logarithm of the ratio.
    """
    ratio = high.measures[measure] / low.measures[measure]
    errors = [s.measures.standard_error[measure] / s.measures[measure] for s in (high, low)]
    return math.log10(ratio), math.hypot(*np.nan_to_num(errors)) / math.log(10)


def profile(sets: SetCache) -> Iterator[ClaimRow]:
    """Eq. (19): c and the residual of an exponential fit over 0.05 <= nu <= 0.6."""
    for row, spec, title in (
        ("c-10k", PAPER, "10,000 steps"),
        ("c-fast", FAST, "320 Nesterov gradients"),
        ("c-million", MILLION, "as deep as 1M steps"),
    ):
        drawn = sets.draw(spec, sets=8)
        c = drawn.measures["profile_c"]
        yield reported(
            row,
            f"c of P = eps exp(c nu^2), {title}",
            "39.48 (4 pi^2)",
            *drawn.value("profile_c"),
            of=drawn,
            holds=holds(abs(c / STEEPNESS - 1) < NEAR),
        )
        yield reported(
            f"epsilon{row[1:]}",
            f"eps, {title}",
            "",
            *drawn.value("profile_epsilon"),
            of=drawn,
        )
        yield reported(
            f"residual{row[1:]}",
            f"rms residual of the fit, dB, {title}",
            "",
            *drawn.value("profile_residual_db"),
            of=drawn,
        )
    for sigma in (0.7, 1.2):
        drawn = sets.draw(f"gbn[sigma={sigma}]")
        share, error = (v / (STEEPNESS * sigma**2) for v in drawn.value("profile_c"))
        yield reported(
            f"sigma-{sigma}",
            f"c over 4 pi^2 sigma^2 at sigma = {sigma}",
            "1 (Eq. 13 with the sigma of Eq. 15)",
            share,
            error,
            of=drawn,
            holds=holds(abs(share - 1) < NEAR, PARTLY),
        )


def convention(sets: SetCache) -> Iterator[ClaimRow]:
    """Filter by the kernel of the energy and by the one whose variance it is: slope of ln P left."""
    drawn = sets.draw(PAPER, sets=8)
    for row, sigma, title in (
        ("energy", 1.0, "the kernel of the energy, sigma = 1"),
        ("variance", math.sqrt(0.5), "the kernel whose variance the energy is, sigma = sqrt(1/2)"),
    ):
        slope = exponential_fit(drawn.radial.filtered(sigma)).slope
        yield reported(
            row,
            f"c left after filtering by {title}",
            "0 (Eq. 7: a flat spectrum)",
            slope,
            of=drawn,
            holds=holds(abs(slope) < NEAR * STEEPNESS),
        )


def weight(_: SetCache) -> Iterator[ClaimRow]:
    """Weight of the nominal frequency nu = 1 in the energy, sigma = 1, over the DC's."""
    square = math.exp(-((2 * math.pi) ** 2))
    yield reported("number", "e^{-(2 pi)^2}", "7.2e-18", square, holds=holds(f"{square:.1e}" == "7.2e-18"))
    u = np.arange(256) * SIDE / 256
    series = np.abs(np.fft.rfft(theta(u, SIDE, 1.0)))
    yield reported(
        "energy",
        "weight of |F|^2 at nu = 1 in the energy of Eq. 15, from the kernel's transform",
        "7.2e-18",
        float(series[int(SIDE)] / series[0]),
        holds=NO,
    )
    yield reported(
        "formula",
        "the same, w_f of Eq. 23",
        "7.2e-18",
        float(kernel.weights(SIDE, 1.0, int(SIDE))[-1]),
        holds=BESIDE,
    )


def family(measures: Mapping[str, float]) -> str:
    """Tell which of the two profiles fits sets better.

    Parameters
    ----------
    measures : mapping of str to float
        Of the sets.

    Returns
    -------
    str
        "exponential" or "power law", by a factor of ``BETTER`` in the residual at least; else "undecided".
    """
    ratio = measures["profile_residual_db"] / measures["powerlaw_residual_db"]
    return "exponential" if ratio < 1 / BETTER else "power law" if ratio > BETTER else "undecided"


def families(sets: SetCache) -> Iterator[ClaimRow]:
    """Which of the two profiles fits better, in dB of residual."""
    for row, spec, count, expected in (
        ("gbn", PAPER, 8, "exponential"),
        ("fpo", "fpo", 16, "exponential"),
        ("kdm", "kdm", 8, "exponential"),
        ("vnc", "voidcluster", 16, "exponential"),
        ("bnot", "", 0, "power law"),
        ("bnot-ours", "bnot", 16, "power law"),
        ("jittered", "jittered", 16, "power law"),
        ("sobol", "sobol", 16, "power law"),
        ("lloyd", "lloyd", 4, ""),
    ):
        drawn = sets.draw(spec, sets=count) if spec else sets.others(row)
        told = drawn.measures
        found = family(told)
        title = "bnot, our generator" if row == "bnot-ours" else row
        yield reported(
            row,
            f"residual of the exponential less that of the power law, dB, {title}",
            f"{'below' if expected == 'exponential' else 'above'} 0 ({expected})" if expected else "",
            told["profile_residual_db"] - told["powerlaw_residual_db"],
            of=drawn,
            holds=BESIDE
            if not expected
            else holds(found == expected, PARTLY if found == "undecided" else NO),
        )
        yield reported(
            f"{row}-exponential",
            f"rms residual of the exponential fit, dB, {title}",
            "",
            *drawn.value("profile_residual_db"),
            of=drawn,
        )
        if expected != "exponential":
            yield reported(
                f"{row}-exponent",
                f"exponent b of P ~ nu^b, {title}",
                "",
                *drawn.value("powerlaw_exponent"),
                of=drawn,
            )


def bnot_floor(sets: SetCache) -> Iterator[ClaimRow]:
    """Count them to BNOT's public sets."""
    bnot = sets.others("bnot")
    for depth, spec in (("10k", PAPER), ("1M", MILLION)):
        gbn = sets.draw(spec, sets=8)
        for row, measure in (("at-1", "power_at_1"), ("floor", "noise_floor")):
            found = over(bnot, gbn, measure)
            yield reported(
                f"{depth}-{row}",
                f"orders from GBN ({depth} steps) up to BNOT, {measure.replace('_', ' ')}",
                "2",
                *found,
                of=gbn,
                holds=holds(found[0] >= 2),
            )


def below(sets: SetCache) -> Iterator[ClaimRow]:
    """Where GBN's mean power meets that of polynomial families."""
    gbn = sets.draw(PAPER, sets=8).radial
    for name, drawn in (("bnot", sets.others("bnot")), ("jittered", sets.draw("jittered", sets=16))):
        ring = np.rint(gbn.frequency).astype(np.int64)
        mine, theirs = (
            np.bincount(ring, r.count * r.power) / np.maximum(np.bincount(ring, r.count), 1)
            for r in (gbn, drawn.radial)
        )
        above = np.flatnonzero(mine[1:] > theirs[1:]) + 1
        nu = float((above[0] if len(above) else ring.max()) * gbn.nu[0] / gbn.frequency[0])
        yield reported(
            name,
            f"lowest nu where a ring of GBN (10k) has more power than {name}",
            "a wide range below",
            nu,
            of=drawn,
            holds=holds(nu > 0.5),
        )


def summit(sets: SetCache) -> Iterator[ClaimRow]:
    """Find the highest ring."""
    for row, spec, title in (("10k", PAPER, "10,000 steps"), ("1M", MILLION, "as deep as 1M steps")):
        drawn = sets.draw(spec, sets=8)
        found = drawn.value("peak")
        yield reported(
            row,
            f"largest ring of the mean spectrum, white noise being 1, {title}",
            "at most 4",
            *found,
            of=drawn,
            holds=holds(found[0] <= 4),
        )
