"""Coverage of the errors that ``gbnbench.in_window`` states, against closed forms.

    python -m gbnbench.benchmarks.experiments.window_coverage benchmarks/results/window/coverage.csv
    python -m gbnbench.benchmarks.experiments.window_coverage --table benchmarks/results/window/coverage.csv

The first makes the table, process by process, and goes on where it was stopped; with --jobs or --executor
workers do it. The second prints it for docs/windows.md.
"""

from __future__ import annotations

import argparse
import math
from operator import itemgetter
from pathlib import Path

import numpy as np
import pandas as pd

from gbnbench.analysis.window.estimates import WindowEstimates, in_window
from gbnbench.analysis.window.gamma_regression import NORMAL_95
from gbnbench.benchmarks.experiments.filled_table import add_workers, fill
from gbnbench.benchmarks.experiments.window_processes import PROCESSES, Process
from gbnbench.benchmarks.timing.table_store import TableStore
from gbnbench.core.torus import FloatArray
from gbnbench.runs.task import Task

SETS, SEED = 100, 12
FEWEST_PAIRS = 10  # of a bin of g, from which its error is close to normal
BRAGG = 0.9  # share of the first Bragg peak's wave number up to which the formula of a lattice holds
COLUMNS = ["process", "sets", "n", "quantity", "values", "z_mean", "z_variance", "covered"]


def z_scores(process: Process, found: WindowEstimates) -> dict[str, tuple[FloatArray, FloatArray]]:
    """Compare one set's estimates with the truth.

    Parameters
    ----------
    process : Process
        The truth.
    found : WindowEstimates
        The estimates.

    Returns
    -------
    dict
        Quantity -> (z, covered), one value each bin or one of a scalar. A z is the difference over the
        standard error; of S over the true S / sqrt(degrees), since an estimate and its stated error rise and
        fall together; of a scalar over the arm of its 95% interval on the side of the truth, in units of
        1.96. ``covered`` tells whether the 95% interval holds the truth.
    """
    table = found.structure_factor
    table = table[table["resolved"]]
    if process.name.startswith("lattice"):
        table = table[table["k"] < BRAGG * 2 * math.pi]
    true = process.structure_factor(table["k"].to_numpy())
    z = (table["S"].to_numpy() / true - 1) * np.sqrt(table["degrees"].to_numpy())
    covered = ((table["low"] <= true) & (table["high"] >= true)).to_numpy()
    scores = {"S": (z, covered.astype(float))}
    if process.pair_correlation is not None:
        pairs = found.pair_correlation
        pairs = pairs[pairs["pairs"] >= FEWEST_PAIRS]
        z = (
            (pairs["g"] - process.pair_correlation(pairs["r"].to_numpy())) / pairs["standard_error"]
        ).to_numpy()
        scores["g"] = (z, (np.abs(z) <= NORMAL_95).astype(float))
    truths = {
        "s_zero": process.s_zero,
        "exponent": process.exponent,
        "intensity": process.intensity,
        "mean_distance": process.mean_distance,
    }
    for name, truth in truths.items():
        if truth is not None and math.isfinite(found.scalars.standard_error[name]):
            value, (low, high) = found.scalars[name], found.intervals[name]
            arm = value - low if truth < value else high - value
            one = np.array([NORMAL_95 * (value - truth) / arm])
            scores[name] = (one, (np.abs(one) <= NORMAL_95).astype(float))
    return scores


def coverage(process: Process, sets: int = SETS, seed: int = SEED) -> pd.DataFrame:
    """Estimate many sets of a process, and tell the mean and variance of z and how often intervals hold.

    Parameters
    ----------
    process : Process
        What is drawn.
    sets : int
        How many.
    seed : int
        Set i draws from stream i of this seed.

    Returns
    -------
    pandas.DataFrame
        A row a quantity: ``process``, ``sets``, mean ``n``, ``quantity``, ``values`` of a set, and over all
        sets and values ``z_mean``, ``z_variance`` (about 0) and ``covered``.
    """
    scores: dict[str, list[tuple[FloatArray, FloatArray]]] = {}
    counts = []
    for stream in np.random.SeedSequence(seed).spawn(sets):
        x = process.draw(np.random.default_rng(stream))
        counts.append(len(x))
        for name, pair in z_scores(process, in_window(x, 0, process.sides)).items():
            scores.setdefault(name, []).append(pair)
    rows = []
    for name, pairs in scores.items():
        z = np.concatenate([pair[0] for pair in pairs])
        held = np.concatenate([pair[1] for pair in pairs])
        each = round(len(z) / len(pairs))
        rows.append([process.name, sets, np.mean(counts), name, each, z.mean(), (z**2).mean(), held.mean()])
    return pd.DataFrame(rows, columns=COLUMNS)


def markdown(table: pd.DataFrame) -> str:
    """Write the table for the page.

    Parameters
    ----------
    table : pandas.DataFrame
        Rows of ``coverage``.

    Returns
    -------
    str
        A row a process; of each quantity the mean of z, its variance about 0, and the share of 95% intervals
        that hold.
    """
    names = list(dict.fromkeys(table["quantity"]))
    lines = ["| process | sets | n | " + " | ".join(names) + " |", "|---|---|---|" + "---|" * len(names)]
    for process, part in table.groupby("process", sort=False):
        by_name = part.set_index("quantity")
        cells = [
            "{z_mean:+.2f}, {z_variance:.2f}, {covered:.0%}".format(**by_name.loc[name])
            if name in by_name.index
            else "-"
            for name in names
        ]
        first = part.iloc[0]
        lines.append(f"| {process} | {first['sets']} | {first['n']:.0f} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main() -> None:
    """Run the command."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path)
    parser.add_argument("--sets", type=int, default=SETS)
    parser.add_argument("--table", action="store_true")
    add_workers(parser)
    given = parser.parse_args()
    if given.table:
        print(markdown(pd.read_csv(given.out)))
        return
    tasks = [
        Task(process.name, process.name, rows_of, (number, given.sets))
        for number, process in enumerate(PROCESSES)
    ]
    order = [task.key for task in tasks]
    fill(tasks, TableStore(given.out, COLUMNS, itemgetter("process"), order), given)


def rows_of(number: int, sets: int) -> list[dict[str, object]]:
    """Measure one of ``PROCESSES``, in a worker.

    Parameters
    ----------
    number : int
        Which.
    sets : int
        Of it.

    Returns
    -------
    list of dict
        Rows of the table.
    """
    table = coverage(PROCESSES[number], sets)
    return [dict(zip(COLUMNS, row, strict=True)) for row in table.itertuples(index=False, name=None)]


if __name__ == "__main__":
    # Workers find a task's function by the name of its module, which is not __main__ there.
    from gbnbench.benchmarks.experiments import window_coverage

    window_coverage.main()
