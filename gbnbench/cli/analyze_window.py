"""``gbnbench analyze --window``: estimates of sets seen in a window that is no torus."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from gbnbench.cli.json_text import json_text, records
from gbnbench.cli.point_files import naming
from gbnbench.core.errors import FormatError, GbnbenchError, InputError

if TYPE_CHECKING:
    from gbnbench.analysis.window.estimates import WindowEstimates
    from gbnbench.core.torus import FloatArray
    from gbnbench.io.points import ReadingOptions

OWN = "file"  # the word that stands for the box that a file tells itself
MANY = 20_000  # points from which estimates take seconds
SUFFIXES = (".png", ".pdf", ".svg")


def analyze_window(
    files: tuple[Path, ...], window: str, reading: ReadingOptions, out: Path | None, *, as_json: bool
) -> None:
    """Print the estimates of every set of every file, and draw them.

    Parameters
    ----------
    files : tuple of Path
        Files of points.
    window : str
        Ends of each axis, ``0,512,0,256``, or ``file`` for the box that each file tells.
    reading : ReadingOptions
        How files are read, without a box.
    out : Path or None
        Picture to write; of several sets each gets a number.
    as_json : bool
        Print JSON.

    Raises
    ------
    InputError
        If the window cannot be meant so, or the picture's format is unknown.
    """
    from gbnbench.io.points.options import reading_options

    if reading.period is not None or reading.bounds is not None or reading.wrap:
        raise InputError("--window tells the box itself: leave out --period, --bounds and --wrap")
    if out is not None and out.suffix.lower() not in SUFFIXES:
        raise InputError(f"a picture must be a {', '.join(SUFFIXES)} file; got {str(out)!r}")
    if window != OWN:
        try:
            reading = replace(reading, bounds=reading_options(bounds=window).bounds)
        except InputError as error:
            said = str(error).removeprefix("bounds ")
            raise InputError(f"--window {said}; {OWN!r} takes the box that the file tells") from None
    reading = replace(reading, window=True)
    listed: list[dict[str, Any]] = []
    failed = False
    drawn: list[tuple[Path, int, FloatArray, WindowEstimates]] = []
    for path in files:
        try:
            for index, (points, found) in enumerate(_estimates(path, reading)):
                if as_json:
                    listed.append(_as_json(path, index, found))
                else:
                    _print(path, index, found)
                drawn.append((path, index, points, found))
        except GbnbenchError as error:
            failed = True
            click.echo(f"gbnbench: error: {error}", err=True)
    if as_json:
        click.echo(json_text(listed))
    if out is not None:
        from gbnbench.reports.window import estimates as picture

        for number, (path, index, points, found) in enumerate(drawn):
            name = picture.figure_name(out, number, len(drawn))
            picture.save(name, points, found, path.name if index == 0 else f"{path.name}, set {index}")
            click.echo(f"wrote {name}", err=True)
    if failed:
        click.get_current_context().exit(2)


def _estimates(path: Path, reading: ReadingOptions) -> list[tuple[FloatArray, WindowEstimates]]:
    """Read a file and estimate each of its sets."""
    import numpy as np

    from gbnbench.analysis.window.estimates import in_window
    from gbnbench.execution.progress import choose
    from gbnbench.io.points import read_sets
    from gbnbench.io.points.point_sets import in_own_unit

    sets = read_sets(path, reading)
    if sets.low is None or sets.sides is None:
        raise FormatError(
            path, f"tells no box: give the window's ends in place of {OWN!r}, such as 0,512,0,256"
        )
    low = np.array(sets.low)
    high = low + np.array(sets.sides)
    found = []
    for index, x in enumerate(in_own_unit(sets)):
        points = np.clip(x, low, high)  # fractions of the box and back may round past its ends
        with naming(path, index), choose(quiet=len(points) < MANY) as progress:
            found.append((points, in_window(points, low, high, progress=progress)))
    return found


def _as_json(path: Path, index: int, found: WindowEstimates) -> dict[str, Any]:
    return {
        "path": str(path),
        "set": index,
        "n": found.n,
        "d": found.d,
        "window": {"low": found.window.low, "high": found.window.high},
        "tapers": found.tapers,
        "estimates": dict(found.scalars),
        "standard_errors": dict(found.scalars.standard_error),
        "intervals": dict(found.intervals),
        "reasons": dict(found.scalars.reasons),
        "structure_factor": records(found.structure_factor),
        "pair_correlation": records(found.pair_correlation),
    }


def _print(path: Path, index: int, found: WindowEstimates) -> None:
    """Print the scalars, then both tables."""
    from gbnbench.analysis.window.estimates import TITLES

    corners = ",".join(f"{a:g},{b:g}" for a, b in zip(found.window.low, found.window.high, strict=True))
    click.echo(f"{path}, set {index}: {found.n} points, d={found.d}, in the window {corners}")
    click.echo("with standard errors and 95% intervals:\n")
    for name, value in found.scalars.items():
        error = found.scalars.standard_error[name]
        shown = f"{value:.4g}"
        if math.isfinite(error):
            low, high = found.intervals[name]
            shown = f"{shown} +- {error:.2g}  ({low:.4g} .. {high:.4g})"
        click.echo(f"  {TITLES[name]:40s} {found.scalars.reasons.get(name) or shown}")
    table = found.structure_factor.drop(columns="degrees")
    click.echo("\nstructure factor, k in radians a unit of length, 95% intervals low .. high:")
    click.echo(table.to_string(index=False, float_format=lambda v: f"{v:.4g}"))
    click.echo("\npair correlation:")
    click.echo(found.pair_correlation.to_string(index=False, float_format=lambda v: f"{v:.4g}"))
    click.echo("")
