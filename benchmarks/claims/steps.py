"""Claims of Supplement B: step blue noise, high dimensions, one dimension, neighbours."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from gbnbench.analysis.spatial.delaunay import neighbours
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.benchmarks.claims.claim import BESIDE, ClaimRow, holds, reported
from gbnbench.benchmarks.claims.high_dimensions import mean_degree
from gbnbench.benchmarks.claims.sets import FAST, PAPER, SetCache
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gauss_newton.modes import bound_coordinates, edge_binding
from gbnbench.generators.spectral_control.empty_band import band_power


def counted(_: SetCache) -> Iterator[ClaimRow]:
    """Real numbers that the bands bind, over the 2 N coordinates."""
    n = 1024
    side = math.isqrt(n)
    for row, reach in (("square-half", side // 2), ("square-whole", side)):
        share = ((2 * reach + 1) ** 2 - 1) / (2 * n)
        yield reported(
            row,
            f"real numbers in |f_a| <= {'sqrt(N) / 2' if reach < side else 'sqrt(N)'} over 2 N",
            "1 (as many as coordinates)" if reach < side else "",
            share,
            n=n,
            d=2,
            holds=holds(abs(share - 1) < 0.1) if reach < side else BESIDE,
        )
    yield reported(
        "disc-half",
        "the same in the disc |f| < sqrt(N) / 2",
        "",
        bound_coordinates(n, 2, 0.5) / (2 * n),
        n=n,
        d=2,
    )


def step(sets: SetCache) -> Iterator[ClaimRow]:
    """Largest power below the step's edge."""
    for row, spec, edge, title in (
        ("descent", "gbn[iterations=3000,edge=0.5]", 0.5, "3,000 steps of descent on the truncated energy"),
        ("nesterov", "stealthy[edge=0.5,method=harmonics]", 0.5, "Nesterov's method on it"),
        ("newton", "stealthy[edge=0.5]", 0.5, "minimum-norm Gauss-Newton"),
        ("beyond", "stealthy[edge=0.75]", 0.75, "the same beyond sqrt(N) / 2, to nu = 0.75"),
    ):
        drawn = sets.draw(spec, sets=2)
        most = float(max(band_power(x, edge).max() for x in drawn.x))
        yield reported(
            row,
            f"largest power below the edge, {title}",
            "below 1e-8" if row != "beyond" else "",
            most,
            of=drawn,
            holds=holds(most < 1e-8) if row != "beyond" else BESIDE,
        )


def heck(sets: SetCache) -> Iterator[ClaimRow]:
    """Lay the step of Heck et al. beside ours."""
    theirs = sets.others("step")
    ours = sets.draw("gbn[iterations=3000,edge=0.5]", sets=2)
    mean = [float(np.mean([band_power(x, 0.5).mean() for x in drawn.x])) for drawn in (theirs, ours)]
    yield reported("heck", "mean power below nu = 0.5, step of Heck et al.", "", mean[0], of=theirs)
    by_method = sets.draw("step", sets=4)
    mean.append(float(np.mean([band_power(x, 0.5).mean() for x in by_method.x])))
    yield reported("method", "the same, their method run to its end (`step`)", "", mean[2], of=by_method)
    for row, power, title in (("orders", mean[0], "it"), ("orders-method", mean[2], "their method's")):
        orders = math.log10(power / mean[1])
        yield reported(
            row,
            f"orders from ours (3,000 steps of descent) up to {title}",
            "orders of magnitude",
            orders,
            of=ours,
            holds=holds(orders > 2),
        )


def wide(sets: SetCache) -> Iterator[ClaimRow]:
    """Draw steps of one share of the coordinates in several dimensions."""
    for d, n in ((2, 1024), (3, 1000), (4, 1296)):
        edge = edge_binding(0.6, d)
        drawn = sets.draw("stealthy", n=n, d=d, sets=1)
        yield reported(
            f"power-{d}",
            f"largest power below the edge that binds 0.6 of the coordinates, d = {d}",
            "below 1e-8",
            float(band_power(drawn.x[0], edge).max()),
            of=drawn,
            holds=holds(float(band_power(drawn.x[0], edge).max()) < 1e-8),
        )
        yield reported(
            f"width-{d}",
            f"that edge in harmonics, d = {d}",
            "shrinks with d",
            edge * n ** (1 / d),
            of=drawn,
        )


