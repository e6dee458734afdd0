"""Every generator by name, and ``generate``, which draws seeded realizations from one."""

from __future__ import annotations

import dataclasses
import numbers
from collections.abc import Mapping

import numpy as np

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.memory import too_large
from gbnbench.core.settings import configure, nearest, parse
from gbnbench.core.torus import FloatArray
from gbnbench.generators.direct.halton import Halton
from gbnbench.generators.direct.jittered import Jittered
from gbnbench.generators.direct.latin_hypercube import LatinHypercube
from gbnbench.generators.direct.sobol import Sobol
from gbnbench.generators.direct.uniform import Uniform
from gbnbench.generators.fpo.generator import FarthestPoint
from gbnbench.generators.gbn.generator import GaussianBlueNoise
from gbnbench.generators.kernel_based.electrostatic import Electrostatic
from gbnbench.generators.kernel_based.kernel_density import KernelDensityModel
from gbnbench.generators.kernel_based.kernel_energy import KernelEnergy
from gbnbench.generators.kernel_based.particle_hydrodynamics import ParticleHydrodynamics
from gbnbench.generators.kernel_based.spectral_sampling import SpectralSampling
from gbnbench.generators.kernel_based.void_and_cluster import VoidAndCluster
from gbnbench.generators.lattices.hexagonal import Hexagonal
from gbnbench.generators.lattices.regular_grid import Grid
from gbnbench.generators.monitor import Monitor, MonitoredGenerator, refuse_all_but_progress
from gbnbench.generators.protocol import Generator, ListedGenerator, checked_draw, realization_rng
from gbnbench.generators.spectral_control.deep import Deep
from gbnbench.generators.spectral_control.stealthy import Stealthy
from gbnbench.generators.voronoi.lloyd import Lloyd
from gbnbench.opencl import use_device

GENERATORS: dict[str, type[ListedGenerator]] = {
    "random": Uniform,
    "grid": Grid,
    "hexagonal": Hexagonal,
    "jittered": Jittered,
    "latin": LatinHypercube,
    "halton": Halton,
    "sobol": Sobol,
    "lloyd": Lloyd,
    "fpo": FarthestPoint,
    "voidcluster": VoidAndCluster,
    "kdm": KernelDensityModel,
    "kernelenergy": KernelEnergy,
    "electrostatic": Electrostatic,
    "sph": ParticleHydrodynamics,
    "oztireli": SpectralSampling,
    "gbn": GaussianBlueNoise,
    "deep": Deep,
    "stealthy": Stealthy,
}
# Keywords of ``generate``, which no setting may be named after.
RESERVED = frozenset({"name", "n", "d", "seed", "realizations", "monitor", "device", "settings"})


def check_setting_names(kind: type[object]) -> None:
    """Refuse a generator with a setting of the name of a keyword of ``generate``, which would never reach it.

    Raises
    ------
    InputError
        If there is such a setting.
    """
    fields = {field.name for field in dataclasses.fields(kind)}  # type: ignore[arg-type]
    if taken := sorted(fields & RESERVED):
        raise InputError(
            f"a setting of a generator must not be named as a keyword of generate; {kind.__name__} has "
            f"{', '.join(taken)}: rename it"
        )


for _kind in GENERATORS.values():
    check_setting_names(_kind)


