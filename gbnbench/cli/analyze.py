"""``gbnbench analyze``: files of point sets measured."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gbnbench.cli import options
from gbnbench.errors import GbnbenchError

if TYPE_CHECKING:
    from gbnbench.results import Measures


@click.command()
@click.argument("files", nargs=-1, required=True, type=click.Path(path_type=Path), metavar="FILE...")
@click.option("--json", "as_json", is_flag=True, help="Print a list of {path, set, n, d, measures}.")
@click.option("--explain", is_flag=True, help="Say how the spectra would be found, at what cost; do nothing.")
@options.device
def analyze(files: tuple[Path, ...], as_json: bool, explain: bool) -> None:
    """Measure every set in every FILE, one row a set."""
    if explain and as_json:
        raise click.UsageError("--explain and --json do not go together: leave one out")
    if explain:
        _explain(files)
        return
    from gbnbench.analysis.measures import measures
    from gbnbench.points import read

    rows: list[tuple[Path, int, int, int, Measures]] = []
    failed = False
    for path in files:
        try:
            for index, x in enumerate(read(path)):
                rows.append((path, index, x.shape[0], x.shape[1], measures(x)))
        except GbnbenchError as error:
            failed = True
            click.echo(f"gbnbench: error: {error}", err=True)
    if as_json:
        listed = [
            {
                "path": str(path),
                "set": index,
                "n": n,
                "d": d,
                "measures": {name: v if math.isfinite(v) else None for name, v in found.items()},
            }
            for path, index, n, d, found in rows
        ]
        click.echo(json.dumps(listed, indent=2, allow_nan=False))
    elif rows:
        _table(rows)
    if failed:
        click.get_current_context().exit(2)


def _explain(files: tuple[Path, ...]) -> None:
    """Print, for each file, the plan of its sets' spectra."""
    from gbnbench.asked import Asked
    from gbnbench.points import read

    failed = False
    for path in files:
        try:
            shapes = [x.shape for x in read(path)]
            for n, d in dict.fromkeys(shapes):
                times = shapes.count((n, d))
                click.echo(f"{path}{f', {times} sets, each' * (times > 1)}:\n{Asked().plan(n, d, 1)}")
        except GbnbenchError as error:
            failed = True
            click.echo(f"gbnbench: error: {error}", err=True)
    if failed:
        click.get_current_context().exit(2)


def _table(rows: list[tuple[Path, int, int, int, Measures]]) -> None:
    """Print aligned columns: wide, so that each set keeps its line."""
    from gbnbench.analysis.catalogue import BY_NAME

    heads = ["file", "set", "n", "d", *(BY_NAME[name].title for name in rows[0][4])]
    cells = [heads]
    for path, index, n, d, found in rows:
        numbers = ["-" if math.isnan(v) else f"{v:.4g}" for v in found.values()]
        cells.append([str(path), str(index), str(n), str(d), *numbers])
    widths = [max(len(row[i]) for row in cells) for i in range(len(heads))]
    for row in cells:
        first, *rest = (cell.rjust(width) for cell, width in zip(row, widths, strict=True))
        click.echo("  ".join([first.strip().ljust(widths[0]), *rest]))