def peaks(sets: SetCache) -> Iterator[ClaimRow]:
    """Height of the primary peak by dimension, n = 1024, 320 gradients."""
    found: list[float] = []
    for d in (2, 3, 4, 5):
        drawn = sets.draw(FAST, d=d, sets=8 if d == 2 else 4)
        value = drawn.value("peak")
        found.append(value[0])
        yield reported(
            f"peak-{d}",
            f"largest ring, d = {d}",
            "" if d == 2 else "below that of a dimension less",
            *value,
            of=drawn,
            holds=BESIDE if d == 2 else holds(found[-1] < found[-2]),
        )


def regularity(x: FloatArray) -> float:
    """P(n) / n of a set on the circle: 1 for the regular grid, 1/n for white noise."""
    n = len(x)
    return float(periodogram(x, frequencies=np.array([[n]])).power[0]) / n


def line(sets: SetCache) -> Iterator[ClaimRow]:
    """One dimension: the whole energy's way to the grid, and truncated energies."""
    n = 256
    for steps in (100, 10_000):
        drawn = sets.draw(f"gbn[iterations={steps}]", n=n, d=1, sets=2)
        grid = float(np.mean([regularity(x) for x in drawn.x]))
        yield reported(
            f"grid-{steps}",
            f"P(n) / n of the whole energy after {steps} steps (1 is the regular grid)",
            "near 1" if steps > 1000 else "",
            grid,
            of=drawn,
            holds=holds(grid > 0.9) if steps > 1000 else BESIDE,
        )
    for edge in (0.1, 0.3, 0.4):
        drawn = sets.draw(f"stealthy[edge={edge}]", n=n, d=1, sets=2)
        grid = float(np.mean([regularity(x) for x in drawn.x]))
        power = float(max(band_power(x, edge).max() for x in drawn.x))
        yield reported(
            f"band-{edge}",
            f"largest power below f = {edge} n of a stealthy set",
            "blue noise (below 1e-8)",
            power,
            of=drawn,
            holds=holds(power < 1e-8),
        )
        yield reported(
            f"order-{edge}",
            "P(n) / n of it",
            "no grid (below 0.5)",
            grid,
            of=drawn,
            holds=holds(grid < 0.5),
        )


def degrees(sets: SetCache) -> Iterator[ClaimRow]:
    """Mean number of neighbours."""
    for d, paper in ((2, "6"), (3, "13")):
        drawn = sets.draw(FAST, d=d, sets=8 if d == 2 else 4)
        each = np.array([float(one.degree.mean()) for one in neighbours(drawn.x)])
        yield reported(
            f"delaunay-{d}",
            f"mean number of Delaunay neighbours, d = {d}",
            paper,
            float(each.mean()),
            float(each.std(ddof=1) / math.sqrt(len(each))),
            of=drawn,
            holds=holds(abs(each.mean() - float(paper)) < 0.5),
        )
    small = sets.draw(FAST, n=512, d=4, sets=2)
    each = np.array([mean_degree(x) for x in small.x])
    yield reported(
        "delaunay-4",
        "mean number of Delaunay neighbours, d = 4",
        "24",
        float(each.mean()),
        float(each.std(ddof=1) / math.sqrt(len(each))),
        of=small,
        holds=holds(abs(each.mean() - 24) < 0.5),
    )


def lowest(sets: SetCache) -> Iterator[ClaimRow]:
    """Noise and peak of what Fig. 8 lays side by side."""
    gbn = sets.draw(PAPER, sets=8)
    others = {
        "bnot": sets.others("bnot"),
        "step": sets.others("step"),
        "fpo": sets.draw("fpo", sets=16),
        "lloyd": sets.draw("lloyd", sets=4),
        "kdm": sets.draw("kdm", sets=8),
        "vnc": sets.draw("voidcluster", sets=16),
        "ccvt": sets.draw("ccvt", sets=2),
        "bluenets": sets.draw("bluenets", sets=8),
    }
    for name, drawn in (("gbn", gbn), *others.items()):
        yield reported(
            f"floor-{name}",
            f"noise floor, {name}",
            "" if name == "gbn" else "above that of GBN",
            *drawn.value("noise_floor"),
            of=drawn,
            holds=BESIDE
            if name == "gbn"
            else holds(drawn.measures["noise_floor"] > gbn.measures["noise_floor"]),
        )
        yield reported(
            f"peak-{name}",
            f"peak, {name}",
            "" if name == "gbn" else "above that of GBN",
            *drawn.value("peak"),
            of=drawn,
            holds=BESIDE if name == "gbn" else holds(drawn.measures["peak"] > gbn.measures["peak"]),
        )
