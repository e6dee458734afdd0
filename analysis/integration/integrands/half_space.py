"""Half-space steps: 1 on one side of a plane through the unit box (Ahmed, Ren & Wonka 2022, Section 5.2)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.integration.integrands.limits import beyond_dimensions
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import FloatArray

RATIONAL = 12  # dimensions up to which all corners are summed in whole numbers
SERIES = 1 << 16  # terms of a Fourier series at most
TAIL = 1e-15  # of what it leaves out


@dataclass(frozen=True)
class HalfSpaces:
    """Steps across planes by a uniform point of the box and a uniform direction; not periodic."""

    name: ClassVar[str] = "half-space"
    summary: ClassVar[str] = "step by a random point and direction (Ahmed, Ren & Wonka 2022, Section 5.2)"
    periodic: ClassVar[bool] = False

    def refusal(self, d: int) -> str | None:
        """Return the reason why there are no such integrands in d dimensions, or None."""
        return beyond_dimensions("half spaces", d)

    def draw(self, d: int, rng: np.random.Generator) -> HalfSpace:
        """Draw a plane by a uniform point and a uniform direction.

        Parameters, returns and errors are those of ``Family.draw``.
        """
        if reason := self.refusal(d):
            raise RefusalError(reason)
        return HalfSpace(rng.random(d), rng.standard_normal(d))

    def frequencies(self, d: int, share: float, most: int = 0) -> NDArray[np.int64]:  # noqa: ARG002
        """Return an empty list: these functions are not periodic.

        Parameters are those of ``Family.frequencies``; share and most have no effect.
        """
        return np.empty((0, d), dtype=np.int64)


@dataclass(frozen=True, eq=False)
class HalfSpace:
    """1 where normal . (x - point) >= 0, else 0.

    Attributes
    ----------
    point, normal : (d,) float64
        A point of the plane, and its normal of any length but 0.
    """

    point: FloatArray
    normal: FloatArray

    def __post_init__(self) -> None:
        if not (np.isfinite(self.normal).all() and np.isfinite(self.point).all() and self.normal.any()):
            raise InputError(f"a plane needs a finite point and a normal that is not 0; got {self.normal}")

    def __call__(self, x: FloatArray) -> FloatArray:
        """Values: (..., d) -> (...). Points within a rounding of the plane may fall on either side."""
        across = np.zeros(x.shape[:-1])
        for axis, (p, n) in enumerate(zip(self.point, self.normal, strict=True)):
            across += (x[..., axis] - p) * n
        values: FloatArray = (across >= 0).astype(np.float64)
        return values

    @property
    def integral(self) -> float:
        """Volume of the box beyond the plane, computed once."""
        return self._volume

    @cached_property
    def _volume(self) -> float:
        """Volume of the box beyond the plane.

        Notes
        -----
        By reflections all sides g_a = |normal_a| are positive, and the volume before the plane is
        P(sum of g_a U_a <= reach), U_a uniform. Inclusion and exclusion over the corners (Barrow & Smith
        1979) cancels: in doubles by 1e-16 over the product of the sides. Up to 12 dimensions it is summed in
        whole numbers, which doubles are over a power of two, and divided once: exact but for that. Beyond,
        Fourier series, whose error is proven (``by_series``); where its tail falls too slowly, which takes
        many sides near 0, whole numbers again.
        """
        d = len(self.normal)
        volume = self.by_series() if d > RATIONAL else None
        return self.by_corners() if volume is None else volume

    def by_corners(self) -> float:
        """``integral`` by inclusion and exclusion in whole numbers: 2^d terms, rounded once."""
        sides, unit = _whole(np.abs(self.normal[self.normal != 0]))
        points, fraction = _whole(self.point)
        normals, _ = _whole(self.normal, unit)
        # Both in units of 1 / (unit fraction); measured from the corner where normal . x is least.
        least = sum(min(normal, 0) for normal in normals) * fraction
        reach = sum(n * p for n, p in zip(normals, points, strict=True)) - least
        sides = [side * fraction for side in sides]
        d = len(sides)
        # What is left of the reach beyond the corners of either sign, where anything is.
        even: list[int] = [reach] if reach > 0 else []
        odd: list[int] = []
        for side in sides:
            even, odd = (
                even + [rest - side for rest in odd if rest > side],
                odd + [rest - side for rest in even if rest > side],
            )
        before = sum(rest**d for rest in even) - sum(rest**d for rest in odd)
        whole = math.factorial(d) * math.prod(sides)
        return float((whole - before) / whole)  # of whole numbers: rounded correctly

    def by_series(self) -> float | None:
        """``integral`` by the Fourier series of the sum's density, None where it is too long.

        Notes
        -----
        About its mean the sum S of g_a U_a is symmetric with characteristic function prod sinc, and lies
        within a period T = sum of g_a: P(S - T/2 <= y) = 1/2 + y/T + sum over m >= 1 of
        prod_a sinc(m g_a / T) sin(2 pi m y / T) / (pi m), sinc x = sin(pi x) / (pi x). From |sinc x| <=
        1 / (pi x) of the J largest sides, the terms beyond M add up to at most
        prod_J (T / (pi g_a M)) / (pi J). Each factor rounds by about 1e-16, and so does the sum.
        """
        sides = np.sort(np.abs(self.normal))[::-1]
        period = float(sides.sum())
        spread = np.cumsum(np.log(period / (math.pi * np.maximum(sides, 1e-300))))
        j = np.arange(1, len(sides) + 1)
        needed = float(np.exp(np.minimum((spread - np.log(TAIL * math.pi * j)) / j, 700)).min())
        if needed > SERIES:
            return None
        m = np.arange(1, math.ceil(needed) + 1)
        sinc = np.prod(np.sinc(np.multiply.outer(m, sides / period)), axis=1)
        y = math.fsum((self.normal * (0.5 - self.point)).tolist()) / period  # beyond the plane: -S <= -reach
        if abs(y) >= 0.5:  # the plane misses the box
            return float(y > 0)
        terms = sinc * np.sin(2 * math.pi * ((m * y) % 1.0)) / (math.pi * m)
        return min(max(math.fsum([0.5, y, *terms.tolist()]), 0.0), 1.0)


def _whole(values: FloatArray, unit: int = 1) -> tuple[list[int], int]:
    """Doubles as whole numbers over a common power of two, at least unit."""
    ratios = [float(value).as_integer_ratio() for value in values]
    unit = max(unit, *(q for _, q in ratios))
    return [p * (unit // q) for p, q in ratios], unit
