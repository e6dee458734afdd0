"""Orders of an adaptive set all of whose prefixes follow the density: void-and-cluster ranks of its points.

This is ``gbnbench.generators.kernel_based.progressive_order`` with the kernels and the target of adaptive
Gaussian blue noise: half of the points is chosen to have a low energy for half of the density, of these a
quarter, and so on; what lies between comes in the order of largest voids (Ulichney 1993).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.gbn.generator import AdaptiveGaussianBlueNoise
from gbnbench.generators.adaptive.gbn.prefix_choice import PrefixChoice
from gbnbench.generators.adaptive.protocol import Told

FEWEST = 8  # points that are halved no further
PREFIXES = AdaptiveGaussianBlueNoise(sigma=0.8, spread=0.7)


def progressive_order(
    density: Density,
    x: FloatArray,
    settings: AdaptiveGaussianBlueNoise = PREFIXES,
    told: Told | None = None,
) -> NDArray[np.intp]:
    """Order points so that every prefix has the density, as evenly as a choice among them can.

    Parameters
    ----------
    density : Density
        What they were drawn for.
    x : (n, d) float64
        Points within it, in pixels, by any method.
    settings : AdaptiveGaussianBlueNoise
        Of the energy; nearer to faithful than the defaults for pictures, as the points are sharp already.
    told : callable, optional
        Called with (points in order, n, what is being done).

    Returns
    -------
    (n,) intp
        Indices of the points, first to last: ``x[order[:m]]`` is the prefix of m points.

    Notes
    -----
    A halving takes out the points that are most crowded for their density, then exchanges points for
    neighbours left out while that lowers the energy, 20 times over all points at most.

    Examples
    --------
    >>> from gbnbench.generators.adaptive.density import as_density
    >>> flat = as_density(np.ones((8, 8)))
    >>> order = progressive_order(flat, np.array([[1.0, 1.0], [1.1, 1.1], [1.2, 1.0], [7.0, 7.0]]))
    >>> bool(3 in order[:2])
    True
    """
    n = len(x)
    torus = density.shape if density.toroidal else None
    kept = np.arange(n)
    tail: list[NDArray[np.intp]] = []
    while True:
        last = len(kept) < 2 * FEWEST
        size = max(1, len(kept) // 2)
        choice = PrefixChoice(x[kept], *settings.pull(density, size, x[kept]), torus)
        choice.take_out_clusters(1 if last else size)
        if not last:
            choice.exchange()
        inside = choice.inside.copy()
        tail.insert(0, kept[choice.by_voids()])
        kept = kept[inside]
        if told is not None:
            told(n - len(kept), n, "points in progressive order")
        if last:
            return np.concatenate([kept, *tail])
