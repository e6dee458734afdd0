"""``gbnbench bench periodogram``: speed and error of spectra on this machine, beside other libraries."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gbnbench.cli import options
from gbnbench.cli.bench_gbn import gbn
from gbnbench.cli.json_text import json_text
from gbnbench.core.text_table import aligned, number

if TYPE_CHECKING:
    import pandas as pd

    from gbnbench.benchmarks.spectra.benchmark import SpectrumTables


SPEED_HEAD = (
    "method", "CPU ms", "median", "wall ms", "ratio", "over rounds", "rms error", "P to 1%", "of peak"
)  # fmt: skip


@click.group()
def bench() -> None:
    """Speed and error on this machine, beside other ways."""


bench.add_command(gbn)


@bench.command(cls=options.Command)
@options.out_folder(
    "Folder for the tables and pictures; files of the same names are replaced.", default="bench-periodogram"
)
@options.quick_or_full(
    "--quick takes under half a minute, --full under five; times are rougher.", default="full"
)
@options.json
@options.quiet
@options.device
def periodogram(out: Path, quick: bool, as_json: bool, quiet: bool) -> None:
    """Speed against error of the spectrum beside numpy, FINUFFT, ducc0, hard cases, and how the cost grows.

    All methods run in one process, in turn; times are CPU time over all threads, and ratios are taken round
    by round. Tables are kept as they come, so a run that is stopped leaves what it has measured.
    """
    from gbnbench.benchmarks.spectra import cases
    from gbnbench.benchmarks.spectra.benchmark import run
    from gbnbench.execution import progress

    plan = cases.quick() if quick else cases.full()
    try:
        with progress.choose(quiet) as teller:
            outcome = run(out, plan, teller)
    except KeyboardInterrupt:
        raise KeyboardInterrupt(f"what was measured is in {out}") from None
    _draw(outcome, out)
    if as_json:
        tables = {"speed": outcome.speed, "scaling": outcome.scaling, "hard_cases": outcome.hard}
        click.echo(json_text({"machine": outcome.machine, **tables}))
    else:
        for line in _report(outcome):
            click.echo(line)
    click.echo(f"pictures: {out / 'speed_error.png'}, {out / 'scaling.png'}", err=as_json)
    if not outcome.hard.held.all():
        click.echo("gbnbench: a stated error bound does not hold here: see hard_cases.csv", err=True)
        click.get_current_context().exit(1)


def _draw(outcome: SpectrumTables, out: Path) -> None:
    """Write the two pictures as PNG and PDF."""
    from gbnbench.core.atomic_write import write_whole
    from gbnbench.reports.benchmarks import scaling, speed_error
    from gbnbench.reports.comparison.figure_files import pdf, png

    figures = {
        "speed_error": speed_error.figure(outcome.speed, outcome.machine),
        "scaling": scaling.figure(outcome.scaling, outcome.machine),
    }
    for name, figure in figures.items():
        write_whole(out / f"{name}.png", png(figure))
        write_whole(out / f"{name}.pdf", pdf(figure))


def _report(outcome: SpectrumTables) -> Iterator[str]:
    """Write what was measured as text, a table a case."""
    from gbnbench.benchmarks.spectra.hard_table import resolvable
    from gbnbench.benchmarks.spectra.scaling import slopes

    machine = outcome.machine
    yield f"{machine['processor']}, {machine['cores']} cores; {machine['device']}"
    for name, part in outcome.speed.groupby("case", sort=False):
        yield f"\n{name}"
        yield from aligned(
            SPEED_HEAD,
            [
                (
                    row.method, *map(number, (row.cpu_ms, row.cpu_ms_median, row.wall_ms, row.ratio)),
                    f"{row.ratio_min:.2f} to {row.ratio_max:.2f}",
                    *map(number, (row.error_rms, row.resolvable)), _share(row.share_of_peak),
                )
                for row in part.itertuples()
            ],
        )  # fmt: skip
    for library in ("FINUFFT", "ducc0"):
        if not any(str(family).startswith(library) for family in set(outcome.speed.family)):
            yield f"\n{library} is not installed: pip install {library.lower()} to add it"
    first = outcome.speed.method.iloc[0]
    yield f"\nratio: CPU time over that of {first}, the median over rounds; P to 1%: least power known to 1%"
    yield "\nSlope of CPU time against work, from 1e7 operations; share of peak of the plain product"
    yield from aligned(
        ("more", "method", "sizes", "slope", "steepest", "least share", "most share"),
        [
            (
                row.sweep, row.method, str(row.sizes), number(row.slope), number(row.steepest),
                _share(row.share_least), _share(row.share_most),
            )
            for row in slopes(outcome.scaling).itertuples()
        ],
    )  # fmt: skip
    for precision, found in machine["tile_flops_a_second"].items():
        yield (
            f"\nthe product's tile in {precision}, sixteen sets: {found['tile'] / 1e9:.1f} of "
            f"{found['peak'] / 1e9:.1f} GFlop/s, {found['tile'] / found['peak']:.0%} of the peak"
        )
    yield f"\n{outcome.throughput}"
    yield from _hard(outcome.hard, resolvable(outcome.hard))


def _hard(hard: pd.DataFrame, least: pd.DataFrame) -> Iterator[str]:
    from gbnbench.benchmarks.spectra.hard_table import SLACK, TYPICAL

    held, passed = int(hard.held.sum()), int(hard.passed.sum())
    yield f"\nhard cases: in {held} of {len(hard)} the error met is within the stated worst case;"
    yield (
        f"in {passed} the statement is also tight: the worst case at most {SLACK} times an error met at that "
        f"n, the typical error right within {TYPICAL} times"
    )
    yield from aligned(
        ("method", "precision", "n", "rms error", "P to 1%"),
        [
            (row.method, row.precision, str(row.n), number(row.rms), number(row.power))
            for row in least.itertuples()
        ],
    )


def _share(value: Any) -> str:
    return "–" if value != value else f"{100 * value:.0f}%"
