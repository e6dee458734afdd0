"""CPU seconds of one set of every generator in 2D, one thread: the costs that ``gbnbench generators`` lists.

python -m gbnbench.benchmarks.experiments.generator_costs           all, to generators/measured_costs.csv
python -m gbnbench.benchmarks.experiments.generator_costs fpo gbn   these alone; the others stay

All are measured in one worker process whose libraries have one thread.
"""

from __future__ import annotations

import sys
from importlib.resources import files
from pathlib import Path

from gbnbench.benchmarks.experiments.generator_cost import measure, served_size
from gbnbench.benchmarks.timing.machine import processor
from gbnbench.core.atomic_write import write_whole
from gbnbench.core.errors import GbnbenchError
from gbnbench.core.settings import nearest
from gbnbench.execution.calls import Calls
from gbnbench.execution.worker_pool import Pool
from gbnbench.generators.listing import COSTS, MeasuredCost, cost_machine, measured_costs
from gbnbench.generators.registry import GENERATORS


def main(names: list[str]) -> None:
    """Measure all generators, or those named, and rewrite the package's file."""
    if unknown := [name for name in names if name not in GENERATORS]:
        raise SystemExit(f"no generator is named {unknown[0]!r}{nearest(unknown[0], GENERATORS)}")
    machine = f"{processor()}, one thread"
    if names and machine != cost_machine():
        raise SystemExit(f"the others were measured on another machine, {cost_machine()}: measure all anew")
    costs = measured_costs() if names else {}
    with Pool(1) as pool:
        calls = Calls(pool)
        for name in names or GENERATORS:
            n = served_size(name)
            if n is None:
                continue
            calls.submit(name, measure, name, n)
            done = calls.next()
            if done.failure:
                raise GbnbenchError(f"{name} could not be measured: {done.failure}")
            costs[name] = MeasuredCost(float(done.value), n)
            print(f"{name:>16}  n={n}  {costs[name].cpu_seconds:.3g} s", flush=True)
    rows = [f"{name},{costs[name].n},2,{costs[name].cpu_seconds:.3g}" for name in GENERATORS if name in costs]
    text = "\n".join([f"# {machine}", "name,n,d,cpu_seconds", *rows, ""])
    write_whole(Path(str(files("gbnbench.generators"))) / COSTS, text.encode())


if __name__ == "__main__":
    main(sys.argv[1:])
