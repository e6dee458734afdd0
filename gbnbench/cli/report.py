"""``gbnbench report``: the pictures of a finished run, drawn again from what it holds."""

from __future__ import annotations

from pathlib import Path

import click

from gbnbench.cli import options


@click.command(cls=options.Command)
@click.argument("run", type=click.Path(path_type=Path))
@click.option("--pdf", is_flag=True, help="Write the figures of a comparison also as PDF.")
def report(run: Path, pdf: bool) -> None:
    """Draw the pictures of a finished run again.

    RUN is the folder of a comparison, also of stipplings, or of a study of integration.
    """
    from gbnbench.api import comparison, integration, stippling_comparison
    from gbnbench.studies.integration.study_folder import is_study
    from gbnbench.studies.stippling_comparison.stippling_folder import is_stippling_run

    if is_study(run):
        integration.draw(integration.Integration.read(run).study, run)
        click.echo(f"picture: {run / 'integration.png'}")
        return
    if is_stippling_run(run):
        stippling_comparison.draw(stippling_comparison.StipplingComparison.read(run).run, run)
        click.echo(f"report: {run / 'report.html'}")
        return
    comparison.draw(comparison.Comparison.read(run).run, run, pdf=pdf)
    click.echo(f"report: {run / 'report.html'}")
