"""Where a benchmark ran, and the CPU time of a call."""

from __future__ import annotations

import csv
import os
import platform
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

from gbnbench.opencl import runtime

RESULTS = Path(__file__).parent / "results"
REPEATS = 3


def cpu_seconds(call: Callable[[], object]) -> float:
    """Smallest CPU time, over all threads, of three calls after one that warms up."""
    call()
    times = []
    for _ in range(REPEATS):
        began = time.process_time()
        call()
        times.append(time.process_time() - began)
    return min(times)


def processor() -> str:
    """Model name of the processor, as the system tells it."""
    try:
        lines = Path("/proc/cpuinfo").read_text().splitlines()
        return next(line.partition(":")[2].strip() for line in lines if line.startswith("model name"))
    except (OSError, StopIteration):
        return platform.processor() or platform.machine()


def write(name: str, columns: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
    """Write results/<name>.csv with the machine in comment lines, and print the same."""
    RESULTS.mkdir(exist_ok=True)
    with (RESULTS / f"{name}.csv").open("w", newline="") as file:
        file.write(f"# {processor()}, {os.cpu_count()} cores; Python {platform.python_version()}\n")
        file.write(f"# {runtime().device.label}\n")
        table = csv.writer(file, lineterminator="\n")
        table.writerow(columns)
        print("  ".join(f"{column:>22}" for column in columns))
        for row in rows:
            cells = [f"{cell:.3g}" if isinstance(cell, float) else str(cell) for cell in row]
            print("  ".join(f"{cell:>22}" for cell in cells), flush=True)
            table.writerow(cells)
