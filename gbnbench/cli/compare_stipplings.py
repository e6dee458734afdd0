"""``gbnbench compare --density IMAGE``: stipplers and stipplings by anybody side by side."""

from __future__ import annotations

import math
import shlex
import shutil
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from click.core import ParameterSource

from gbnbench.cli.json_text import json_text, records
from gbnbench.cli.undrawn import undrawn
from gbnbench.core.errors import UnfinishedError

if TYPE_CHECKING:
    from gbnbench.api.stippling_comparison import StipplingComparison
    from gbnbench.io.points import ReadingOptions

SINGLE = "a standard error needs two sets or more"
UNDRAWN = "no generator made these sets"
OTHERS = {"d": "-d", "baseline": "--baseline", "groups": "--family and --preset"}


def compare_stipplings(
    sources: tuple[str, ...],
    image: str,
    *,
    n: tuple[int, ...],
    realizations: int,
    seed: int,
    invert: bool,
    out: Path | None,
    jobs: int | None,
    as_json: bool,
    quiet: bool,
    reading: ReadingOptions,
) -> None:
    """Do what ``gbnbench compare`` does with ``--density``.

    Parameters
    ----------
    sources : tuple of str
        As typed.
    image : str
        What ``--density`` names.
    n : tuple of int
        As typed, or the default, which then does not hold.
    realizations : int
        Likewise.
    seed, invert, out, jobs, as_json, quiet, reading
        As the command takes them.

    Raises
    ------
    click.UsageError
        If an option is given that goes with points of the torus alone.
    UnfinishedError
        If a source failed, when the report of the others is written.
    """
    from gbnbench.api.stipplings import DEFAULT_STIPPLERS
    from gbnbench.api.stipplings import compare_stipplings as make

    given = _given()
    for name, option in OTHERS.items():
        if name in given:
            verb = "are" if " and " in option else "is"
            raise click.UsageError(
                f"{option} {verb} not for stipplings: leave it out, or leave out --density"
            )
    if "n" in given and len(n) > 1:
        raise click.UsageError(f"-n takes one number with --density; got {','.join(map(str, n))}")
    made = make(
        image,
        sources or DEFAULT_STIPPLERS,
        n=min(n) if "n" in given else None,
        realizations=realizations if "realizations" in given else 1,
        seed=seed,
        invert=invert,
        out=out,
        jobs=jobs,
        quiet=quiet,
        reading=reading,
        pictures=True,
        command=shlex.join(["gbnbench", *sys.argv[1:]]),
    )
    _show(made, as_json)


def _given() -> set[str]:
    """Names of the options that stand on the command line."""
    context = click.get_current_context()
    given = {
        name
        for name in context.params
        if context.get_parameter_source(name) not in (ParameterSource.DEFAULT, None)
    }
    return given | ({"groups"} if context.params["family"] or context.params["preset"] else set())


def _show(made: StipplingComparison, as_json: bool) -> None:
    """Print the table, what is missing from it, and where everything is."""
    from gbnbench.reports.stippling_comparison.table import terminal_text

    for line in made.skipped:
        click.echo(f"gbnbench: skipped: {line}", err=True)
    if made.run.sources:
        width = shutil.get_terminal_size((100, 24)).columns
        click.echo(json_text(_records(made)) if as_json else terminal_text(made.run, width))
    if made.undrawn:
        undrawn(made.folder, made.undrawn)
    if made.failures:
        for line in made.failures[1:]:
            click.echo(f"gbnbench: failed: {line}", err=True)
        others = f"; the report of the others: {made.report()}" if made.run.sources else ""
        raise UnfinishedError(
            f"{len(made.failures)} of {len(made.failures) + len(made.run.sources)} sources failed, and the "
            f"same command tries them again; the first: {made.failures[0]}{others}"
        )
    kept = f", {made.reused} of {made.pieces} sets reused" if made.reused else ""
    click.echo(f"report: {made.report()} ({made.seconds:.1f} s{kept})", err=as_json)


def _records(made: StipplingComparison) -> list[dict[str, Any]]:
    """Rows of the table, each with ``reasons`` why numbers in it are null."""
    found = []
    for row, source in zip(records(made.table), made.run.sources, strict=True):
        missing = [name for name, value in row.items() if isinstance(value, float) and math.isnan(value)]
        why = {"cpu_seconds": UNDRAWN, **source.measures.reasons}
        found.append({**row, "reasons": {name: why.get(name, SINGLE) for name in missing}})
    return found
