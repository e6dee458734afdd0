"""Genz' six families of integrands on the unit box, not periodic, with their integrals (Genz 1984, 1987)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.integration.integrands.genz_kinds import KINDS, GenzIntegrand
from gbnbench.analysis.integration.integrands.limits import beyond_dimensions
from gbnbench.core.errors import InputError, RefusalError

# Sums of a by default, the same in every d: our choice, of the size customary for these families.
DIFFICULTY = {
    "oscillatory": 9.0,
    "product-peak": 7.25,
    "corner-peak": 1.85,
    "gaussian": 7.03,
    "continuous": 20.4,
    "discontinuous": 4.3,
}
# Sums of a within which no value, nor its square, leaves the range of doubles, d = 1 to 20.
RANGES = {
    "oscillatory": (1e-6, 1e6),
    "product-peak": (0.1, 1e6),
    "corner-peak": (1e-6, 1e6),
    "gaussian": (1e-6, 1e6),
    "continuous": (1e-6, 1e6),
    "discontinuous": (1e-6, 300.0),
}


@dataclass(frozen=True)
class Genz:
    """Integrands of one of Genz' kinds, with random a >= 0 of a given sum and random u.

    Attributes
    ----------
    kind : str
        oscillatory: cos(2 pi u_1 + sum a_i x_i);
        product-peak: prod 1 / (a_i^-2 + (x_i - u_i)^2);
        corner-peak: (1 + sum a_i x_i)^-(d + 1);
        gaussian: exp(-sum a_i^2 (x_i - u_i)^2);
        continuous: exp(-sum a_i |x_i - u_i|);
        discontinuous: exp(sum a_i x_i) where x_1 <= u_1 and x_2 <= u_2, else 0.
    difficulty : float or None
        Sum of the a_i, > 0; None for the kind's default: 9, 7.25, 1.85, 7.03, 20.4 and 4.3 in this order.

    References
    ----------
    Genz, "Testing multidimensional integration routines", 1984; "A package for testing multiple integration
    subroutines", 1987.
    """

    name: ClassVar[str] = "genz"
    summary: ClassVar[str] = "Genz' six test families on the box, kind=oscillatory and so on (Genz 1984)"
    periodic: ClassVar[bool] = False
    kind: Literal["oscillatory", "product-peak", "corner-peak", "gaussian", "continuous", "discontinuous"] = (
        "oscillatory"
    )
    difficulty: float | None = None

    def __post_init__(self) -> None:
        if self.kind not in DIFFICULTY:
            raise InputError(f"kind of genz must be one of {', '.join(DIFFICULTY)}; got {self.kind!r}")
        low, high = RANGES[self.kind]
        if self.difficulty is not None and not low <= self.difficulty <= high:
            raise InputError(
                f"difficulty of genz[kind={self.kind}] must be from {low:g} to {high:g}, where doubles hold "
                f"its values; got {self.difficulty}"
            )

    def refusal(self, d: int) -> str | None:
        """Return the reason why there are no such integrands in d dimensions, or None."""
        return beyond_dimensions("Genz' families", d)

    def draw(self, d: int, rng: np.random.Generator) -> GenzIntegrand:
        """Draw a and u, uniform before a is scaled to its sum.

        Parameters, returns and errors are those of ``Family.draw``.
        """
        if reason := self.refusal(d):
            raise RefusalError(reason)
        a = 1 - rng.random(d)  # never 0
        total = DIFFICULTY[self.kind] if self.difficulty is None else self.difficulty
        return KINDS[self.kind](a * (total / a.sum()), rng.random(d))

    def frequencies(self, d: int, share: float, most: int = 0) -> NDArray[np.int64]:  # noqa: ARG002
        """Return an empty list: these functions are not periodic.

        Parameters are those of ``Family.frequencies``; share and most have no effect.
        """
        return np.empty((0, d), dtype=np.int64)
