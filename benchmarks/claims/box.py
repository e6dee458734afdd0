"""Claims about the box, whose faces push: Eq. (24) to (26), the distance of points from faces, the cost."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np
from scipy.integrate import dblquad

from gbnbench.benchmarks.claims.claim import BESIDE, ClaimRow, holds, reported
from gbnbench.benchmarks.claims.sets import FAST, SetCache
from gbnbench.benchmarks.timing.interleaved import interleave
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.box import BoxEnergy, domain_pull
from gbnbench.generators.gbn.energy import energy_evaluation


def balance(_: SetCache) -> Iterator[ClaimRow]:
    """Pull of the domain against the push of a continuum of points, near a face."""
    side, sigma, fine = 12.0, 1.0, 1200
    axis = (np.arange(fine) + 0.5) * side / fine

    def push(x: float) -> float:
        """Eq. (18) of the continuum, without its factor."""
        near = np.exp(-((axis - x) ** 2) / (2 * sigma**2))
        along = np.exp(-((axis - 3.0) ** 2) / (2 * sigma**2))
        return float(np.sum((axis - x) * near) * np.sum(along)) * (side / fine) ** 2

    def pull(x: float, width: float) -> float:
        """Eq. (24), without a factor as it is printed, 2 width^2 in its exponent."""
        return float(domain_pull(np.array([x, 3.0]), side, width)[1][0]) * width**2

    wide = math.sqrt(2) * sigma
    for row, width, factor, title in (
        ("printed", wide, 1.0, "4 sigma^2 and no factor, as printed,"),
        ("gradient", wide, 0.5, "4 sigma^2 and a factor of 1/2 (both gradients of Gaussians of height 1)"),
        ("standard", sigma, 1.0, "2 sigma^2"),
    ):
        away = abs(factor * pull(0.5, width) / push(0.5) - 1)
        yield reported(
            row,
            f"relative imbalance of the domain's pull with {title} and the points' push of Eq. 18",
            "0",
            away,
            d=2,
            holds=holds(away < 1e-4) if row == "printed" else BESIDE,
        )
    change = pull(1.5, wide) / push(1.5) / (pull(0.5, wide) / push(0.5))
    yield reported(
        "constant",
        "pull over push 1.5 sigma from a face over that 0.5 sigma from it, 4 sigma^2",
        "1 (a constant factor would balance them)",
        change,
        d=2,
        holds=holds(abs(change - 1) < 1e-4),
    )
    pulls = [domain_pull(np.array([x, 3.0]), side, math.sqrt(2) * sigma)[1][0] for x in (0.5, 1.5)]
    found = [
        dblquad(
            lambda x, y, at=at: (x - at) * math.exp(-((x - at) ** 2 + (y - 3) ** 2) / (4 * sigma**2)),
            0,
            side,
            0,
            side,
            epsabs=1e-10,
        )[0]
        for at in (0.5, 1.5)
    ]
    away = abs(pulls[0] / pulls[1] / (found[0] / found[1]) - 1)
    yield reported(
        "eq-26",
        "relative difference of Eq. 26 from the integral of Eq. 24, as a ratio of two places",
        "0",
        float(away),
        d=2,
        holds=holds(bool(away < 1e-7)),
    )


def outermost(u: FloatArray, side: float) -> FloatArray:
    """Measure how far the outermost points stand from the faces of the box.

    Parameters
    ----------
    u : (n, d) float64
        Points, in spacings.
    side : float
        Side of the box, in spacings.

    Returns
    -------
    (strips,) float64
        Distance from each face to the nearest point of each strip, one spacing wide, that stands on it.
    """
    count = math.floor(side)
    found = []
    for axis in (0, 1):
        strip = np.minimum((u[:, 1 - axis] * count / side).astype(np.int64), count - 1)
        for away in (u[:, axis], side - u[:, axis]):
            nearest = np.full(count, np.inf)
            np.minimum.at(nearest, strip, away)
            found.append(nearest[np.isfinite(nearest)])
    return np.concatenate(found)


def border(sets: SetCache) -> Iterator[ClaimRow]:
    """Distance of a box's outermost points from its faces."""
    offsets = []
    for sigma in (0.7, 1.0, 1.5):
        drawn = sets.draw(f"gbn[domain=box,sigma={sigma:g}]", sets=3)
        side = math.sqrt(drawn.x.shape[1])
        each = np.array([float(outermost(x * side, side).mean()) for x in drawn.x])
        offsets.append(float(each.mean()))
        yield reported(
            f"offset-{sigma:g}",
            f"mean distance of the outermost points from the faces, spacings, sigma = {sigma:g}",
            "of the order of sigma (0.3 to 3)" if sigma == 1 else "",
            offsets[-1],
            float(each.std(ddof=1) / math.sqrt(len(each))),
            of=drawn,
            holds=holds(0.3 < offsets[-1] < 3) if sigma == 1 else BESIDE,
        )
        extreme = float(np.concatenate([drawn.x.min(axis=1), 1 - drawn.x.max(axis=1)]).mean() * side)
        yield reported(
            f"extreme-{sigma:g}", f"distance of the nearest point to each, sigma = {sigma:g}", "", extreme,
            of=drawn,
        )  # fmt: skip
    growth = offsets[-1] / offsets[0] / (1.5 / 0.7)
    yield reported(
        "growth", "growth of the mean from sigma = 0.7 to 1.5 over that of sigma", "1 (in proportion)",
        growth, of=drawn, holds=holds(abs(growth - 1) < 0.2),
    )  # fmt: skip


def box_cost(sets: SetCache) -> Iterator[ClaimRow]:
    """CPU time of a gradient in the box over one on the torus."""
    x = sets.draw(FAST, n=4096, sets=1).x
    box, torus = BoxEnergy(4096, 2, 1.0, "double"), energy_evaluation(4096, 2, 1.0, "double")
    timings = interleave({"box": lambda: box(x), "torus": lambda: torus(x)}, 1.0)
    ratio = timings["box"].over(timings["torus"])
    yield reported(
        "cost",
        "CPU time of a gradient in the box over that on the torus, ours",
        "below 1",
        float(np.median(ratio)),
        float(ratio.std(ddof=1) / math.sqrt(len(ratio))),
        n=4096,
        d=2,
        sets=1,
        holds=holds(float(np.median(ratio)) < 1),
    )
