"""CPU seconds a set of each generator, and the noise floor that they buy."""

from __future__ import annotations

import math
from collections.abc import Iterator

from machine import cpu_seconds, write

from gbnbench.analysis.periodogram import periodogram
from gbnbench.analysis.profile import noise_floor, power_at_1
from gbnbench.analysis.radial import radial
from gbnbench.generators.registry import GENERATORS, generate

CASES = ((1024, 2), (4096, 2), (1000, 3))


def rows() -> Iterator[tuple[object, ...]]:
    """One row a case and generator."""
    for n, d in CASES:
        for name, kind in GENERATORS.items():
            if kind().refusal(n, d) is not None:
                continue
            seconds = cpu_seconds(lambda g=name, n=n, d=d: generate(g, n=n, d=d))
            shells = radial(periodogram(generate(name, n=n, d=d), math.ceil(n ** (1 / d) / 4) + 1))
            yield n, d, name, seconds, noise_floor(shells), power_at_1(shells)


if __name__ == "__main__":
    write("generators", ("n", "d", "generator", "CPU s a set", "noise floor", "P(1)"), rows())
