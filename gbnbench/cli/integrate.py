"""``gbnbench integrate``: the variance of integrals estimated by point sets."""

from __future__ import annotations

import dataclasses
import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gbnbench.cli import options
from gbnbench.cli.executor_option import executor
from gbnbench.cli.json_text import json_text
from gbnbench.cli.undrawn import undrawn

if TYPE_CHECKING:
    from gbnbench.analysis.integration.integrands.protocol import Family
    from gbnbench.io.points import ReadingOptions

EPILOG = """\b
Examples:
  gbnbench integrate                                    random, jittered, sobol, gbn in 2D
  gbnbench integrate gbn sobol -d 8 -n 64,256,1024
  gbnbench integrate gbn mine.txt --integrand ball --integrand 'genz[kind=continuous]'
  gbnbench integrate --list                             every family of integrands, with its settings

\b
Generators are those of gbnbench compare; files and folders bring their own n, d and sets.
"""


def _list(context: click.Context, _: click.Parameter, asked: bool) -> None:
    if not asked:
        return
    from gbnbench.analysis.integration.integrands.registry import FAMILIES
    from gbnbench.core.text_table import aligned

    for line in aligned(
        ("family", "periodic", "what"),
        [
            (_settings(family()), "yes" if family.periodic else "no", family.summary)
            for family in FAMILIES.values()
        ],
    ):
        click.echo(line)
    context.exit()


def _settings(family: Family) -> str:
    """Write a family with all of its settings."""
    values = dataclasses.asdict(family)  # type: ignore[call-overload]
    inside = ",".join(f"{name}={'auto' if value is None else value}" for name, value in values.items())
    return f"{family.name}[{inside}]" if inside else family.name


@click.command(cls=options.Command, epilog=EPILOG)
@click.argument("sources", nargs=-1)
@click.option(
    "-n",
    "n",
    type=options.WholeNumbers(),
    default="16,64,256,1024",
    show_default=True,
    help="Points in a set.",
)
@click.option("-d", "d", type=options.WholeNumbers(), default="2", show_default=True, help="Dimensions.")
@click.option(
    "--integrand", "integrands", multiple=True, metavar="FAMILY",
    help="Family of integrands, with or without settings; may be given several times.  [default: gaussians, "
    "half-space]",
)  # fmt: skip
@click.option(
    "--instances", type=click.IntRange(1), default=100, show_default=True, help="Integrands of each family."
)
@click.option(
    "--shifts", type=click.IntRange(0), default=0, show_default=True,
    help="Random toroidal shifts of each set; 0 takes the sets as they are.",
)  # fmt: skip
@click.option(
    "--list", "listed", is_flag=True, is_eager=True, expose_value=False, callback=_list,
    help="List the families of integrands.",
)  # fmt: skip
@options.groups
@options.out_folder("Folder of the results.  [default: runs/NAME, NAME made from the settings]")
@options.reading
@options.realizations(16)
@options.seed
@options.jobs
@executor
@options.json
@options.quiet
@options.device
def integrate(
    sources: tuple[str, ...],
    n: tuple[int, ...],
    d: tuple[int, ...],
    integrands: tuple[str, ...],
    instances: int,
    realizations: int,
    shifts: int,
    seed: int,
    out: Path | None,
    jobs: int | None,
    as_json: bool,
    quiet: bool,
    reading: ReadingOptions,
    groups: tuple[str, ...],
) -> None:
    """Variance of integrals estimated by point sets.

    Integrals are estimated by means over the points of SOURCES, any mix of generators with settings,
    files and folders. Every integrand of a family is estimated with every set. Where a family is
    periodic, the variance that the power spectrum of the points predicts stands beside the one that was
    measured. However a run is stopped, the same command continues it.
    """
    from gbnbench.api.integration import integrate as make
    from gbnbench.cli.integrate_text import as_lines, as_record
    from gbnbench.runs.source_names import double_meanings
    from gbnbench.studies.integration.study import DEFAULT_INTEGRANDS, DEFAULT_SOURCES

    for line in double_meanings(sources):
        click.echo(f"gbnbench: {line}", err=True)
    made = make(
        [*sources, *groups] or DEFAULT_SOURCES,
        n=n,
        d=d,
        realizations=realizations,
        integrands=integrands or DEFAULT_INTEGRANDS,
        instances=instances,
        shifts=shifts,
        seed=seed,
        out=out,
        jobs=jobs,
        quiet=quiet,
        reading=reading,
        pictures=True,
        command=shlex.join(["gbnbench", *sys.argv[1:]]),
    )
    for line in made.skipped:
        click.echo(f"gbnbench: skipped: {line}", err=True)
    if as_json:
        click.echo(json_text(as_record(made.study)))
    else:
        for line in as_lines(made.study):
            click.echo(line)
    if made.undrawn:
        undrawn(made.folder, made.undrawn)
    made.picture()
    kept = f", {made.reused} of {made.pieces} pieces reused" if made.reused else ""
    click.echo(f"{'' if as_json else chr(10)}folder: {made.folder} ({made.seconds:.1f} s{kept})", err=as_json)
