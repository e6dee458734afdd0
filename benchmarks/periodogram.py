"""Speed against error of the exact periodogram, beside numpy's separable product and FINUFFT."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial

import numpy as np
from machine import cpu_seconds, write

from gbnbench.analysis.periodogram import periodogram
from gbnbench.torus import FloatArray

CASES = ((1024, 2, 64, 1), (1024, 2, 64, 16), (4096, 2, 128, 1), (4096, 3, 16, 1), (4096, 8, 1, 1))
PROBES = 200  # frequencies at which the error is taken


def separable(x: FloatArray, fmax: int) -> FloatArray:
    """Tabulate complex exponentials for two groups of dimensions in numpy, and take one complex product."""
    f = np.arange(-fmax, fmax + 1)
    tables = []
    for group in (x[:, : x.shape[1] // 2], x[:, x.shape[1] // 2 :]):
        table = np.ones((len(x), 1), complex)
        for coordinate in group.T:
            axis = np.exp(-2j * np.pi * coordinate[:, None] * f)
            table = (table[:, :, None] * axis[:, None]).reshape(len(x), -1)
        tables.append(table)
    return (np.abs(tables[0].T @ tables[1]) ** 2 / len(x)).reshape((2 * fmax + 1,) * x.shape[1])


def finufft(x: FloatArray, fmax: int, tolerance: float) -> FloatArray:
    """FINUFFT's type 1, one thread, one call a set."""
    from finufft import nufft2d1, nufft3d1

    transform = {2: nufft2d1, 3: nufft3d1}[x.shape[1]]
    modes = (2 * fmax + 1,) * x.shape[1]
    ones = np.ones(len(x), complex)
    turns = [np.ascontiguousarray(2 * np.pi * coordinate) for coordinate in x.T]
    amplitude = transform(*turns, ones, modes, eps=tolerance, isign=-1, nthreads=1)
    return np.abs(amplitude) ** 2 / len(x)


def methods(d: int) -> Iterator[tuple[str, Callable[[FloatArray, int], FloatArray]]]:
    """Every rival that can do d dimensions here."""
    for precision in ("double", "float"):
        yield f"gbnbench {precision}", lambda x, f, p=precision: periodogram(x, f, p).power
    yield "numpy separable", separable
    try:
        import finufft as _  # noqa: F401 - only whether it is there
    except ImportError:
        return
    if d in (2, 3):
        for tolerance in (1e-12, 1e-6):
            yield f"FINUFFT {tolerance:g}", partial(finufft, tolerance=tolerance)


def true_amplitudes(x: FloatArray, f: np.ndarray) -> np.ndarray:
    """|F(f)| by integer phases on the 2^-53 grid and long double cosines."""
    turns = np.array([[int(c * 2.0**53) for c in row] for row in x], dtype=object)
    phase = (f.astype(object) @ turns.T) % 2**53
    angle = phase.astype(np.longdouble) / np.longdouble(2**53) * (8 * np.arctan(np.longdouble(1)))
    return np.hypot(np.cos(angle).sum(axis=1), np.sin(angle).sum(axis=1)).astype(float)


def rows() -> Iterator[tuple[object, ...]]:
    """One row a case and method."""
    rng = np.random.default_rng(0)
    for n, d, fmax, sets in CASES:
        x = np.floor(rng.random((sets, n, d)) * 2.0**53) / 2.0**53
        f = rng.integers(-fmax, fmax + 1, (PROBES, d))
        truth = true_amplitudes(x[0], f)
        ours = None
        for name, method in methods(d):
            seconds = cpu_seconds(lambda m=method, x=x, fmax=fmax: [m(one, fmax) for one in x])
            ours = ours or seconds
            power = method(x[0], fmax)[tuple((f + fmax).T)]
            error = np.sqrt(np.mean((np.sqrt(power * n) - truth) ** 2) / n)
            yield n, d, fmax, sets, name, 1e3 * seconds, seconds / ours, float(error)


if __name__ == "__main__":
    columns = ("n", "d", "F", "sets", "method", "CPU ms", "over gbnbench double", "amplitude error")
    write("periodogram", columns, rows())
