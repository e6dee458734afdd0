"""The energy's gradient: CPU time, pairs a second and their share of what the instruction count allows.

    python -m gbnbench.benchmarks.experiments.gradient_rate [FOLDER]

On one core. Each evaluation's instructions are those of its inner loop, counted by hand in
generators/gbn/operation_counts.py; the peak is that of multiply-adds, measured in the same process before
and after each case. A share of 1 would mean that nothing but these instructions takes time, launches and the
way to the device and back included.
"""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from gbnbench.benchmarks.timing.interleaved import Timing, interleave
from gbnbench.benchmarks.timing.machine import Rows, describe
from gbnbench.core.atomic_write import write_whole
from gbnbench.execution.one_thread import ONE_THREAD
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.energy_cost import EnergyCost
from gbnbench.generators.gbn.plan import plan_energy
from gbnbench.opencl.peak_rate import fma_peak

COLUMNS = (
    "n", "d", "sigma", "sets", "precision", "method", "detail", "chosen", "rounds", "cpu_ms", "cpu_ms_median",
    "bar_ms", "work_a_second", "instructions", "peak", "share", "double_over_float",
)  # fmt: skip
RESULTS = Path(__file__).parent / "results" / "field"
SECONDS = 3.0  # a case, beyond three rounds
DEAREST = 20.0  # times the cheapest evaluation's effort above which another is left out
LONGEST = 4.0  # expected seconds of a gradient above which a case is left out


@dataclass(frozen=True)
class GradientCase:
    """One size.

    Attributes
    ----------
    n, d, sets : int
        Points, dimensions, sets a call.
    sigma : float
        In spacings.
    bar : float
        CPU milliseconds a gradient in double that it must stay under; nan where none is set.
    """

    n: int
    d: int
    sigma: float = 1.0
    sets: int = 1
    bar: float = float("nan")


CASES = (
    GradientCase(1024, 2, bar=1.5),
    GradientCase(100_000, 2, bar=120),
    GradientCase(1_000_000, 2, bar=1200),
    GradientCase(100_000, 3, bar=2200),
    GradientCase(1024, 8, bar=8),
    GradientCase(64, 2),
    GradientCase(64, 2, sets=32),
    GradientCase(300, 2),
    GradientCase(1024, 2, sigma=3.0),
    GradientCase(4096, 3),
    GradientCase(1000, 4, sigma=0.3),
    GradientCase(4096, 8),
    GradientCase(256, 20),
)


def candidates(case: GradientCase, precision: str) -> list[EnergyCost]:
    """List the evaluations that are worth timing, the plan's own first.

    Parameters
    ----------
    case : GradientCase
        n, d and sigma.
    precision : str
        "double" or "float".

    Returns
    -------
    list of EnergyCost
    """
    found = plan_energy(case.n, case.d, case.sigma, precision, sets=case.sets)
    if found.seconds() > LONGEST:
        return []
    return [found.chosen, *(c for c in found.others if c.effort < DEAREST * found.chosen.effort)]


def measure(case: GradientCase) -> list[dict[str, Any]]:
    """Time every evaluation of a case in both precisions, in turn; one row each."""
    x = np.random.default_rng(case.n).random((case.sets, case.n, case.d))
    costs = {(p, c.method): c for p in ("double", "float") for c in candidates(case, p)}
    peak = {p: fma_peak(p) for p, _ in costs}
    calls = {}
    for p, method in costs:
        evaluate = energy_evaluation(case.n, case.d, case.sigma, p, method=method)
        calls[f"{p} {method}"] = lambda evaluate=evaluate: evaluate(x)
    timings = interleave(calls, SECONDS)
    peak = {p: max(known, fma_peak(p)) for p, known in peak.items()}
    first = {p: next(method for q, method in costs if q == p) for p in peak}
    rows = []
    for (p, method), cost in costs.items():
        timing = timings[f"{p} {method}"]
        chosen = method == first[p]
        best = float(timing.cpu.min())
        rows.append(
            {
                "n": case.n, "d": case.d, "sigma": case.sigma, "sets": case.sets, "precision": p,
                "method": method, "detail": cost.detail, "chosen": chosen, "rounds": len(timing.cpu),
                "cpu_ms": 1e3 * best, "cpu_ms_median": 1e3 * float(np.median(timing.cpu)),
                "bar_ms": case.bar if p == "double" else np.nan,
                "work_a_second": case.sets * cost.work / best, "instructions": case.sets * cost.instructions,
                "peak": peak[p] / 2, "share": case.sets * cost.instructions / best / (peak[p] / 2),
                "double_over_float": _gain(timings, first) if chosen and p == "float" else np.nan,
            }
        )  # fmt: skip
    return rows


def _gain(timings: dict[str, Timing], first: dict[str, str]) -> float:
    """Median over rounds of the chosen double evaluation's time over the chosen float one's."""
    double, single = (timings[f"{p} {first[p]}"] for p in ("double", "float"))
    return float(np.median(double.over(single)))


def main(out: Path = RESULTS, cases: Iterable[GradientCase] = CASES) -> None:
    """Run cases and write field.csv and machine.json.

    Parameters
    ----------
    out : Path
        The folder.
    cases : iterable of GradientCase
        The cases.
    """
    os.environ.update(ONE_THREAD)  # before the device is opened
    out.mkdir(parents=True, exist_ok=True)
    write_whole(out / "machine.json", (json.dumps(describe(), indent=2) + "\n").encode())
    with Rows(out / "field.csv", COLUMNS) as file:
        for case in cases:
            for row in measure(case):
                file.add(row)
                mark = "*" if row["chosen"] else " "
                print(
                    f"{mark} n={row['n']:<8} d={row['d']:<3} sigma={row['sigma']:g} sets={row['sets']:<3} "
                    f"{row['precision']:<7}{row['method']:<10}{row['cpu_ms']:10.3f} ms  "
                    f"{row['work_a_second']:.3g}/s  share {row['share']:.2f}  double/float "
                    f"{row['double_over_float']:.2f}",
                    flush=True,
                )


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else RESULTS)
