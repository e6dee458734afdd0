"""Point sets that bring out the errors of a periodogram, each with the true spectrum.

Truth is a closed form where there is one, else ``reference.py``; for a shifted or permuted set it is that of
the set before, so that the law is tested and not only the sum.
"""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

from gbnbench.benchmarks.spectra.hard_case import Frequencies, HardCase, Points
from gbnbench.benchmarks.spectra.hard_lattices import lattices
from gbnbench.benchmarks.spectra.reference import LongArray, reference_amplitudes, reference_roots
from gbnbench.core.torus import FloatArray
from gbnbench.io.points import load

FAR = 2**20
GRID = 2**53
N, MANY, MOST = 256, 4099, 1_000_000  # points of most cases, of those beyond one chunk, of the large


def hard_cases(quick: bool = False) -> tuple[HardCase, ...]:
    """Every case; the quick ones leave out a million points.

    Each size has a twin in which all points coincide: there rounding errors add up, which is a worst
    case. At far frequencies that of the coordinates adds up where half of the points lie elsewhere.
    """
    cases = [*lattices(), *_scattered(), *_borders(), *_laws()]
    if not quick:
        cases.append(replace(_random("a million points", MOST, 2, 20), probes=6))
        cases.append(replace(_random("a million points, |f| to 2^20", MOST, 2, FAR, cube=False), probes=4))
    shapes = sorted({(case.n, case.d, case.reach, case.cube) for case in cases if case.n > 1})
    coincident = [_coincident(*shape) for shape in shapes]
    parted = [_parted(n, d, reach) for n, d, reach, _ in shapes if reach == FAR]
    return (*cases, *coincident, *parted)


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
