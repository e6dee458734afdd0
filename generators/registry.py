"""Every generator by name, and ``generate``, which draws seeded realizations from one."""

from __future__ import annotations

import numpy as np

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.least_values import whole_number
from gbnbench.core.memory import too_large
from gbnbench.core.settings import configure, nearest, parse
from gbnbench.core.torus import FloatArray
from gbnbench.generators.ccvt.generator import CapacityConstrained
from gbnbench.generators.direct.best_candidate import BestCandidate
from gbnbench.generators.direct.bridson import Bridson
from gbnbench.generators.direct.dart_throwing import DartThrowing
from gbnbench.generators.direct.halton import Halton
from gbnbench.generators.direct.jittered import Jittered
from gbnbench.generators.direct.latin_hypercube import LatinHypercube
from gbnbench.generators.direct.maximal_poisson import MaximalPoisson
from gbnbench.generators.direct.sample_elimination import SampleElimination
from gbnbench.generators.direct.sobol import Sobol
from gbnbench.generators.direct.uniform import Uniform
from gbnbench.generators.fpo.generator import FarthestPoint
from gbnbench.generators.gbn.generator import GaussianBlueNoise
from gbnbench.generators.kernel_based.electrostatic import Electrostatic
from gbnbench.generators.kernel_based.kernel_density import KernelDensityModel
from gbnbench.generators.kernel_based.particle_hydrodynamics import ParticleHydrodynamics
from gbnbench.generators.kernel_based.progressive_gbn import ProgressiveGaussianBlueNoise
from gbnbench.generators.kernel_based.spectral_sampling import SpectralSampling
from gbnbench.generators.kernel_based.void_and_cluster import VoidAndCluster
from gbnbench.generators.kind_check import check_setting_names, of_instance
from gbnbench.generators.lattices.hexagonal import Hexagonal
from gbnbench.generators.lattices.regular_grid import Grid
from gbnbench.generators.low_discrepancy.blue_nets import BlueNets
from gbnbench.generators.low_discrepancy.correlated_multijitter import CorrelatedMultiJitter
from gbnbench.generators.low_discrepancy.hammersley import Hammersley
from gbnbench.generators.low_discrepancy.kronecker import Kronecker
from gbnbench.generators.low_discrepancy.latin_maximin import LatinMaximin
from gbnbench.generators.low_discrepancy.pmj02 import ProgressiveMultiJitter
from gbnbench.generators.low_discrepancy.rank1_lattice import Rank1Lattice
from gbnbench.generators.monitor import Monitor, MonitoredGenerator, refuse_all_but_progress
from gbnbench.generators.power_cells.bnot import OptimalTransport
from gbnbench.generators.protocol import Generator, ListedGenerator, checked_draw, realization_rng
from gbnbench.generators.sliced.generator import Sliced
from gbnbench.generators.spectral_control.deep import Deep
from gbnbench.generators.spectral_control.single_peak import SinglePeak
from gbnbench.generators.spectral_control.staircase import Staircase
from gbnbench.generators.spectral_control.stealthy import Stealthy
from gbnbench.generators.spectral_control.step import Step
from gbnbench.generators.spectral_control.targeted import Targeted
from gbnbench.generators.third_parties.faults import faults_in_words, refusal_of
from gbnbench.generators.voronoi.capcvt import CapacityConstrainedVoronoi
from gbnbench.generators.voronoi.lloyd import Lloyd
from gbnbench.opencl import use_device

GENERATORS: dict[str, type[ListedGenerator]] = {
    "random": Uniform,
    "grid": Grid,
    "hexagonal": Hexagonal,
    "rank1": Rank1Lattice,
    "jittered": Jittered,
    "darts": DartThrowing,
    "maximalpoisson": MaximalPoisson,
    "bridson": Bridson,
    "elimination": SampleElimination,
    "bestcandidate": BestCandidate,
    "latin": LatinHypercube,
    "latinmaximin": LatinMaximin,
    "cmj": CorrelatedMultiJitter,
    "hammersley": Hammersley,
    "halton": Halton,
    "sobol": Sobol,
    "kronecker": Kronecker,
    "pmj02": ProgressiveMultiJitter,
    "bluenets": BlueNets,
    "lloyd": Lloyd,
    "bnot": OptimalTransport,
    "capcvt": CapacityConstrainedVoronoi,
    "ccvt": CapacityConstrained,
    "fpo": FarthestPoint,
    "sliced": Sliced,
    "voidcluster": VoidAndCluster,
    "kdm": KernelDensityModel,
    "electrostatic": Electrostatic,
    "sph": ParticleHydrodynamics,
    "oztireli": SpectralSampling,
    "gbn": GaussianBlueNoise,
    "progressivegbn": ProgressiveGaussianBlueNoise,
    "deep": Deep,
    "stealthy": Stealthy,
    "step": Step,
    "peak": SinglePeak,
    "staircase": Staircase,
    "targeted": Targeted,
}

for _kind in GENERATORS.values():
    check_setting_names(_kind)


def kind_named(name: str) -> type[Generator] | None:
    """Find the class of a generator: gbnbench's own, a program of the user's file, or a package's.

    Raises
    ------
    InputError
        If it is one from elsewhere that cannot be used; the text says why.
    """
    if name in GENERATORS:
        return GENERATORS[name]
    from gbnbench.generators.third_parties.discovery import third_party  # slow to load, and seldom needed

    return third_party(name)


def generator_names() -> list[str]:
    """List every name that ``find`` knows, gbnbench's own first; nothing is imported."""
    from gbnbench.generators.third_parties.discovery import third_party_names

    return list(dict.fromkeys([*GENERATORS, *third_party_names()]))


def find(text: str, **settings: object) -> Generator:
    """Return the generator that a text such as ``gbn[sigma=0.8]`` describes.

    Parameters
    ----------
    text : str
        A name of ``GENERATORS`` or of a generator from elsewhere, with settings in brackets where they are
        not the defaults.
    **settings
        More settings, as values or text.

    Returns
    -------
    Generator

    Raises
    ------
    InputError
        If the text is malformed, the name or a setting unknown, a value wrong, a setting given twice, or the
        generator one from elsewhere that cannot be used.

    Examples
    --------
    >>> find("lloyd[iterations=50]", tolerance=0)
    Lloyd(iterations=50, tolerance=0.0, method='auto')
    """
    name, inside = parse(text)
    kind = kind_named(name)
    if kind is None:
        names = generator_names()
        raise InputError(
            f"no generator is named {name!r}{nearest(name, names)}; there are {', '.join(names)}"
        )
    twice = sorted(inside.keys() & settings.keys())
    if twice:
        raise InputError(f"a setting must come once; got {twice[0]!r} in {text!r} and as an argument")
    with faults_in_words(kind, "making it"):
        return configure(kind, {**inside, **settings})


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
        A generator, with or without settings in brackets: ``"gbn[sigma=0.8]"``, as ``gbnbench generators``
        lists them; or an instance of one of your own, whose sets are seeded in the same way.
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
    seed, realizations = whole_number("seed", seed, 0), whole_number("realizations", realizations, 1)
    n, d = whole_number("n", n, 1), whole_number("d", d, 1)
    if reason := too_large(8.0 * realizations * n * d):
        raise RefusalError(f"{realizations} sets of n={n} points in d={d} {reason}; draw fewer at a time")
    if reason := refusal_of(generator, n, d):
        raise RefusalError(reason)
    rngs = [realization_rng(seed, k) for k in range(realizations)]
    with use_device(device), faults_in_words(type(generator), f"drawing n={n}, d={d}"):
        sets = _draw(generator, n, d, rngs, monitor or Monitor())
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
