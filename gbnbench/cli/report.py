"""``gbnbench report``: the pictures of a run, remade from what it saved."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

if TYPE_CHECKING:
    from gbnbench.run import Run


@click.command()
@click.argument("run", type=click.Path(path_type=Path))
def report(run: Path) -> None:
    """Remake the figures and report.html of the finished run folder RUN from its saved data."""
    from gbnbench.store import read_run

    draw(read_run(run), run)
    click.echo(f"report: {run / 'report.html'}")


def draw(run: Run, folder: Path) -> None:
    """Write the figures and report.html of a run into its folder."""
    from gbnbench.reports.figures import write_figures
    from gbnbench.reports.html import write_report

    write_figures(run, folder / "figures")
    write_report(run, folder / "report.html")
