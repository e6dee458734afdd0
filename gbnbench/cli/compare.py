"""``gbnbench compare``: sources in; a table, a report and a run folder out."""

from __future__ import annotations

import math
import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gbnbench.cli import options
from gbnbench.cli.executor_option import executor
from gbnbench.cli.json_text import json_text, records
from gbnbench.cli.standard_streams import wants_colour
from gbnbench.cli.undrawn import undrawn

if TYPE_CHECKING:
    from gbnbench.api.comparison import Comparison
    from gbnbench.io.points import ReadingOptions

NO_ERROR = "a standard error needs the measure of two sets or more"
EPILOG = """\b
Examples:
  gbnbench compare                                  six classics, a minute or so
  gbnbench compare gbn 'gbn[iterations=1000]' mine.txt
  gbnbench compare jittered sobol -n 256,1024,4096  a sweep
  gbnbench compare --preset paper                   the methods of the paper's figures 1 and 8
  gbnbench compare gbn --family cellular
  gbnbench compare gbn --baseline runs/before       exit code 1 when worse
  gbnbench compare --density camera gbn lbg -n 5000 stipplings of an image

\b
'gbnbench generators' lists them, 'gbnbench generators NAME' has the settings of one.
"""


@click.command(cls=options.Command, epilog=EPILOG)
@click.argument("sources", nargs=-1)
@click.option(
    "-n", "n", type=options.WholeNumbers(), default="1024", show_default=True, help="Points in a set."
)
@click.option("-d", "d", type=options.WholeNumbers(), default="2", show_default=True, help="Dimensions.")
@click.option(
    "--density",
    metavar="IMAGE",
    help="Compare stipplings of this image: a file, or a name such as camera. SOURCES are then adaptive "
    "generators and files of points, in the unit square or in pixels. Unless given, -n follows from the "
    "image and --realizations is 1.",
)
@click.option("--invert", is_flag=True, help="With --density: dots are dense where the image is light.")
@options.groups
@options.out_folder("Folder of the run.  [default: runs/NAME, NAME made from the settings]")
@click.option("--baseline", type=click.Path(path_type=Path), help="A finished run to judge this one against.")
@click.option("--pdf", is_flag=True, help="Write the figures also as PDF.")
@options.reading
@options.realizations(16)
@options.seed
@options.jobs
@executor
@options.json
@options.quiet
@options.device
def compare(
    sources: tuple[str, ...],
    n: tuple[int, ...],
    d: tuple[int, ...],
    density: str | None,
    invert: bool,
    realizations: int,
    seed: int,
    out: Path | None,
    baseline: Path | None,
    pdf: bool,
    jobs: int | None,
    as_json: bool,
    quiet: bool,
    reading: ReadingOptions,
    groups: tuple[str, ...],
) -> None:
    """Compare generators and files side by side: table, report.

    SOURCES are any mix of generators with settings, files and folders; a folder is one source for each
    (n, d) in it. However a run is stopped, the same command continues it.
    """
    if density is not None:
        from gbnbench.cli.compare_stipplings import compare_stipplings

        compare_stipplings(
            sources, density, n=n, realizations=realizations, seed=seed, invert=invert, out=out, jobs=jobs,
            as_json=as_json, quiet=quiet, reading=reading,
        )  # fmt: skip
        return
    if invert:
        raise click.UsageError("--invert goes with --density IMAGE")
    from gbnbench.api.compare import compare as make
    from gbnbench.runs.source_names import double_meanings
    from gbnbench.runs.sources import DEFAULT_SOURCES

    for line in double_meanings(sources):
        click.echo(f"gbnbench: {line}", err=True)
    comparison = make(
        [*sources, *groups] or DEFAULT_SOURCES,
        n=n,
        d=d,
        realizations=realizations,
        seed=seed,
        out=out,
        baseline=baseline,
        jobs=jobs,
        quiet=quiet,
        reading=reading,
        pictures=True,
        pdf=pdf,
        command=shlex.join(["gbnbench", *sys.argv[1:]]),
    )
    _show(comparison, as_json)
    if comparison.worse:
        click.get_current_context().exit(1)


def _records(comparison: Comparison) -> list[dict[str, Any]]:
    """Rows of the table of measures, each with ``reasons`` why numbers in it are null."""
    found = []
    for row in records(comparison.measures):
        reasons = {"value": row["reason"], "standard_error": row["reason"] or NO_ERROR}
        missing = {name: reason for name, reason in reasons.items() if math.isnan(row[name])}
        found.append({**row, "reasons": missing})
    return found


def _show(comparison: Comparison, as_json: bool) -> None:
    """Print the table, warnings, the verdicts against the baseline, and where everything is."""
    from gbnbench.reports.comparison.terminal import terminal_text

    for line in comparison.skipped:
        click.echo(f"gbnbench: skipped: {line}", err=True)
    if as_json:
        click.echo(json_text(_records(comparison)))
    else:
        click.echo(terminal_text(comparison.run, colour=wants_colour()))
    for source in comparison.sources:
        for warning in source.warnings:
            click.echo(f"gbnbench: warning: {source.label} (n={source.n}, d={source.d}): {warning}", err=True)
    for change in comparison.changes:
        click.echo(
            f"{change.verdict}: {change.label} (n={change.n}, d={change.d}) {change.measure} "
            f"{change.before:.4g} -> {change.after:.4g}, {change.deviations:.1f} standard errors",
            err=as_json,
        )
    for note in comparison.notes:
        click.echo(f"baseline: {note}", err=True)
    if comparison.run.manifest["baseline"] and not comparison.changes:
        click.echo("baseline: nothing better or worse beyond 3 standard errors", err=as_json)
    kept = f", {comparison.reused} of {comparison.pieces} pieces reused" if comparison.reused else ""
    if comparison.undrawn:
        undrawn(comparison.folder, comparison.undrawn)
    click.echo(f"report: {comparison.report()} ({comparison.seconds:.1f} s{kept})", err=as_json)
