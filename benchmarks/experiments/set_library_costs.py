"""CPU seconds of ready sets by generator, n and d, by which ``gbnbench library`` tells what others cost.

python -m gbnbench.benchmarks.experiments.set_library_costs a b ...  rewrites the package's measured_costs.csv

a, b, ... are libraries that were made on this machine, ``gbnbench library -o a ...``; what their manifests
say of the cost of a set, and of measuring those of a file, is taken over, the first that has a size.
"""

from __future__ import annotations

import statistics
import sys
from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path

from gbnbench.benchmarks.timing.machine import processor
from gbnbench.core.atomic_write import write_whole
from gbnbench.io.set_library.manifest import Manifest
from gbnbench.io.set_library.places import manifest_of, open_place
from gbnbench.studies.set_library.costs import COSTS, MEASURED_SETS, MEASURING


def cost_rows(manifests: Sequence[Manifest]) -> list[str]:
    """Write the costs of libraries as rows of name, d, n, CPU seconds."""
    measuring: dict[tuple[int, int], list[float]] = {}
    making: dict[tuple[str, int, int], float] = {}
    for entry in (entry for manifest in manifests for entry in manifest.files):
        making.setdefault((entry.generator, entry.d, entry.n), entry.cpu_seconds)
        eight = entry.measuring_cpu_seconds * MEASURED_SETS / len(entry.realizations)
        measuring.setdefault((entry.d, entry.n), []).append(eight)
    rows = [f"{name},{d},{n},{seconds:.3g}" for (name, d, n), seconds in sorted(making.items())]
    for (d, n), seconds in sorted(measuring.items()):
        rows.append(f"{MEASURING},{d},{n},{statistics.median(seconds):.3g}")
    return rows


def main(places: Sequence[str]) -> None:
    """Rewrite the package's file of costs."""
    manifests = []
    for where in places:
        with open_place(where) as place:
            manifests.append(manifest_of(place))
    rows = cost_rows(manifests)
    text = "\n".join([f"# {processor()}, one thread", "name,d,n,cpu_seconds", *rows, ""])
    path = Path(str(files("gbnbench.studies.set_library"))) / COSTS
    write_whole(path, text.encode())
    print(f"wrote {path}: {len(rows)} rows")


if __name__ == "__main__":
    main(sys.argv[1:])
