"""Claims about the descent in more than two dimensions (Sec. 4.8)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from gbnbench.benchmarks.claims.claim import BESIDE, ClaimRow, holds, reported
from gbnbench.benchmarks.claims.sets import FAST, SetCache
from gbnbench.core.errors import GbnbenchError
from gbnbench.core.periodic_delaunay import overhang, triangulation, with_images
from gbnbench.core.torus import FloatArray


def dimensions(sets: SetCache) -> Iterator[ClaimRow]:
    """Level eps of the lowest shell after 500 steps of descent, by the dimension and the step."""
    for step, title in (("auto", "the step that curvature allows"), ("authors", "the authors' step")):
        found: list[float] = []
        for d in (2, 3, 4, 8):
            drawn = sets.draw(f"gbn[iterations=500,step={step}]", d=d, sets=2)
            found.append(drawn.level)
            yield reported(
                f"{step}-{d}",
                f"P exp(-4 pi^2 nu^2) at |f| = 1 after 500 steps, d = {d}, {title}",
                "" if d == 2 else "below that of d = 2",
                found[-1],
                of=drawn,
                holds=BESIDE if d == 2 else holds(found[-1] < found[0]),
            )


def high(sets: SetCache) -> Iterator[ClaimRow]:
    """Floors of the same number of points in 2 to 8 dimensions, and that 20 dimensions move at all."""
    plane = sets.draw(FAST, sets=8)
    for d in (2, 3, 4, 6, 8):
        drawn = plane if d == 2 else sets.draw(FAST, d=d, sets=4)
        yield reported(
            f"level-{d}",
            f"P exp(-4 pi^2 nu^2) at |f| = 1 after 320 gradients, d = {d}",
            "" if d == 2 else "that of d = 2 or less",
            drawn.level,
            of=drawn,
            holds=BESIDE if d == 2 else holds(drawn.level < 2 * plane.level),
        )
        yield reported(f"at-1-{d}", f"P(|f| = 1), d = {d}", "", drawn.lowest, of=drawn)
    drawn = sets.draw(FAST, n=256, d=20, sets=2)
    yield reported(
        "twenty",
        "P(|f| = 1) in 20 dimensions, white noise being 1",
        "blue noise (far below 1)",
        drawn.lowest,
        of=drawn,
        holds=holds(drawn.lowest < 1e-3),
    )


def mean_degree(x: FloatArray, margin: float = 0.5) -> float:
    """Mean number of Delaunay neighbours of the points of a set on the torus, in any dimension.

    Parameters
    ----------
    x : (n, d) float64
        Points on the unit torus, in general position.
    margin : float
        Width of the border of images.

    Returns
    -------
    float

    Raises
    ------
    GbnbenchError
        If the border is not proven wide enough.
    """
    n, d = x.shape
    tiled, _ = with_images(x, margin)
    found = triangulation(tiled)
    if found is None:
        raise GbnbenchError(f"the {n} points and their images do not span {d} dimensions")
    simplices = found.simplices[(found.simplices < n).any(axis=1)]
    corner, *others = np.moveaxis(tiled[simplices], 1, 0)
    edges = np.stack(others, axis=1) - corner[:, None]
    centre = np.linalg.solve(2 * edges, np.sum(edges**2, axis=2)[..., None])[..., 0]
    if overhang(corner + centre, np.linalg.norm(centre, axis=1)) > margin:
        raise GbnbenchError(f"a border of {margin:g} is too narrow for the neighbours of {n} points in {d}D")
    pairs = simplices[:, np.array(np.triu_indices(d + 1, 1)).T].reshape(-1, 2)
    pairs = np.unique(np.sort(pairs, axis=1), axis=0)
    return float((pairs < n).sum() / n)
