"""``gbnbench bench gbn``: noise floor of Gaussian Blue Noise against time, beside the paper's descent."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gbnbench.cli import options
from gbnbench.cli.executor_option import executor, workers_wanted
from gbnbench.cli.json_text import json_text
from gbnbench.core.text_table import aligned, number

if TYPE_CHECKING:
    from gbnbench.benchmarks.gbn.benchmark import FloorTables

END_HEAD = (
    "case", "method", "precision", "gradients", "CPU s a set", "ms a gradient", "noise floor", "P(1)",
    "excess", "peak", "v6", "psi6",
)  # fmt: skip
SPEEDUP_HEAD = (
    "case", "precision", "beside", "to floor", "Nesterov CPU s", "gradients", "its CPU s", "gradients",
    "ratio", "over sets",
)  # fmt: skip
FORCE_HEAD = ("case", "precision", "kernel", "sigmas", "CPU ms", "median", "rms error")


@click.command(cls=options.Command)
@options.out_folder(
    "Folder for the tables and the picture; files of the same names are replaced.", default="bench-gbn"
)
@options.quick_or_full(
    "--quick takes under half a minute, --full under five; fewer sizes and steps.", default="full"
)
@click.option(
    "--jobs", type=click.IntRange(1),
    help="Share the sets among this many processes, each of which times whole races. If it is stopped, the "
    "same command continues it.  [default: all in turn in this process]",
)  # fmt: skip
@executor
@options.json
@options.quiet
@options.device
def gbn(out: Path, quick: bool, jobs: int | None, as_json: bool, quiet: bool) -> None:
    """Noise floor against CPU time: Nesterov's method and the paper's descent, float and double, cut-offs.

    The optimisers take turns in one process on one thread; each is stopped at a ladder of gradient counts
    and its points are measured in double beside the clock. Forces are timed and checked at every cut-off
    from 3 to 9 sigma. Tables are kept as they come, so a run that is stopped leaves what it has measured.
    Workers of --jobs and --executor time a set of a size each, with all its optimisers; their machines must
    have the same device, and seconds of different workers compare as far as these are alike.
    """
    from gbnbench.execution.one_thread import ONE_THREAD

    for variable in ("POCL_MAX_PTHREAD_COUNT", "POCL_CPU_MAX_CU_COUNT"):  # read when the device is opened
        os.environ.setdefault(variable, ONE_THREAD[variable])
    from gbnbench.benchmarks.gbn import floor_cases
    from gbnbench.benchmarks.gbn.benchmark import run
    from gbnbench.benchmarks.gbn.spread import run_by_workers
    from gbnbench.execution import progress

    plan = floor_cases.quick() if quick else floor_cases.full()
    try:
        with progress.choose(quiet) as teller:
            if workers_wanted():
                outcome = run_by_workers(out, plan, jobs or os.cpu_count() or 1, teller)
            else:
                outcome = run(out, plan, teller)
    except KeyboardInterrupt as stopped:
        raise KeyboardInterrupt(str(stopped) or f"what was measured is in {out}") from None
    draw(outcome, out)
    if as_json:
        tables = {"floors": outcome.floors, "speedups": outcome.speedups, "forces": outcome.forces}
        click.echo(json_text({"machine": outcome.machine, **tables}))
    else:
        for line in report(outcome):
            click.echo(line)
    click.echo(f"picture: {out / 'floor_time.png'}", err=as_json)


def draw(outcome: FloorTables, out: Path) -> None:
    """Write the picture as PNG and PDF.

    Parameters
    ----------
    outcome : FloorTables
        What was measured.
    out : Path
        Folder of the two files.
    """
    from gbnbench.core.atomic_write import write_whole
    from gbnbench.reports.benchmarks import floor_time
    from gbnbench.reports.comparison.figure_files import pdf, png

    figure = floor_time.figure(outcome.floors, outcome.forces, outcome.machine)
    write_whole(out / "floor_time.png", png(figure))
    write_whole(out / "floor_time.pdf", pdf(figure))


def report(outcome: FloorTables) -> Iterator[str]:
    """Write what was measured as text, a table a question."""
    from gbnbench.benchmarks.gbn.floor_time import MEASURES
    from gbnbench.generators.gbn.published_quality import AUTHORS_FLOOR

    machine = outcome.machine
    yield f"{machine['processor']}, {machine['cores']} cores; {machine['device']}"
    yield "\nWhere each ended: medians over sets, each set run by itself"
    floors, curve = outcome.floors, ["case", "curve", "precision"]
    last = floors[floors.gradients == floors.groupby(curve).gradients.transform("max")]
    ends = last.groupby(curve, sort=False)[["gradients", "cpu_s", *MEASURES]].median().reset_index()
    yield from aligned(
        END_HEAD,
        [
            (
                row.case, row.curve, row.precision, int(row.gradients), number(row.cpu_s),
                number(1e3 * row.cpu_s / row.gradients), *(number(row[name]) for name in MEASURES),
            )
            for _, row in ends.iterrows()
        ],
    )  # fmt: skip
    yield (
        f"\nCPU seconds a set to one noise floor: {AUTHORS_FLOOR:g}, that of the authors' sets (10,000 "
        "steps, n=1024 2D), or the deepest that both reach here where that is higher"
    )
    yield from aligned(
        SPEEDUP_HEAD,
        [
            (
                row.case, row.precision, row.against, number(row.floor), number(row.cpu_s),
                f"{row.gradients:.0f}", number(row.their_cpu_s), f"{row.their_gradients:.0f}",
                number(row.ratio), f"{number(row.ratio_min)} to {number(row.ratio_max)}",
            )
            for row in outcome.speedups.itertuples()
        ],
    )  # fmt: skip
    yield (
        "\nForces by cut-off: pairs further apart are left out; error in units of the largest force of a pair"
    )
    yield from aligned(
        FORCE_HEAD,
        [
            (
                row.case, row.precision, row.kernel, number(row.cutoff), number(row.cpu_ms),
                number(row.cpu_ms_median), number(row.error_rms),
            )
            for row in outcome.forces.itertuples()
        ],
    )  # fmt: skip
