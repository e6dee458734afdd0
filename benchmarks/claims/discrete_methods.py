"""The claim that discretised kernel methods converge, and to a shallow minimum (Sec. 4.2, 4.8)."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gbnbench.benchmarks.claims.claim import ClaimRow, holds, reported
from gbnbench.benchmarks.claims.kernel_methods import draw
from gbnbench.benchmarks.claims.profile import over
from gbnbench.benchmarks.claims.sets import MILLION, PAPER, SEED, SetCache
from gbnbench.generators.kernel_based.raster_energy import RasterEnergy
from gbnbench.generators.kernel_based.raster_kernel import gaussian
from gbnbench.generators.low_discrepancy.dyadic_net import GaussianEnergy, exchangeable_pairs
from gbnbench.generators.registry import generate

SAME_WIDTH = ((4, 0.0625), (8, 0.015625), (16, 0.00390625))  # pixels a spacing, and the share of ones with it
SETTLED = 1e-11  # gain in heights of the kernel that counts as none; rounding of the sums is below


def discrete(sets: SetCache) -> Iterator[ClaimRow]:
    """Tell how deep discretised methods end, with GBN's kernel too, and whether they stop."""
    gbn = sets.draw(PAPER, sets=8)
    found = {
        "vnc": (draw(sets, "vnc"), "VnC"),
        "kdm": (draw(sets, "kdm"), "KDM"),
        "kdm-cold": (sets.draw("kdm[temperature=0]", sets=4), "KDM at temperature 0"),
        "bluenets": (draw(sets, "bluenets"), "BlueNets"),
        "bluenets-1": (sets.draw("bluenets[sigma=1]", sets=8), "BlueNets with sigma = 1"),
    } | {
        f"vnc-{pixels}": (
            sets.draw(f"voidcluster[sigma={pixels},share={share},initial={share}]", sets=4),
            f"VnC with sigma = 1 and {pixels} pixels a spacing",
        )
        for pixels, share in SAME_WIDTH
    }
    for row, (drawn, title) in found.items():
        orders, error = over(drawn, gbn, "noise_floor")
        yield reported(
            row,
            f"orders from GBN's floor (10,000 steps) up to that of {title}",
            "above 1: a shallow minimum",
            orders,
            error,
            of=drawn,
            holds=holds(orders > 1),
        )
    for pixels, share in SAME_WIDTH[:1]:
        spec = f"voidcluster[sigma={pixels},share={share},initial={share},shift=false]"
        yield reported(
            "vnc-left",
            "what the best swap of a cluster and a void would still gain, VnC, heights of the kernel",
            "0 to rounding: it converges",
            gain := swap_gain(spec, pixels),
            n=1024,
            d=2,
            sets=1,
            holds=holds(gain < SETTLED),
        )
    left = exchanges_left(1.0)
    yield reported(
        "bluenets-left",
        "exchanges that would still lower the energy of a BlueNet with sigma = 1",
        "0: it converges",
        left,
        n=1024,
        d=2,
        sets=1,
        holds=holds(left == 0),
    )
    orders, error = over(gbn, sets.draw(MILLION, sets=8), "noise_floor")
    yield reported(
        "gbn-left",
        "orders that GBN's floor still falls, from 10,000 steps to 1M",
        "above 0: it does not converge",
        orders,
        error,
        of=gbn,
        holds=holds(orders > 0),
    )


def swap_gain(spec: str, sigma: float, n: int = 1024) -> float:
    """Return what moving the one in the tightest cluster to the largest void would gain, of one set.

    Parameters
    ----------
    spec : str
        A void-and-cluster pattern with ``sigma`` pixels a spacing, not shifted.
    sigma : float
        Width of its Gaussian in pixels.
    n : int
        Points.

    Returns
    -------
    float
        In heights of the Gaussian, 0 where it would gain nothing.
    """
    side = round(math.sqrt(n) * sigma)
    pattern = RasterEnergy((side, side), gaussian((side, side), sigma), np.random.default_rng(SEED))
    x = generate(spec, n=n, seed=SEED)
    for column, row in np.floor(x * side).astype(int):
        pattern.add(int(column * side + row))
    cluster = pattern.tightest_cluster()
    pattern.remove(cluster)
    return max(0.0, pattern.at(cluster) - pattern.at(pattern.largest_void()))


def exchanges_left(sigma: float, n: int = 1024, iterations: int = 1000) -> int:
    """Count the exchanges of two coordinates that would still lower the energy of one BlueNet.

    Parameters
    ----------
    sigma : float
        Width of its Gaussian in spacings.
    n : int
        Points, a power of two.
    iterations : int
        Most rounds that its optimiser takes.

    Returns
    -------
    int
    """
    m = n.bit_length() - 1
    x = generate("bluenets", n=n, seed=SEED, sigma=sigma, iterations=iterations)
    strata = np.floor(x * n).astype(np.int64)
    y = np.empty(n, dtype=np.int64)
    y[strata[:, 0]] = strata[:, 1]
    energy = GaussianEnergy(m, sigma)
    return sum(int((energy.change(y, exchangeable_pairs(y, level)) < -SETTLED).sum()) for level in range(m))
