"""``gbnbench analyze``: files of point sets measured."""

from __future__ import annotations

import json
import math
import shutil
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gbnbench.cli import options
from gbnbench.cli.point_files import naming, read_torus
from gbnbench.core.errors import GbnbenchError, RefusalError
from gbnbench.core.readable_text import display_width, in_one_line, left, right

if TYPE_CHECKING:
    import pandas as pd

    from gbnbench.core.results.measures import Measures
    from gbnbench.core.sides import Sides
    from gbnbench.core.torus import FloatArray
    from gbnbench.io.points import ReadingOptions


LOW, BAND = 0.5, 0.05  # nu to which a box's own spectrum is shown, and of each of its bands


@click.command(cls=options.Command)
@click.argument("files", nargs=-1, required=True, type=click.Path(path_type=Path), metavar="FILE...")
@click.option("--explain", is_flag=True, help="Only say how the spectra would be computed, and at what cost.")
@click.option(
    "--projections", metavar="SUBSETS",
    help="Also measure projections: 1 for every axis, 2 for every plane, 0+2 for one plane. Separate several "
    "by /.",
)  # fmt: skip
@click.option(
    "--box",
    is_flag=True,
    help="Also measure each set as points of a box that is no torus: density by depth, and a spectrum of "
    "its own.",
)
@click.option(
    "--window", metavar="ENDS",
    help="Take the points for a sample seen through a window that is no torus, and estimate what can be "
    "estimated there. Give the ends of each axis, such as 0,512,0,256, or 'file' for the box in the file.",
)  # fmt: skip
@click.option(
    "--rdf", "rdf_file", metavar="FILE.csv", type=click.Path(path_type=Path, dir_okay=False),
    help="Write the radial distribution function g(r) to this file, instead of the measures.",
)  # fmt: skip
@click.option(
    "--range", "reach", type=click.FloatRange(0, min_open=True), metavar="SPACINGS",
    help="With --rdf: the longest distance, in spacings of the densest lattice.  [default: 8]",
)  # fmt: skip
@click.option("--bins", type=click.IntRange(1), help="With --rdf: number of bins.  [default: n/8 to 8]")
@click.option(
    "--fmax", type=click.IntRange(1),
    help="Largest harmonic on each axis of the spectrum.  [default: just beyond nu = 2, or as affordable]",
)  # fmt: skip
@options.out_file("With --window: picture of the estimates to write, .png, .pdf or .svg.")
@options.reading
@options.json
@options.quiet
@options.device
def analyze(
    files: tuple[Path, ...],
    as_json: bool,
    quiet: bool,
    explain: bool,
    projections: str | None,
    box: bool,
    window: str | None,
    rdf_file: Path | None,
    reach: float | None,
    bins: int | None,
    fmax: int | None,
    out: Path | None,
    reading: ReadingOptions,
) -> None:
    """Every measure of the sets in files, one row a set.

    --json prints a list of {path, set, n, d, measures, reasons}; reasons say why a measure is null. With
    --window the points need no torus: structure factor, pair correlation, hyperuniformity and distances
    are estimated, each with its standard error.
    """
    if rdf_file is None and (reach is not None or bins is not None):
        raise click.UsageError("--range and --bins are of g(r): give --rdf FILE.csv too")
    if rdf_file is not None:
        if explain or projections is not None or box or window is not None or as_json or fmax is not None:
            raise click.UsageError("--rdf goes with --range and --bins alone: leave the others out")
        from gbnbench.cli.analyze_rdf import write_rdf

        write_rdf(files, rdf_file, reading, reach, bins, quiet=quiet)
        return
    if window is not None:
        if explain or projections is not None or box or fmax is not None:
            raise click.UsageError("--window goes with none of --explain, --projections, --box and --fmax")
        from gbnbench.cli.analyze_window import analyze_window

        analyze_window(files, window, reading, out, as_json=as_json)
        return
    if out is not None:
        raise click.UsageError("--out draws what --window estimates: give --window too")
    if explain and as_json:
        raise click.UsageError("--explain and --json do not go together: leave one out")
    if explain:
        _explain(files, reading, fmax)
        return
    from gbnbench.analysis.measures import measures
    from gbnbench.cli.large_sets import Stopped, cost_of_large, stages
    from gbnbench.core.sides import as_sides

    rows: list[tuple[Path, int, int, int, Measures]] = []
    more: list[dict[str, pd.DataFrame]] = []
    boxes: list[Sides | None] = []
    failed, stopped = False, Stopped()
    for path in files:
        if stopped.asked:
            break
        try:
            read = read_torus(path, reading)
            for index, x in enumerate(read.sets):
                with naming(path, index):
                    sides = as_sides(read.sides, x.shape[1])
                    cost = cost_of_large(x.shape[0], x.shape[1], fmax, sides)
                    tables = _tables(x, projections, box, sides)
                    with stages(cost, str(path), stopped, quiet) as tell:
                        found = measures(x, fmax, sides=sides, progress=tell)
                    rows.append((path, index, x.shape[0], x.shape[1], found))
                    more.append(tables)
                    boxes.append(sides)
                if stopped.asked:
                    break
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
                **({} if sides is None else {"sides": list(sides)}),
                "measures": {name: v if math.isfinite(v) else None for name, v in found.items()},
                "reasons": dict(found.reasons),
                **{name: json.loads(table.to_json(orient="records")) for name, table in tables.items()},
            }
            for (path, index, n, d, found), tables, sides in zip(rows, more, boxes, strict=True)
        ]
        click.echo(json.dumps(listed, indent=2, allow_nan=False))
    elif rows:
        _table(rows, boxes)
        for (path, index, *_), tables in zip(rows, more, strict=True):
            for name, table in tables.items():
                click.echo(f"\n{path}, set {index}, {name}:")
                click.echo(table.to_string(index=False, float_format=lambda v: f"{v:.4g}"))
    if stopped.asked:
        raise KeyboardInterrupt("what was measured before is printed")
    if failed:
        click.get_current_context().exit(2)


