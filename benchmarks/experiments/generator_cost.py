"""CPU seconds of one set of a generator, kernels being built and libraries loaded already."""

from __future__ import annotations

from functools import partial

from gbnbench.benchmarks.timing.interleaved import timed
from gbnbench.generators.registry import GENERATORS, generate

N = 1024
REPEATS = 3
LONG = 20.0  # seconds above which a set is drawn once; REPEATS of it take no longer


def served_size(name: str) -> int | None:
    """Return 1,024, or the nearest n that a generator serves in 2D; None where there is none near."""
    generator = GENERATORS[name]()
    sizes = sorted(range(N // 2, 2 * N), key=lambda n: abs(n - N))
    return next((n for n in sizes if generator.refusal(n, 2) is None), None)


def measure(name: str, n: int) -> float:
    """Return CPU seconds of a set.

    Parameters
    ----------
    name : str
        The generator.
    n : int
        Points in 2D.

    Returns
    -------
    float
        The least of three draws after a first, or of fewer where they take long.
    """
    call = partial(generate, name, n=n)
    first, _ = timed(call)
    if first > LONG:
        return first
    return min(timed(call)[0] for _ in range(REPEATS if first < LONG / REPEATS else 1))
