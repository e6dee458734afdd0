"""CPU seconds a set of each generator, and the noise floor that they buy.

python -m gbnbench.benchmarks.experiments.generators benchmarks/results/generators.csv
"""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from functools import partial
from pathlib import Path

from gbnbench.analysis.radial.profile_measures import noise_floor, power_at_1
from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.benchmarks.timing.interleaved import timed
from gbnbench.benchmarks.timing.machine import Rows, describe
from gbnbench.generators.registry import GENERATORS, generate

CASES = ((1024, 2), (4096, 2), (1000, 3))
REPEATS = 3
COLUMNS = ("n", "d", "generator", "CPU s a set", "noise floor", "P(1)")


def rows() -> Iterator[tuple[object, ...]]:
    """One row a case and generator."""
    for n, d in CASES:
        for name, kind in GENERATORS.items():
            if kind().refusal(n, d) is not None:
                continue
            x = generate(name, n=n, d=d)  # builds the kernels
            call = partial(generate, name, n=n, d=d)
            seconds = min(timed(call)[0] for _ in range(REPEATS))
            shells = radial(periodogram(x, math.ceil(n ** (1 / d) / 4) + 1))
            yield n, d, name, seconds, noise_floor(shells), power_at_1(shells)


def main(arguments: list[str]) -> None:
    """Print the table, and write it to the file named."""
    machine = describe()
    print(f"# {machine['processor']}, {machine['cores']} cores; {machine['device']}")
    print("  ".join(f"{column:>12}" for column in COLUMNS))
    with ExitStack() as stack:
        kept = [stack.enter_context(Rows(Path(path), COLUMNS)) for path in arguments[:1]]
        for row in rows():
            cells = [f"{cell:.3g}" if isinstance(cell, float) else str(cell) for cell in row]
            print("  ".join(f"{cell:>12}" for cell in cells), flush=True)
            for file in kept:
                file.add(dict(zip(COLUMNS, row, strict=True)))


if __name__ == "__main__":
    main(sys.argv[1:])
