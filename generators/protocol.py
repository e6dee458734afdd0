"""The protocol of generators: a frozen dataclass of settings that draws one realization when called."""

from __future__ import annotations

from typing import ClassVar, Literal, Protocol, get_args, runtime_checkable

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, check_points

Family = Literal["direct", "lattice", "low-discrepancy", "cellular", "kernel-based", "spectral"]
MOST_ITERATIONS = 1_000_000  # that settings take: hours, where more would be a slip
FAMILIES: tuple[Family, ...] = get_args(Family)


@runtime_checkable
class Generator(Protocol):
    """A generator of point sets on the unit torus.

    Attributes
    ----------
    name : str
        What the command calls it.
    summary : str
        One line for lists, with the source.
    """

    name: ClassVar[str]
    summary: ClassVar[str]

    def refusal(self, n: int, d: int) -> str | None:
        """Say why n points in d dimensions cannot be made, and which numbers near by can.

        Parameters
        ----------
        n, d : int
            Points and dimension, >= 1.

        Returns
        -------
        str or None
            The reason; None where the set can be made.
        """
        ...

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization.

        Parameters
        ----------
        n, d : int
            Points and dimension.
        rng : numpy.random.Generator
            The stream that it is drawn from; the same state gives the same set.

        Returns
        -------
        (n, d) float64
            In [0, 1).
        """
        ...


@runtime_checkable
class ListedGenerator(Generator, Protocol):
    """A generator with what lists say of it; those of gbnbench are all of this kind.

    Attributes
    ----------
    family : str
        The kind of method: points drawn one by one or cell by cell (direct), a lattice, a net or sequence of
        low discrepancy, cells of equal size or optimal transport (cellular), energies of pairs
        (kernel-based), or a spectrum that is aimed at (spectral).
    dimensions : (int, int or None)
        Least and largest d that it serves; None where there is no end.
    toroidal : bool
        Whether opposite sides of the unit cube meet by its design.
    reference : str
        The publication that it follows; empty where there is none to name.
    """

    family: ClassVar[Family]
    dimensions: ClassVar[tuple[int, int | None]]
    toroidal: ClassVar[bool]
    reference: ClassVar[str]


def realization_rng(seed: int, k: int) -> np.random.Generator:
    """Return the random stream of a realization, the same however many realizations are drawn.

    Parameters
    ----------
    seed : int
        >= 0.
    k : int
        The realization, from 0.

    Returns
    -------
    numpy.random.Generator
        Of the k-th child of ``SeedSequence(seed)``.
    """
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(k,)))


def checked_draw(generator: Generator, x: FloatArray, n: int, d: int) -> FloatArray:
    """Check that a generator drew a set of n points of the torus.

    Parameters
    ----------
    generator : Generator
        For the message.
    x : array_like
        What it drew.
    n, d : int
        Points and dimension.

    Returns
    -------
    (n, d) float64
        The points.

    Raises
    ------
    InputError
        If x has another shape, is not finite, or leaves [0, 1).
    """
    try:
        points = check_points(x)
    except InputError as error:
        raise InputError(f"{generator.name} drew no point set: {error}") from None
    if points.shape != (n, d):
        raise InputError(f"{generator.name} drew an array of shape {points.shape} for n={n}, d={d}")
    return points
