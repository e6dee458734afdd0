"""Measurements of the cases: generated sets, the energy's field at fixed points, a lattice's spectrum."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from gbnbench.analysis.measure_definitions import DEFINITIONS
from gbnbench.analysis.measures import measures
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn import energy
from gbnbench.generators.registry import generate
from gbnbench.regression.cases import Case, Values

LISTED = 4  # points whose gradient a field's case lists
BITS = 24  # of a fixed point's coordinates, so that float holds them exactly
PERIODS = 3  # of a lattice's spectrum

NAMES: dict[str, tuple[str, ...]] = {
    "sets": tuple(definition.name for definition in DEFINITIONS),
    "field": ("excess", "gradient", "gradient_norm"),
    "lattice": ("off_harmonics", "on_harmonics"),
}


def observe(case: Case, seed: int) -> dict[str, Values]:
    """Measure a case with some seed.

    Parameters
    ----------
    case : Case
        What to measure.
    seed : int
        Instead of its own.

    Returns
    -------
    dict
        Value of every measure that the case names; nan where it is undefined.

    Raises
    ------
    GbnbenchError
        If it cannot be measured.
    """
    measured = KINDS[case.kind](case, seed)
    return {name: measured[name] for name in case.measures}


def fixed_points(n: int, d: int, seed: int) -> FloatArray:
    """Make points that are the same on every machine and exact in float.

    Parameters
    ----------
    n, d : int
        Points and dimension.
    seed : int
        Of the stream that they come from.

    Returns
    -------
    (n, d) float64
        Multiples of 2^-24.

    Notes
    -----
    The highest bits of splitmix64 (Steele, Lea & Flood 2014), whose stream `seed` starts at seed * 2^32.
    """
    step = np.uint64(0x9E3779B97F4A7C15)
    z = (np.uint64((seed << 32) % 2**64) + np.arange(1, n * d + 1, dtype=np.uint64)) * step
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    z = (z ^ (z >> np.uint64(31))) >> np.uint64(64 - BITS)
    return np.asarray(z.astype(np.float64) / 2.0**BITS).reshape(n, d)


def listed(gradient: FloatArray) -> FloatArray:
    """Take the gradient's components at points spread over the order: at most (4 * d,)."""
    chosen = np.unique(np.linspace(0, len(gradient) - 1, LISTED).astype(np.int64))
    return np.take(gradient, chosen, axis=0).ravel()


def lattice(n: int, d: int) -> tuple[FloatArray, int]:
    """Make a shifted lattice of n = m^d points, m being a power of two.

    Parameters
    ----------
    n, d : int
        Points and dimension.

    Returns
    -------
    x : (n, d) float64
        The lattice.
    m : int
        Points along an axis.

    Raises
    ------
    InputError
        If there is no such m.
    """
    m = round(n ** (1 / d))
    if m**d != n or m & (m - 1):
        raise InputError(f"a dyadic lattice has (2^k)^{d} points in {d} dimensions; got n={n}")
    return (np.indices((m,) * d).reshape(d, -1).T + 3 / 16) / m, m


def _sets(case: Case, seed: int) -> Mapping[str, Values]:
    x = generate(case.generator, case.n, case.d, seed, case.realizations)
    return {name: (value,) for name, value in measures(x).items()}


def _field(case: Case, seed: int) -> Mapping[str, Values]:
    x = fixed_points(case.n, case.d, seed)
    at = energy.energy_evaluation(case.n, case.d, case.sigma, case.precision)(x[None])
    return {
        "excess": (float(at.excess[0]),),
        "gradient": tuple(listed(at.gradient[0]).tolist()),
        "gradient_norm": (float(np.linalg.norm(at.gradient[0])),),
    }


def _lattice(case: Case, seed: int) -> Mapping[str, Values]:  # noqa: ARG001 - there is nothing random in it
    x, m = lattice(case.n, case.d)
    fmax = PERIODS * m
    power = periodogram(x, fmax, "double" if case.precision == "double" else "float").power
    on = (np.indices(power.shape) % m == fmax % m).all(axis=0)
    farthest = int(np.argmax(np.abs(power[on] - case.n)))
    return {"off_harmonics": (float(power[~on].max()),), "on_harmonics": (float(power[on][farthest]),)}


KINDS: dict[str, Callable[[Case, int], Mapping[str, Values]]] = {
    "sets": _sets,
    "field": _field,
    "lattice": _lattice,
}
