"""CPU seconds a set of each generator at several sizes, and the noise floor that they buy.

    python -m gbnbench.benchmarks.experiments.generators benchmarks/results/generators.csv [NAME...] [--again]

Goes on where the table ends. A set is drawn in a process of its own with one thread, after a small one that
builds the kernels, and is given up after LIMIT CPU seconds; of what is refused the row has the reason.
"""

from __future__ import annotations

import argparse
import csv
import io
import json
import math
import multiprocessing
import os
import resource
from collections.abc import Mapping, Sequence
from multiprocessing.connection import Connection
from pathlib import Path

from gbnbench.analysis.radial.profile_measures import noise_floor, power_at_1
from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.benchmarks.timing.interleaved import timed
from gbnbench.benchmarks.timing.machine import describe
from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import GbnbenchError, InputError
from gbnbench.core.settings import nearest
from gbnbench.core.torus import FloatArray
from gbnbench.execution.one_thread import ONE_THREAD
from gbnbench.generators.registry import GENERATORS, generate

CASES = ((1024, 2), (16_384, 2), (1000, 3))
LIMIT = 200  # CPU seconds of a set
REPEATS, SHORT = 3, 5.0  # timings of which the least counts, of sets that take fewer seconds than that
TIMED = 0.5  # seconds of one timing, of quick sets drawn again and again: Linux counts ticks under a limit
QUICK = 2e-4  # seconds that a set is taken to need at least, for that
SMALL = 256
COLUMNS = ("n", "d", "generator", "cpu_s", "noise_floor", "power_at_1", "remark")
Key = tuple[str, str, str]
Cells = dict[str, str]


def draw(name: str, n: int, d: int, answer: Connection) -> None:
    """Send the cells of a drawn set; the system ends a process beyond its time.

    Parameters
    ----------
    name : str
        The generator.
    n, d : int
        Points and dimension.
    answer : Connection
        Receives the cells that hold numbers.
    """
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT))
    small = min(n, SMALL)
    if GENERATORS[name]().refusal(small, d) is None:
        generate(name, n=small, d=d)
    sets: list[FloatArray] = []

    def one() -> None:
        sets[:] = [generate(name, n=n, d=d)]

    cpu, _ = timed(one)
    if cpu < SHORT:
        again, _ = timed(one)  # what depends on n alone, such as the choice of a lattice, is kept by now
        times = math.ceil(TIMED / max(again, QUICK))
        cpu = min(timed(one, times)[0] for _ in range(REPEATS))
    shells = radial(periodogram(sets[0], math.ceil(n ** (1 / d) / 4) + 1))
    values = {"cpu_s": cpu, "noise_floor": noise_floor(shells), "power_at_1": power_at_1(shells)}
    answer.send({column: f"{value:.3g}" for column, value in values.items()})


def measure(name: str, n: int, d: int) -> Cells:
    """Return the row of one generator at one size.

    Parameters
    ----------
    name : str
        The generator.
    n, d : int
        Points and dimension.

    Returns
    -------
    dict of str to str
        A cell a column; without numbers, but with a remark, where there is no set.

    Raises
    ------
    GbnbenchError
        If drawing ended otherwise than by a set or by the limit of time.
    """
    cells = dict.fromkeys(COLUMNS, "") | {"n": str(n), "d": str(d), "generator": name}
    if reason := GENERATORS[name]().refusal(n, d):
        return cells | {"remark": f"refused: {reason}"}
    here, there = multiprocessing.Pipe(duplex=False)
    child = multiprocessing.get_context("spawn").Process(target=draw, args=(name, n, d, there))
    child.start()
    there.close()
    try:
        cells |= here.recv()
    except EOFError:
        child.join()
        if child.exitcode is None or child.exitcode >= 0:
            raise GbnbenchError(f"{name} at n={n}, d={d} failed with exit code {child.exitcode}") from None
        cells["remark"] = f"over {LIMIT} s"
    child.join()
    return cells


def read(path: Path) -> dict[Key, Cells]:
    """Read the rows that there are, by n, d and generator."""
    if not path.exists():
        return {}
    with path.open(newline="", encoding="utf-8") as file:
        return {(row["n"], row["d"], row["generator"]): row for row in csv.DictReader(file)}


def write(path: Path, table: Mapping[Key, Cells]) -> None:
    """Write the table whole, in the order of cases and of the registry.

    Parameters
    ----------
    path : Path
        Of the table.
    table : mapping
        Rows by n, d and generator.
    """
    text = io.StringIO()
    writer: csv.DictWriter[str] = csv.DictWriter(text, COLUMNS, lineterminator="\n")
    writer.writeheader()
    keys = [(str(n), str(d), name) for n, d in CASES for name in GENERATORS]
    writer.writerows(table[key] for key in keys if key in table)
    write_whole(path, text.getvalue().encode())


def main(arguments: Sequence[str] | None = None) -> None:
    """Fill the table in the file named, and describe the machine beside it."""
    parser = argparse.ArgumentParser(
        prog="python -m gbnbench.benchmarks.experiments.generators", description=__doc__
    )
    parser.add_argument("out", type=Path, metavar="OUT.csv")
    parser.add_argument("names", nargs="*", metavar="NAME", help="generators; all where none is given")
    parser.add_argument("--again", action="store_true", help="measure what the table has already, too")
    given = parser.parse_args(arguments)
    if unknown := [name for name in given.names if name not in GENERATORS]:
        raise InputError(f"no generator is named {unknown[0]!r}{nearest(unknown[0], GENERATORS)}")
    os.environ.update(ONE_THREAD)  # before processes start
    machine = given.out.with_name(f"{given.out.stem}-machine.json")
    write_whole(machine, (json.dumps(describe(), indent=1) + "\n").encode())
    table = read(given.out)
    for n, d in CASES:
        for name in given.names or GENERATORS:
            key = (str(n), str(d), name)
            if given.again or key not in table:
                table[key] = measure(name, n, d)
                write(given.out, table)
                print(*(table[key][column] for column in COLUMNS), flush=True)


if __name__ == "__main__":
    main()
