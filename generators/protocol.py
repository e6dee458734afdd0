"""What every generator is: a frozen dataclass of its settings that draws one realization when called."""

from __future__ import annotations

from typing import ClassVar, Protocol, runtime_checkable

import numpy as np

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray, check_points


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
        """Why n points in d dimensions cannot be made, with the nearest that can; None where they can."""
        ...

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization: (n, d) float64 in [0, 1), the same for the same state of rng."""
        ...


def realization_rng(seed: int, k: int) -> np.random.Generator:
    """Random stream of realization k: the k-th child of SeedSequence(seed), whatever the count asked for."""
    return np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(k,)))


def checked_draw(generator: Generator, x: FloatArray, n: int, d: int) -> FloatArray:
    """Return what a generator drew as (n, d) float64 points of the torus, or say that it is none of that.

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