def find(text: str, **settings: object) -> Generator:
    """Return the generator that a text such as ``gbn[sigma=0.8]`` describes.

    Parameters
    ----------
    text : str
        A name of ``GENERATORS``, with settings in brackets where they are not the defaults.
    **settings
        More settings, as values or text.

    Returns
    -------
    Generator

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


def of_instance(generator: object, settings: Mapping[str, object] | None = None) -> Generator:
    """Return a generator that came as an instance, of the registry or somebody's own, or say what it lacks.

    Parameters
    ----------
    generator : Generator
        An instance of a frozen dataclass with what ``Generator`` asks for.
    settings : mapping, optional
        What was given beside it: it has its settings already, so there must be none.

    Returns
    -------
    Generator
        The instance itself.

    Raises
    ------
    InputError
        If it is a class, no frozen dataclass, or no generator, if a setting of it has the name of a keyword
        of ``generate``, or if settings came with it.
    """
    kind = type(generator)
    if isinstance(generator, type):
        raise InputError(f"a generator must be an instance; got the class: write {generator.__name__}()")
    if not isinstance(generator, Generator):
        raise InputError(
            "a generator must be text such as 'gbn[sigma=0.8]', or an object with name, summary, "
            f"refusal(n, d) and __call__(n, d, rng); got {kind.__name__}"
        )
    frozen = getattr(getattr(kind, "__dataclass_params__", None), "frozen", False)
    if not (dataclasses.is_dataclass(generator) and frozen):
        raise InputError(f"a generator must be a frozen dataclass of its settings; {kind.__name__} is none")
    check_setting_names(kind)
    if settings:
        given = ", ".join(f"{name}=..." for name in settings)
        raise InputError(f"an instance has its settings already: write {kind.__name__}({given})")
    return generator


def generate(
    name: str | Generator,
    n: int,
    d: int = 2,
    seed: int = 0,
    realizations: int = 1,
    monitor: Monitor | None = None,
    device: str | None = None,
    **settings: object,
) -> FloatArray:
    """Draw point sets on the unit torus.

    Parameters
    ----------
    name : str or Generator
        One of ``GENERATORS``, with or without settings in brackets: ``"gbn[sigma=0.8]"``; or an instance of
        a generator of your own, whose sets are seeded in the same way.
    n : int
        Points a set, >= 1.
    d : int
        Dimension, >= 1.
    seed : int
        >= 0. Realization k draws from ``SeedSequence(seed, spawn_key=(k,))``,
        whatever the generator and however many are asked for.
    realizations : int
        Sets, >= 1.
    monitor : Monitor, optional
        Progress, a trace of the optimiser, checkpoints to go on from.
    device : str, optional
        OpenCL device for generators that use one: an index or part of a name, as ``gbnbench devices`` lists
        them; without it that of ``$GBNBENCH_DEVICE``, else the best found.
    **settings
        The generator's settings, where it is named.

    Returns
    -------
    (n, d) or (realizations, n, d) float64
        In [0, 1); without the first axis for one realization.

    Raises
    ------
    InputError
        If the name, a setting or an argument is wrong, a checkpoint is of another run, a trace or a
        checkpoint is asked of a generator that has none, or what was drawn is no set of n points.
    RefusalError
        If the generator cannot make n points in d dimensions.
    DeviceError
        If there is no such device.

    Examples
    --------
    >>> generate("jittered", n=16, seed=1).shape, generate("lloyd[iterations=5]", n=10, realizations=3).shape
    ((16, 2), (3, 10, 2))
    """
    generator = find(name, **settings) if isinstance(name, str) else of_instance(name, settings)
    seed, realizations = _whole("seed", seed, 0), _whole("realizations", realizations, 1)
    n, d = _whole("n", n, 1), _whole("d", d, 1)
    if reason := too_large(8.0 * realizations * n * d):
        raise RefusalError(f"{realizations} sets of n={n} points in d={d} {reason}; draw fewer at a time")
    if reason := generator.refusal(n, d):
        raise RefusalError(reason)
    with use_device(device):
        sets = _draw(
            generator, n, d, [realization_rng(seed, k) for k in range(realizations)], monitor or Monitor()
        )
    return sets[0] if realizations == 1 else sets


def _draw(
    generator: Generator, n: int, d: int, rngs: list[np.random.Generator], monitor: Monitor
) -> FloatArray:
    if isinstance(generator, MonitoredGenerator):
        return generator.draw(n, d, rngs, monitor)
    refuse_all_but_progress(monitor, generator.name)
    sets = []
    for k, rng in enumerate(rngs):
        sets.append(checked_draw(generator, generator(n, d, rng), n, d))
        if monitor.progress is not None:
            monitor.progress(k + 1, len(rngs), generator.name)
    return np.stack(sets)


def _whole(what: str, value: object, least: int) -> int:
    if not isinstance(value, numbers.Integral) or isinstance(value, bool) or int(value) < least:
        raise InputError(f"{what} must be a whole number >= {least}; got {value!r}")
    return int(value)
