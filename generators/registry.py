"""Every generator by name, and ``generate``, which draws seeded realizations from one."""

from __future__ import annotations

import numbers

import numpy as np

from gbnbench.errors import InputError, RefusalError
from gbnbench.generators.deep import Deep
from gbnbench.generators.fpo import FarthestPoint
from gbnbench.generators.gbn.generator import GaussianBlueNoise
from gbnbench.generators.grid import Grid
from gbnbench.generators.halton import Halton
from gbnbench.generators.hexagonal import Hexagonal
from gbnbench.generators.jittered import Jittered
from gbnbench.generators.latin import LatinHypercube
from gbnbench.generators.lloyd import Lloyd
from gbnbench.generators.memory import too_large
from gbnbench.generators.protocol import Generator, realization_rng
from gbnbench.generators.sobol import Sobol
from gbnbench.generators.stealthy import Stealthy
from gbnbench.generators.uniform import Uniform
from gbnbench.generators.watch import Watch, Watchable, only_progress
from gbnbench.settings import configure, nearest, parse
from gbnbench.torus import FloatArray

GENERATORS: dict[str, type[Generator]] = {
    "random": Uniform,
    "grid": Grid,
    "hexagonal": Hexagonal,
    "jittered": Jittered,
    "latin": LatinHypercube,
    "halton": Halton,
    "sobol": Sobol,
    "lloyd": Lloyd,
    "fpo": FarthestPoint,
    "gbn": GaussianBlueNoise,
    "deep": Deep,
    "stealthy": Stealthy,
}


def find(text: str, **settings: object) -> Generator:
    """Return the generator that a text such as ``gbn[sigma=0.8]`` describes.

    Parameters
    ----------
    text : str
        A name of ``GENERATORS``, with settings in brackets where they are not the defaults.
    **settings
        More settings, as values or text.

    Raises
    ------
    InputError
        If the text is malformed, the name or a setting unknown, a value wrong, or a setting given twice.

    Examples
    --------
    >>> find("lloyd[iterations=50]", tolerance=0)
    Lloyd(iterations=50, tolerance=0.0)
    """
    name, inside = parse(text)
    if name not in GENERATORS:
        raise InputError(
            f"no generator is named {name!r}{nearest(name, GENERATORS)}; there are {', '.join(GENERATORS)}"
        )
    twice = sorted(inside.keys() & settings.keys())
    if twice:
        raise InputError(f"a setting must come once; got {twice[0]!r} in {text!r} and as an argument")
    return configure(GENERATORS[name], {**inside, **settings})


def generate(
    name: str,
    n: int,
    d: int = 2,
    seed: int = 0,
    realizations: int = 1,
    watch: Watch | None = None,
    **settings: object,
) -> FloatArray:
    """Draw point sets on the unit torus.

    Parameters
    ----------
    name : str
        One of ``GENERATORS``, with or without settings in brackets: ``"gbn[sigma=0.8]"``.
    n : int
        Points a set, >= 1.
    d : int
        Dimension, >= 1.
    seed : int
        >= 0. Realization k draws from ``SeedSequence(seed, spawn_key=(k,))``,
        whatever the generator and however many are asked for.
    realizations : int
        Sets, >= 1.
    watch : Watch, optional
        Progress, a trace of the optimiser, checkpoints to go on from.
    **settings
        The generator's settings.

    Returns
    -------
    (n, d) or (realizations, n, d) float64
        In [0, 1); without the first axis for one realization.

    Raises
    ------
    InputError
        If the name, a setting or an argument is wrong, a checkpoint is of another run, or a trace or a
        checkpoint is asked of a generator that has none.
    RefusalError
        If the generator cannot make n points in d dimensions.

    Examples
    --------
    >>> generate("jittered", n=16, seed=1).shape, generate("lloyd[iterations=5]", n=10, realizations=3).shape
    ((16, 2), (3, 10, 2))
    """
    generator = find(name, **settings)
    seed, realizations = _whole("seed", seed, 0), _whole("realizations", realizations, 1)
    n, d = _whole("n", n, 1), _whole("d", d, 1)
    if reason := too_large(8.0 * realizations * n * d):
        raise RefusalError(f"{realizations} sets of n={n} points in d={d} {reason}; draw fewer at a time")
    if reason := generator.refusal(n, d):
        raise RefusalError(reason)
    sets = _draw(generator, n, d, [realization_rng(seed, k) for k in range(realizations)], watch or Watch())
    return sets[0] if realizations == 1 else sets


def _draw(generator: Generator, n: int, d: int, rngs: list[np.random.Generator], watch: Watch) -> FloatArray:
    if isinstance(generator, Watchable):
        return generator.draw(n, d, rngs, watch)
    only_progress(watch, generator.name)
    sets = []
    for k, rng in enumerate(rngs):
        sets.append(generator(n, d, rng))
        if watch.progress is not None:
            watch.progress(k + 1, len(rngs), generator.name)
    return np.stack(sets)


def _whole(what: str, value: object, least: int) -> int:
    if not isinstance(value, numbers.Integral) or isinstance(value, bool) or int(value) < least:
        raise InputError(f"{what} must be a whole number >= {least}; got {value!r}")
    return int(value)
