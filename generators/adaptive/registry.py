"""Every adaptive generator by name, and ``adaptive_points``, which draws a seeded set from one."""

from __future__ import annotations

import numbers

import numpy as np

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.settings import configure, nearest, parse
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.charges.electrostatic import ElectrostaticHalftoning
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.dithering.error_diffusion import FloydSteinberg
from gbnbench.generators.adaptive.dithering.mask import VoidAndClusterDither
from gbnbench.generators.adaptive.gbn.generator import AdaptiveGaussianBlueNoise
from gbnbench.generators.adaptive.power_cells.bnot import WeightedOptimalTransport
from gbnbench.generators.adaptive.protocol import AdaptiveGenerator, Told
from gbnbench.generators.adaptive.rejection import Rejection
from gbnbench.generators.adaptive.voronoi.linde_buzo_gray import LindeBuzoGray
from gbnbench.generators.adaptive.voronoi.secord import WeightedVoronoi
from gbnbench.generators.protocol import realization_rng

ADAPTIVE_GENERATORS: dict[str, type[AdaptiveGenerator]] = {
    "gbn": AdaptiveGaussianBlueNoise,
    "secord": WeightedVoronoi,
    "lbg": LindeBuzoGray,
    "bnot": WeightedOptimalTransport,
    "electrostatic": ElectrostaticHalftoning,
    "rejection": Rejection,
    "floydsteinberg": FloydSteinberg,
    "voidcluster": VoidAndClusterDither,
}


def adaptive_generator(text: str) -> AdaptiveGenerator:
    """Make an adaptive generator from its name and settings.

    Parameters
    ----------
    text : str
        ``name`` or ``name[setting=value,...]``.

    Returns
    -------
    AdaptiveGenerator

    Raises
    ------
    InputError
        If there is no such generator, or a setting is unknown or out of range.
    """
    name, settings = parse(text, "an adaptive generator")
    if name not in ADAPTIVE_GENERATORS:
        known = ", ".join(ADAPTIVE_GENERATORS)
        raise InputError(
            f"{name!r} is no adaptive generator{nearest(name, ADAPTIVE_GENERATORS)}; there are {known}"
        )
    return configure(ADAPTIVE_GENERATORS[name], settings)


def adaptive_points(
    generator: AdaptiveGenerator | str,
    density: Density,
    n: int,
    *,
    seed: int = 0,
    realization: int = 0,
    told: Told | None = None,
) -> FloatArray:
    """Draw a set of points for a density.

    Parameters
    ----------
    generator : AdaptiveGenerator or str
        As ``adaptive_generator`` reads it.
    density : Density
        The density.
    n : int
        Points, at least 1.
    seed, realization : int
        The set draws from this child of the seed's ``SeedSequence``.
    told : callable, optional
        Called with (steps done, steps in all, what is being done).

    Returns
    -------
    (n, d) float64
        Within the density, in pixels, in the order of its axes: rows first.

    Raises
    ------
    InputError
        If an argument breaks its rule.
    RefusalError
        If the generator cannot make such a set.
    """
    made = adaptive_generator(generator) if isinstance(generator, str) else generator
    for name, value, least in (("n", n, 1), ("seed", seed, 0), ("realization", realization, 0)):
        if isinstance(value, bool) or not isinstance(value, numbers.Integral) or value < least:
            raise InputError(f"{name} must be an integer >= {least}; got {value!r}")
    if reason := made.refusal(density, int(n)):
        raise RefusalError(f"{made.name}: {reason}")
    x = made(density, int(n), realization_rng(int(seed), int(realization)), told)
    within = np.nextafter(np.array(density.shape, np.float64), 0)
    return np.minimum(x, within)
