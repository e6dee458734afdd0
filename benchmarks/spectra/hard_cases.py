"""Point sets that bring out the errors of a periodogram, each with the true spectrum.

Truth is a closed form where there is one, else ``reference.py``; for a shifted or permuted set it is that of
the set before, so that the law is tested and not only the sum.
"""

from __future__ import annotations

import math
import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from gbnbench.benchmarks.spectra.reference import LongArray, reference_amplitudes, reference_roots
from gbnbench.core.torus import FloatArray
from gbnbench.io.points import load

Frequencies = NDArray[np.int64]
Points = Callable[[], FloatArray]

FAR = 2**20
GRID = 2**53
SHALLOW = 1e-25  # a true power near the least that double resolves
N, ODD, MANY, MOST = (
    256,
    225,
    4099,
    1_000_000,
)  # points of most cases, of those of an odd lattice, of the large


@dataclass(frozen=True)
class HardCase:
    """A point set, where to look, and what is to be seen there.

    Attributes
    ----------
    name : str
        What is hard about it.
    n, d, reach : int
        Points, dimension, largest |f_a|.
    build : callable
        Makes the (n, d) points, always the same.
    truth : callable
        (points, frequencies) -> square root of the true power.
    cube : bool
        Whether the whole cube of frequencies is evaluated too, or only those listed.
    probes : int
        Random frequencies looked at, besides the corners and axes of the cube.
    also : tuple of tuple of int
        Further frequencies.
    ceiling : callable or None
        frequencies -> what the square root of power cannot exceed, inf where nothing is known.
    scattered : bool
        Whether the typical error is meant for such points.
    """

    name: str
    n: int
    d: int
    reach: int
    build: Points
    truth: Callable[[FloatArray, Frequencies], LongArray] = reference_roots
    cube: bool = True
    probes: int = 48
    also: tuple[tuple[int, ...], ...] = ()
    ceiling: Callable[[Frequencies], FloatArray] | None = None
    scattered: bool = False

    def frequencies(self) -> Frequencies:
        """(m, d) distinct frequencies at which errors are taken."""
        rng = np.random.default_rng([self.n, self.d, self.reach])
        near = min(3, self.reach)
        rows = [
            rng.integers(-self.reach, self.reach + 1, (self.probes, self.d)),
            rng.integers(-near, near + 1, (self.probes // 4, self.d)),
        ]
        if self.probes > 10:
            rows.append(np.array([[self.reach] * self.d, [-self.reach] * self.d]))
            rows.append(np.eye(self.d, dtype=np.int64)[[0, -1]] * self.reach)
        rows.append(np.array(self.also, np.int64).reshape(-1, self.d))
        return np.unique(np.concatenate(rows), axis=0)


def hard_cases(quick: bool = False) -> tuple[HardCase, ...]:
    """Every case; the quick ones leave out a million points.

    Each size has a twin in which all points coincide: there rounding errors add up, which is a worst
    case. At far frequencies that of the coordinates adds up where half of the points lie elsewhere.
    """
    cases = [*_lattices(), *_scattered(), *_borders(), *_laws()]
    if not quick:
        cases.append(replace(_random("a million points", MOST, 2, 20), probes=6))
        cases.append(replace(_random("a million points, |f| to 2^20", MOST, 2, FAR, cube=False), probes=4))
    shapes = sorted({(case.n, case.d, case.reach, case.cube) for case in cases if case.n > 1})
    coincident = [_coincident(*shape) for shape in shapes]
    parted = [_parted(n, d, reach) for n, d, reach, _ in shapes if reach == FAR]
    return (*cases, *coincident, *parted)


# Lattices ----------------------------------------------------------------------------------------------


def lattice(m: int, d: int) -> FloatArray:
    """Return the regular grid of m**d points k/m, rounded where m is no power of two.

    Parameters
    ----------
    m, d : int
        Points on each axis, and dimension.

    Returns
    -------
    (m**d, d) float64
    """
    axes = np.meshgrid(*[np.arange(m) / m] * d, indexing="ij")
    return np.stack(axes, axis=-1).reshape(-1, d)


def _lattices() -> list[HardCase]:
    dyadic = [_dyadic(m, d, reach) for m, d, reach in ((256, 1, 600), (16, 2, 40), (4, 4, 5), (2, 8, 2))]
    return [*dyadic, _uneven(15**2, 1, 600), _uneven(15, 2, 40), _displaced()]


def _dyadic(m: int, d: int, reach: int) -> HardCase:
    """Take a lattice whose coordinates are exact: sqrt(n) on the harmonics, 0 off them."""

    def truth(x: FloatArray, f: Frequencies) -> LongArray:
        return _comb(x, f, m)

    also = ((m,) * d, (m,) + (0,) * (d - 1))
    name = f"dyadic lattice {m}^{d}"
    return HardCase(name, m**d, d, reach, lambda: lattice(m, d), truth, probes=800, also=also)


def _uneven(m: int, d: int, reach: int) -> HardCase:
    """Take a lattice whose coordinates are rounded: its power off the harmonics is small, not 0."""
    n = m**d

    def ceiling(f: Frequencies) -> FloatArray:
        return _rounded(f, m, n)

    name = f"rounded lattice {m}^{d}"
    return HardCase(name, n, d, reach, lambda: lattice(m, d), probes=100, also=((m,) * d,), ceiling=ceiling)


def _comb(x: FloatArray, f: Frequencies, m: int) -> LongArray:
    """sqrt(n) on the harmonics of an exact lattice, 0 off them."""
    return np.where((f % m == 0).all(axis=1), np.sqrt(np.longdouble(len(x))), np.longdouble(0))


def _rounded(f: Frequencies, m: int, n: int) -> FloatArray:
    """Root of n (2 pi |f| 2^-54)^2 off the harmonics: coordinates are within 2^-54 of the lattice's."""
    length = np.sqrt((f.astype(float) ** 2).sum(axis=1))
    return np.where((f % m == 0).all(axis=1), np.inf, math.sqrt(n) * 2 * math.pi * length * 2.0**-54)


def _displaced() -> HardCase:
    """Move a dyadic lattice's first point along axis 0 by so little that P is 1e-25 at f_0 = 1.

    Off the harmonics F = exp(-2 pi i f_0 step) - 1, whence P = 4 sin(pi f_0 step)^2 / n.
    """
    m, d = 16, 2
    step = np.ldexp(np.rint(np.ldexp(math.asin(math.sqrt(SHALLOW * N) / 2) / math.pi, 64)), -64)

    def build() -> FloatArray:
        x = lattice(m, d)
        x[0, 0] = step
        return x

    def truth(x: FloatArray, f: Frequencies) -> LongArray:
        moved = 2 * np.abs(np.sin(np.pi * f[:, 0] * np.longdouble(step))) / np.sqrt(np.longdouble(len(x)))
        return np.where((f % m == 0).all(axis=1), reference_roots(x, f), moved)

    return HardCase(
        f"true power {SHALLOW:g}", N, d, 5, build, truth, probes=100, also=((1, 0), (-1, 0), (1, 3), (1, -5))
    )


# Scattered points --------------------------------------------------------------------------------------


def _draw(n: int, d: int) -> FloatArray:
    """Random points on the 2^-53 grid."""
    return _placed(_grid(n, d))


def _grid(n: int, d: int) -> Frequencies:
    return np.random.default_rng([n, d]).integers(0, GRID, (n, d))


def _placed(whole: Frequencies) -> FloatArray:
    """Coordinates of whole numbers of 2^-53, mod 1; sums must be taken before, where they are exact."""
    return (whole % GRID) / float(GRID)


def _random(name: str, n: int, d: int, reach: int, cube: bool = True) -> HardCase:
    return HardCase(name, n, d, reach, lambda: _draw(n, d), cube=cube, scattered=True)


def _scattered() -> list[HardCase]:
    return [
        _random("random, d = 1", N, 1, 600),
        _random("random, d = 2", N, 2, 40),
        _random("random, d = 12", N, 12, 1),
        _random("|f| to 2^20, d = 1", N, 1, FAR, cube=False),
        _random("|f| to 2^20, d = 2", N, 2, FAR, cube=False),
        _random("beyond one chunk", MANY, 3, 8),
    ]


def _worst_probes(n: int) -> int:
    """Frequencies among which a worst case is met; fewer where each takes long."""
    return 200 if n <= MANY else 8


def _coincident(n: int, d: int, reach: int, cube: bool) -> HardCase:
    """All points at one place: every term errs alike."""

    def build() -> FloatArray:
        return np.tile(np.random.default_rng([n, d, 1]).random(d), (n, 1))

    return HardCase(
        "all points coincident", n, d, reach, build,
        truth=lambda x, f: np.full(len(f), np.sqrt(np.longdouble(len(x)))), cube=cube,
        probes=_worst_probes(n),
    )  # fmt: skip


def _parted(n: int, d: int, reach: int) -> HardCase:
    """Half of the points at 0, half at one place as far as can be from whole numbers of 2^-32.

    In float all of the latter move alike, and not the former.
    """
    place = np.random.default_rng([n, d, 2]).integers(0, 2**32, d) / 2.0**32 + 0.499 * 2.0**-32
    share = np.array([n - n // 2, n // 2])

    def truth(_: FloatArray, f: Frequencies) -> LongArray:
        two = np.stack([np.zeros(d), place])
        roots: LongArray = reference_amplitudes(two, f, share) / np.sqrt(np.longdouble(n))
        return roots

    def build() -> FloatArray:
        return np.repeat(np.stack([np.zeros(d), place]), share, axis=0)

    return HardCase(
        "half coincident at 0, half elsewhere", n, d, reach, build, truth, cube=False, probes=_worst_probes(n)
    )


# Borders of the number line ----------------------------------------------------------------------------


def _borders() -> list[HardCase]:
    def ends() -> FloatArray:
        return np.random.default_rng(3).choice([0.0, 1 - 2.0**-53], (N, 2))

    def denormal() -> FloatArray:
        rng = np.random.default_rng(4)
        x = np.ldexp(rng.random((N, 2)), rng.integers(-1074, -40, (N, 2)))
        x[:4] = [[5e-324, 0.0], [2.2e-308, 5e-324], [0.5, 1e-310], [2.0**-64, 2.0**-65]]
        x[4:64, 0] += 0.25  # else the sums are coherent, which is another case
        return x

    def one() -> FloatArray:
        return np.random.default_rng(30).random((1, 2))  # of 40 places the one with the largest errors

    return [
        HardCase("points at 0 and 1 - 2^-53", N, 2, 40, ends),
        HardCase("points at 0 and 1 - 2^-53, |f| to 2^20", N, 2, FAR, ends, cube=False),
        HardCase("denormal coordinates", N, 2, 40, denormal),
        HardCase("denormal coordinates, |f| to 2^20", N, 2, FAR, denormal, cube=False),
        HardCase("one point", 1, 2, 64, one, lambda _, f: np.ones(len(f), np.longdouble), probes=2000),
        HardCase("float32 file", N, 2, 40, _from_file, scattered=True),
    ]


def _from_file() -> FloatArray:
    """Points that went through a file of float32 (PSA's .rps)."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "points.rps"
        np.random.default_rng(5).random((N, 2), dtype=np.float32).astype("<f4").tofile(path)
        loaded = load(path)
    return np.asarray(loaded, dtype=np.float64)


# Laws --------------------------------------------------------------------------------------------------


def _laws() -> list[HardCase]:
    first = _grid(N, 2)
    shift = np.random.default_rng(6).integers(1, GRID, 2)
    half = _grid(N // 2, 3)

    def of_the_first(_: FloatArray, f: Frequencies) -> LongArray:
        return reference_roots(_placed(first), f)

    def without_odd(x: FloatArray, f: Frequencies) -> LongArray:
        return np.where(f.sum(axis=1) % 2 == 1, np.longdouble(0), reference_roots(x, f))

    sets: dict[str, Points] = {
        "shifted on the torus": lambda: _placed(first + shift),
        "permuted": lambda: np.random.default_rng(7).permutation(_placed(first)),
    }
    return [
        *[HardCase(name, N, 2, 40, build, of_the_first, scattered=True) for name, build in sets.items()],
        HardCase(
            "heavy cancellation",
            N,
            3,
            9,
            lambda: _placed(np.concatenate([half, half + GRID // 2])),
            without_odd,
        ),
    ]