def _tables(
    x: FloatArray, projections: str | None, box: bool, sides: Sides | None
) -> dict[str, pd.DataFrame]:
    """Tables beside the measures of one set, by name."""
    n, d = x.shape
    tables: dict[str, pd.DataFrame] = {}
    if projections is not None:
        from gbnbench.analysis.radial import projections as projected
        from gbnbench.generators.gbn.projective import subsets

        found = projected.frame(projected.projections(x, subsets(projections, d), sides=sides))
        tables["projections"] = found.dropna(axis=1, how="all")  # a single set has no standard errors
    if box:
        if sides is not None:
            raise RefusalError("--box measures cubes alone, and this box has unequal sides: leave it out")
        import numpy as np

        from gbnbench.analysis.spatial.edge_density import edge_density
        from gbnbench.analysis.spectrum.cosine_power import cosine_power, cosine_radial
        from gbnbench.analysis.spectrum.limits import default_fmax

        tables["edge density"] = edge_density(x).to_frame().dropna(axis=1, how="all")
        shells = cosine_radial(cosine_power(x, default_fmax(n, d)), n).to_frame()
        low = shells[shells.nu <= LOW]
        band = np.ceil(low.nu / BAND - 1e-9) * BAND
        total = (low.power * low["count"]).groupby(band).sum() / low.groupby(band)["count"].sum()
        tables["cosine power"] = total.rename_axis("nu").rename("mean power up to nu").reset_index()
    return tables


def _explain(files: tuple[Path, ...], reading: ReadingOptions, fmax: int | None) -> None:
    """Print, for each file, the plan of its sets' spectra."""
    from gbnbench.analysis.spectrum.settings import SpectrumSettings
    from gbnbench.cli.large_sets import cost_of_large
    from gbnbench.core.sides import as_sides

    failed = False
    for path in files:
        try:
            read = read_torus(path, reading)
            shapes = [x.shape for x in read.sets]
            for n, d in dict.fromkeys(shapes):
                times = shapes.count((n, d))
                with naming(path, shapes.index((n, d))):
                    box = as_sides(read.sides, d)
                    plan = SpectrumSettings(fmax).affordable(n, d, box).plans(n, d, 1, box)[0]
                    cost = cost_of_large(n, d, fmax, box)
                click.echo(f"{path}{f', {times} sets, each' * (times > 1)}:\n{plan}")
                if cost is not None:
                    click.echo(cost.explain())
        except GbnbenchError as error:
            failed = True
            click.echo(f"gbnbench: error: {error}", err=True)
    if failed:
        click.get_current_context().exit(2)


def _table(rows: list[tuple[Path, int, int, int, Measures]], boxes: list[Sides | None]) -> None:
    """Print aligned columns: wide, so that each set keeps its line."""
    from gbnbench.analysis.measure_definitions import BY_NAME
    from gbnbench.core.footnotes import footnotes
    from gbnbench.core.sides import sides_text

    told = any(sides is not None for sides in boxes)
    box = ["sides"] if told else []
    heads = ["file", "set", "n", "d", *box, *(BY_NAME[name].title for name in rows[0][4])]
    cells = [heads]
    for (path, index, n, d, found), sides in zip(rows, boxes, strict=True):
        numbers = ["-" if math.isnan(v) else f"{v:.4g}" for v in found.values()]
        box = ["-" if sides is None else sides_text(sides)] if told else []
        cells.append([in_one_line(path), str(index), str(n), str(d), *box, *numbers])
    widths = [max(display_width(row[i]) for row in cells) for i in range(len(heads))]
    for row in cells:
        numbers = [right(cell, width) for cell, width in zip(row[1:], widths[1:], strict=True)]
        click.echo("  ".join([left(row[0], widths[0]), *numbers]))
    missing = [(BY_NAME[name].title, text) for *_, found in rows for name, text in found.reasons.items()]
    for line in footnotes(missing, shutil.get_terminal_size((100, 24)).columns):
        click.echo(line)
