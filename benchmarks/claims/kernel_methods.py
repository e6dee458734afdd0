"""Claims about profiles and floors of other kernel-based methods: KDM, VnC, BlueNets and more (Sec. 3.2)."""

from __future__ import annotations

import math
from collections.abc import Iterator

from gbnbench.benchmarks.claims.claim import BESIDE, NO, PARTLY, ClaimRow, holds, reported
from gbnbench.benchmarks.claims.profile import NEAR, STEEPNESS, family, over
from gbnbench.benchmarks.claims.sets import MILLION, DrawnSets, SetCache

# The other kernel-based methods that Sec. 2.1 lists, with the number of sets that are drawn.
OTHERS = {
    "vnc": ("voidcluster", 16, "VnC"),
    "kdm": ("kdm", 8, "KDM"),
    "bluenets": ("bluenets", 8, "BlueNets"),
    "schmaltz": ("electrostatic", 8, "Schmaltz et al. 2010"),
    "jiang": ("sph", 8, "Jiang et al. 2015"),
    "oztireli": ("oztireli", 8, "Öztireli et al. 2010"),
}
DRAWN = ("vnc", "kdm")  # with which Fig. 1(g) compares
KDM_WIDTH = math.sqrt(0.5 / math.pi)  # spacings: its kernel is exp(-pi r^2)
VNC_WIDTH = 1.5  # pixels


def draw(sets: SetCache, name: str) -> DrawnSets:
    """Draw the sets of another method.

    Parameters
    ----------
    sets : SetCache
        Which draws them once.
    name : str
        One of ``OTHERS``.

    Returns
    -------
    DrawnSets
    """
    spec, count, _ = OTHERS[name]
    return sets.draw(spec, sets=count)


def profiles(sets: SetCache) -> Iterator[ClaimRow]:
    """Tell the family of each profile, and c beside that of Eq. (13) for the method's own Gaussian."""
    for row in ("kdm", "vnc", "bluenets"):
        drawn, title = draw(sets, row), OTHERS[row][2]
        expected = "undecided" if row == "bluenets" else "exponential"
        found = family(drawn.measures)
        yield reported(
            row,
            f"residual of the exponential less that of the power law, dB, {title}",
            "near 0 (mixed)" if row == "bluenets" else "below 0 (exponential)",
            drawn.measures["profile_residual_db"] - drawn.measures["powerlaw_residual_db"],
            of=drawn,
            holds=holds(found == expected, PARTLY if found == "undecided" else NO),
        )
        yield reported(
            f"{row}-residual",
            f"rms residual of the exponential fit, dB, {title}",
            "",
            *drawn.value("profile_residual_db"),
            of=drawn,
        )
    wide = sets.draw("bluenets[sigma=1]", sets=8)
    yield reported(
        "bluenets-1",
        "residual of the exponential less that of the power law, dB, BlueNets with sigma = 1",
        "",
        wide.measures["profile_residual_db"] - wide.measures["powerlaw_residual_db"],
        of=wide,
    )
    yield _steepness("kdm-c", "KDM", draw(sets, "kdm"), KDM_WIDTH)
    for share, n, count in ((0.0625, 1024, 16), (0.125, 2048, 8), (0.25, 4096, 8)):
        spec = "voidcluster" if share == 0.0625 else f"voidcluster[share={share}]"
        drawn = sets.draw(spec, n=n, sets=count)
        width = VNC_WIDTH * math.sqrt(share)
        yield _steepness(f"vnc-c-{share:g}", f"VnC with {1 / share:.0f} pixels a point", drawn, width)


def _steepness(row: str, title: str, drawn: DrawnSets, width: float) -> ClaimRow:
    share, error = (v / (STEEPNESS * width**2) for v in drawn.value("profile_c"))
    return reported(
        row,
        f"c over 4 pi^2 sigma^2, sigma = {width:.3f} spacings, {title}",
        f"1 within {NEAR:.0%} (Eq. 13: faithfully)",
        share,
        error,
        of=drawn,
        holds=holds(abs(share - 1) < NEAR, PARTLY),
    )


def farthest_points(sets: SetCache) -> Iterator[ClaimRow]:
    """Compare the exponents of FPO and of void and cluster."""
    drawn = {"fpo": sets.draw("fpo", sets=64), "vnc": sets.draw("voidcluster", sets=64)}
    for row, title in (("fpo", "FPO"), ("vnc", "VnC")):
        yield reported(
            row, f"c of an exponential fit, {title}", "", *drawn[row].value("profile_c"), of=drawn[row]
        )
    (fpo, fpo_error), (vnc, vnc_error) = (drawn[row].value("profile_c") for row in ("fpo", "vnc"))
    yield reported(
        "ratio",
        "c of FPO over that of VnC",
        f"1 within {NEAR:.0%} (the same exponent)",
        fpo / vnc,
        fpo / vnc * math.hypot(fpo_error / fpo, vnc_error / vnc),
        of=drawn["vnc"],
        holds=holds(abs(fpo / vnc - 1) < NEAR),
    )


def floors(sets: SetCache) -> Iterator[ClaimRow]:
    """Orders of magnitude from the floors of kernel-based methods to that of GBN as deep as Fig. 1's."""
    deep = sets.draw(MILLION, sets=8)
    drawn = {"fpo": (sets.draw("fpo", sets=16), "FPO", "")}
    drawn |= {
        row: (
            draw(sets, row),
            title,
            "10, as Fig. 1(g) draws it" if row in DRAWN else "10, if it is the best",
        )
        for row, (_, _, title) in OTHERS.items()
    }
    for row, (other, title, paper) in drawn.items():
        for ending, measure in (("floor", "noise_floor"), ("at-1", "power_at_1")):
            orders, error = over(other, deep, measure)
            yield reported(
                f"{row}-{ending}",
                f"orders from GBN (1M steps) up to {title}, {measure.replace('_', ' ')}",
                paper,
                orders,
                error,
                of=other,
                holds=holds(orders >= 9.5, PARTLY if orders >= 8.5 else NO) if paper else BESIDE,
            )
