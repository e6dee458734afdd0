"""Every adaptive generator by name, and ``adaptive_points``, which draws a seeded set from one."""

from __future__ import annotations

import numbers
from collections.abc import Sequence

import numpy as np

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.settings import configure, nearest, parse
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.charges.electrostatic import ElectrostaticHalftoning
from gbnbench.generators.adaptive.density import Density
from gbnbench.generators.adaptive.dithering.error_diffusion import FloydSteinberg
from gbnbench.generators.adaptive.dithering.mask import VoidAndClusterDither
from gbnbench.generators.adaptive.farthest_point.generator import WeightedFarthestPoint
from gbnbench.generators.adaptive.gbn.generator import AdaptiveGaussianBlueNoise
from gbnbench.generators.adaptive.kernel_density.kdm import AdaptiveKernelDensity
from gbnbench.generators.adaptive.power_cells.bnot import WeightedOptimalTransport
from gbnbench.generators.adaptive.protocol import AdaptiveGenerator, ClassGenerator, Seen, Told
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
    "kdm": AdaptiveKernelDensity,
    "fpo": WeightedFarthestPoint,
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
    (x,) = adaptive_classes(generator, [density], [n], seed=seed, first=realization, told=told)
    return x


def adaptive_classes(
    generator: AdaptiveGenerator | str,
    densities: Sequence[Density],
    counts: Sequence[int],
    *,
    seed: int = 0,
    first: int = 0,
    told: Told | None = None,
    seen: Seen | None = None,
) -> list[FloatArray]:
    """Draw sets of several classes, such as inks.

    Parameters
    ----------
    generator : AdaptiveGenerator or str
        As ``adaptive_generator`` reads it: a ``ClassGenerator`` draws them together, others each by itself.
    densities : sequence of Density
        One a class, on one grid of pixels.
    counts : sequence of int
        Points of each, at least 1.
    seed, first : int
        Class k draws from child ``first`` + k of the seed's ``SeedSequence``.
    told : callable, optional
        Called with (steps done, steps in all, what is being done).
    seen : callable, optional
        Called by a ``ClassGenerator`` with the points at the start and after each step.

    Returns
    -------
    list of (n, d) float64
        In pixels, in the order of their axes: rows first.

    Raises
    ------
    InputError
        If an argument breaks its rule, or ``seen`` goes with a generator that shows no steps.
    RefusalError
        If the generator cannot make such sets.
    """
    made = adaptive_generator(generator) if isinstance(generator, str) else generator
    for name, value, least in (*(("n", n, 1) for n in counts), ("seed", seed, 0), ("realization", first, 0)):
        if isinstance(value, bool) or not isinstance(value, numbers.Integral) or value < least:
            raise InputError(f"{name} must be an integer >= {least}; got {value!r}")
    if len({one.shape for one in densities}) > 1:
        raise InputError("densities of classes have one grid of pixels; these have several")
    for density, n in zip(densities, counts, strict=True):
        if reason := made.refusal(density, int(n)):
            raise RefusalError(f"{made.name}: {reason}")
    rngs = [realization_rng(int(seed), int(first) + k) for k in range(len(counts))]
    if isinstance(made, ClassGenerator):
        sets = made.classes(densities, [int(n) for n in counts], rngs, told, seen)
    elif seen is not None:
        raise InputError(f"{made.name} does not show how its points form; gbn does")
    else:
        drawn = enumerate(zip(densities, counts, rngs, strict=True))
        sets = [made(one, int(n), rng, _of_class(told, k, len(rngs))) for k, (one, n, rng) in drawn]
    within = np.nextafter(np.array(densities[0].shape, np.float64), 0)
    return [np.minimum(x, within) for x in sets]


def _of_class(told: Told | None, k: int, classes: int) -> Told | None:
    """Count the steps of a class among those of all."""
    if told is None or classes == 1:
        return told
    return lambda done, total, doing: told(k * total + done, classes * total, doing)
