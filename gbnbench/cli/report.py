"""``gbnbench report``: the pictures of a run, remade from what it saved."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from gbnbench.runs.comparison_result import Run


@click.command()
@click.argument("run", type=click.Path(path_type=Path))
def report(run: Path) -> None:
    """Remake the pictures of the finished folder RUN, of a comparison or a study of integration."""
    from gbnbench.runs.comparison_folder import read_run
    from gbnbench.studies.integration.study import is_study, read_integration

    if is_study(run):
        from gbnbench.cli.integrate import draw as draw_study

        draw_study(read_integration(run), run)
        click.echo(f"picture: {run / 'integration.png'}")
        return
    draw(read_run(run), run)
    click.echo(f"report: {run / 'report.html'}")


def draw(run: Run, folder: Path) -> None:
    """Write the figures and report.html of a run into its folder."""
    from gbnbench.reports.comparison.figure_files import write_figures
    from gbnbench.reports.html.page import write_report

    write_figures(run, folder / "figures")
    write_report(run, folder / "report.html")
