"""Protocols of an integrand with its exact integral, and of a random family of integrands."""

from __future__ import annotations

from typing import ClassVar, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray


class Integrand(Protocol):
    """One function on the unit box with its exact integral."""

    @property
    def integral(self) -> float:
        """Integral over the unit box, to 1e-12 of the function's own size or better; each family says how."""
        ...

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values at points of [0, 1)^d: (..., d) -> (...), to a few roundings of the function's size.

        Bitwise the same however points are batched.
        """
        ...


@runtime_checkable
class Periodic(Integrand, Protocol):
    """A function of the torus, whose Fourier series predicts the variance of its estimates."""

    def energy(self, frequencies: NDArray[np.int64]) -> FloatArray:
        """|integral of f(x) exp(-2 pi i f.x)|^2 at integer frequencies: (m, d) -> (m,).

        RefusalError where it is not known, as for a ball that meets its own images.
        """
        ...


class Family(Protocol):
    """Random integrands of one kind: a frozen dataclass of settings."""

    name: ClassVar[str]
    summary: ClassVar[str]  # one line with its source
    periodic: ClassVar[bool]  # whether its integrands are ``Periodic``

    def refusal(self, d: int) -> str | None:
        """Return the reason why there are no such integrands in d dimensions, or None."""
        ...

    def draw(self, d: int, rng: np.random.Generator) -> Integrand:
        """Draw one function.

        Parameters
        ----------
        d : int
            Dimension.
        rng : numpy.random.Generator
            Source of the random numbers.

        Returns
        -------
        Integrand
            Of d dimensions.

        Raises
        ------
        RefusalError
            If ``refusal(d)`` has a reason.
        """
        ...

    def frequencies(self, d: int, share: float, most: int = ...) -> NDArray[np.int64]:
        """List half the frequencies that matter: the others hold less than a share of the family's energy.

        Parameters
        ----------
        d : int
            Dimension.
        share : float
            Share of the mean energy summed over all f != 0 that may be left out, 0 < share < 1.
        most : int
            Longest list allowed; where more are needed the refusal costs little.

        Returns
        -------
        (m, d) int64
            One of each pair f, -f; never 0. Empty for a family that is not periodic.

        Raises
        ------
        RefusalError
            If they are too many to list, or the spectrum is not known in d dimensions.
        """
        ...
