"""``gbnbench report``: the pictures of a finished run drawn again, or a page of several runs."""

from __future__ import annotations

from pathlib import Path

import click

from gbnbench.cli import options
from gbnbench.core.errors import InputError

EPILOG = """\b
Examples:
  gbnbench report runs/today                              draw its pictures and report again
  gbnbench report runs/before runs/after -o both.html     two runs side by side
"""


@click.command(cls=options.Command, epilog=EPILOG)
@click.argument("runs", nargs=-1, required=True, metavar="RUN...", type=click.Path(path_type=Path))
@options.out_file("Page of several runs side by side; of one run, its page alone, written there.")
@click.option("--pdf", is_flag=True, help="Write the figures of a comparison also as PDF.")
def report(runs: tuple[Path, ...], out: Path | None, pdf: bool) -> None:
    """Draw a finished run again, or set several side by side.

    RUN is the folder of a comparison, of a comparison of stipplings, or of a study of integration.
    Several comparisons with the same n and d are set side by side on one page: it has a column of
    measures for each run, marked where they are better or worse than in the first run by more than three
    standard errors, and all curves in the same charts.
    """
    from gbnbench.api import comparison, integration, stippling_comparison
    from gbnbench.studies.integration.study_folder import is_study
    from gbnbench.studies.stippling_comparison.stippling_folder import is_stippling_run

    if len(runs) > 1 and out is None:
        raise click.UsageError("a report of several runs goes into a file of its own: give -o FILE")
    if out is not None and pdf:
        raise click.UsageError("--pdf writes figures into the folder of a run; -o FILE writes one page alone")
    if out is not None:
        for run in runs:
            if is_study(run) or is_stippling_run(run):
                kind = "study of integration" if is_study(run) else "comparison of stipplings"
                raise InputError(f"-o FILE is for comparisons of point sets; {run} is a {kind}")
        _page(runs, out)
        return
    run = next(iter(runs))
    if is_study(run):
        integration.draw(integration.Integration.read(run).study, run)
        click.echo(f"picture: {run / 'integration.png'}")
        return
    if is_stippling_run(run):
        stippling_comparison.draw(stippling_comparison.StipplingComparison.read(run).run, run)
    else:
        comparison.draw(comparison.Comparison.read(run).run, run, pdf=pdf)
    click.echo(f"report: {run / 'report.html'}")


def _page(runs: tuple[Path, ...], out: Path) -> None:
    """Write one page of one or several comparisons."""
    from gbnbench.api.run_report import report_runs
    from gbnbench.reports.html.page import write_report
    from gbnbench.runs.comparison_folder import read_run

    if len(runs) == 1:
        write_report(read_run(runs[0]), out)
    else:
        for note in report_runs(runs, out).notes:
            click.echo(f"gbnbench: {note}", err=True)
    click.echo(f"report: {out}")
