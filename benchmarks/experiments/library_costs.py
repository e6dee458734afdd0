"""CPU seconds of ready sets by generator, n and d, by which ``gbnbench library`` tells what the others cost.

python -m gbnbench.benchmarks.experiments.library_costs sets   rewrites the package's measured_costs.csv

The library is one that was made on this machine with eight sets a file, ``gbnbench library -o sets ...``;
what its manifest says of the cost of a set, and of measuring eight, is taken over.
"""

from __future__ import annotations

import statistics
import sys
from importlib.resources import files
from pathlib import Path

from gbnbench.benchmarks.timing.machine import processor
from gbnbench.core.atomic_write import write_whole
from gbnbench.io.library.manifest import Manifest
from gbnbench.io.library.places import manifest_of, open_place
from gbnbench.studies.library.costs import COSTS, MEASURED_SETS, MEASURING


def cost_rows(manifest: Manifest) -> list[str]:
    """Write the costs of a library as rows of name, d, n, CPU seconds."""
    measuring: dict[tuple[int, int], list[float]] = {}
    rows = []
    for entry in manifest.files:
        rows.append(f"{entry.generator},{entry.d},{entry.n},{entry.cpu_seconds:.3g}")
        if len(entry.realizations) == MEASURED_SETS:
            measuring.setdefault((entry.d, entry.n), []).append(entry.measuring_cpu_seconds)
    for (d, n), seconds in sorted(measuring.items()):
        rows.append(f"{MEASURING},{d},{n},{statistics.median(seconds):.3g}")
    return rows


def main(where: str) -> None:
    """Rewrite the package's file of costs."""
    with open_place(where) as place:
        rows = cost_rows(manifest_of(place))
    text = "\n".join([f"# {processor()}, one thread", "name,d,n,cpu_seconds", *rows, ""])
    path = Path(str(files("gbnbench.studies.library"))) / COSTS
    write_whole(path, text.encode())
    print(f"wrote {path}: {len(rows)} rows")


if __name__ == "__main__":
    main(sys.argv[1])
