"""``gbnbench compare``: sources in; a table, a report and a run folder out."""

from __future__ import annotations

import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gbnbench.cli import options
from gbnbench.cli.report import draw

if TYPE_CHECKING:
    from gbnbench.studies.comparison import ComparisonOutcome

EPILOG = """\b
Examples:
  gbnbench compare                                  six classics, a minute or so
  gbnbench compare gbn 'gbn[iterations=1000]' mine.txt
  gbnbench compare jittered sobol -n 256,1024,4096  a sweep
  gbnbench compare gbn --baseline runs/before       exit code 1 when worse

\b
Generators: random, grid, hexagonal, jittered, latin, halton, sobol, lloyd, fpo, gbn, deep, stealthy;
an unknown setting, as in gbn[x=1], lists those there are.
"""


@click.command(epilog=EPILOG)
@click.argument("sources", nargs=-1)
@click.option("-n", "n", type=options.Whole(), default="1024", show_default=True, help="Points a set.")
@click.option("-d", "d", type=options.Whole(), default="2", show_default=True, help="Dimensions.")
@click.option(
    "--realizations", type=click.IntRange(1), default=16, show_default=True, help="Sets of each generator."
)
@options.seed
@click.option(
    "--out", type=click.Path(path_type=Path), help="Run folder.  [default: runs/NAME, by the settings]"
)
@click.option("--baseline", type=click.Path(path_type=Path), help="A finished run to be judged against.")
@click.option("--jobs", type=click.IntRange(1), help="Worker processes.  [default: one a core]")
@click.option("--quiet", is_flag=True, help="No progress.")
@options.device
def compare(
    sources: tuple[str, ...],
    n: tuple[int, ...],
    d: tuple[int, ...],
    realizations: int,
    seed: int,
    out: Path | None,
    baseline: Path | None,
    jobs: int | None,
    quiet: bool,
) -> None:
    """Compare SOURCES side by side: generators with settings, files, folders, any mix.

    A folder is one source for each (n, d) in it. Stopped in any way, the same command goes on where it was.
    """
    from gbnbench.execution import progress
    from gbnbench.runs.sources import DEFAULT_SOURCES, resolve
    from gbnbench.studies.comparison import run_comparison

    found, skipped = resolve(sources or DEFAULT_SOURCES, n, d, realizations)
    for line in skipped:
        click.echo(f"gbnbench: skipped: {line}", err=True)
    with progress.choose(quiet) as teller:
        outcome = run_comparison(
            found,
            out,
            seed=seed,
            jobs=jobs,
            baseline=baseline,
            command=shlex.join(["gbnbench", *sys.argv[1:]]),
            skipped=skipped,
            progress=teller,
            draw=draw,
        )
    _tell(outcome)
    if outcome.worse:
        click.get_current_context().exit(1)


def _tell(outcome: ComparisonOutcome) -> None:
    """Print the table, what to beware of, the verdicts, and where everything is."""
    from gbnbench.reports.comparison.table import terminal_text

    click.echo(terminal_text(outcome.run, colour=sys.stdout.isatty()))
    for source in outcome.run.sources:
        for warning in source.warnings:
            click.echo(f"gbnbench: warning: {source.label} (n={source.n}, d={source.d}): {warning}", err=True)
    for change in outcome.changes:
        click.echo(
            f"{change.verdict}: {change.label} (n={change.n}, d={change.d}) {change.measure} "
            f"{change.before:.4g} -> {change.after:.4g}, {change.deviations:.1f} standard errors"
        )
    for note in outcome.notes:
        click.echo(f"baseline: {note}", err=True)
    if outcome.run.manifest["baseline"] and not outcome.changes:
        click.echo("baseline: nothing better or worse beyond 3 standard errors")
    kept = f", {outcome.reused} of {outcome.pieces} pieces reused" if outcome.reused else ""
    click.echo(f"report: {outcome.folder / 'report.html'} ({outcome.seconds:.1f} s{kept})")
