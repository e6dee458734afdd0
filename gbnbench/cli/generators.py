"""``gbnbench generators``: all listed, one described, and all held against what was published of them."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click

from gbnbench.cli import options
from gbnbench.cli.json_text import json_text
from gbnbench.core.errors import InputError

if TYPE_CHECKING:
    from gbnbench.generators.protocol import Generator

PICTURES = (".png", ".pdf")
EPILOG = """\b
Examples:
  gbnbench generators                          every generator, with family, cost and reference
  gbnbench generators --family cellular
  gbnbench generators lloyd                    its settings, and which n and d it serves
  gbnbench generators 'gbn[sigma=0.8]' -o gbn.png
  gbnbench generators --verify --only fpo      held against published figures, sets, theory: minutes for all
"""


@click.command(cls=options.Command, epilog=EPILOG)
@click.argument("name", required=False)
@click.option("--family", metavar="NAME", help="Only the generators of this family.")
@click.option(
    "--verify",
    "verifying",
    is_flag=True,
    help="Check them against published figures, sets made by others, and theory.",
)
@click.option(
    "--only", multiple=True, metavar="NAME", help="With --verify: only this one; may be given several times."
)
@options.out_file("File to write: with NAME its picture, .png or .pdf; with --verify the table, .md.")
@click.option("-n", "n", type=click.IntRange(1), help="Points of the picture's sets.  [default: 1024]")
@click.option("-d", "d", type=click.IntRange(1), help="Dimension of the picture's sets.  [default: 2]")
@options.realizations(1)
@options.seed
@options.jobs
@options.json
@options.quiet
@options.device
def generators(
    name: str | None, family: str | None, verifying: bool, only: tuple[str, ...], out: Path | None,
    n: int | None, d: int | None, realizations: int, seed: int, jobs: int | None, as_json: bool, quiet: bool,
) -> None:  # fmt: skip
    """Every generator: list, settings, picture, proof.

    Without NAME, all generators are listed, including those of installed packages and those in your own
    file of programs. With NAME, with or without settings, one generator is described: what it does, what
    its settings mean, and which n and d it serves.
    """
    if name is not None and (family is not None or verifying):
        raise click.UsageError("a name goes with neither --family nor --verify: leave one out")
    if only and not verifying:
        raise click.UsageError("--only goes with --verify")
    if (n is not None or d is not None) and (name is None or out is None):
        raise click.UsageError("-n and -d are those of a picture: name a generator, and a file by --out")
    if verifying:
        _verify(only, family, out, jobs, as_json, quiet)
    elif name is not None:
        _describe(name, out, n or 1024, d or 2, realizations, seed, as_json)
    elif out is not None:
        raise click.UsageError("--out goes with the name of a generator, or with --verify")
    else:
        _list(family, as_json)


def _list(family: str | None, as_json: bool) -> None:
    from gbnbench.cli.generators_text import list_lines
    from gbnbench.generators.listing import generator_entries, record

    entries, faults = generator_entries(family)
    if as_json:
        click.echo(json_text([record(one) for one in entries]))
    else:
        for line in list_lines(entries):
            click.echo(line)
    for fault in faults:
        click.echo(f"gbnbench: warning: {fault}", err=True)


def _describe(
    name: str, out: Path | None, n: int, d: int, realizations: int, seed: int, as_json: bool
) -> None:
    from gbnbench.cli.generators_text import description_lines, description_record
    from gbnbench.generators.description import describe
    from gbnbench.generators.listing import entry, origin_of
    from gbnbench.generators.registry import find

    generator = find(name)
    kind = type(generator)
    one, description = entry(kind, origin_of(kind)), describe(generator)
    if out is not None and out.suffix.lower() not in PICTURES:
        raise InputError(f"{out}: pictures are written as {', '.join(PICTURES)}; got {out.suffix!r}")
    if as_json:
        click.echo(json_text(description_record(one, description)))
    else:
        for line in description_lines(one, description):
            click.echo(line)
    if out is not None:
        _draw(generator, out, n, d, realizations, seed, as_json)


def _draw(
    generator: Generator, out: Path, n: int, d: int, realizations: int, seed: int, as_json: bool
) -> None:
    """Write the picture of a generator, whole or not at all, and say so."""
    from gbnbench.api.portrait import portrait
    from gbnbench.io.points.writer import write_atomically
    from gbnbench.reports.comparison import figure_files

    figure = portrait(generator, n=n, d=d, realizations=realizations, seed=seed)
    encode = figure_files.png if out.suffix.lower() == ".png" else figure_files.pdf
    replaced = ", replacing what was there" if out.exists() else ""
    write_atomically(out, encode(figure))
    click.echo(f"wrote {out}{replaced}", err=as_json)


def _verify(
    only: tuple[str, ...], family: str | None, out: Path | None, jobs: int | None, as_json: bool, quiet: bool
) -> None:
    from gbnbench.cli.generators_text import verified_lines, verified_record
    from gbnbench.execution import progress
    from gbnbench.io.points.writer import write_atomically
    from gbnbench.verification.choice import chosen_figures
    from gbnbench.verification.page import markdown
    from gbnbench.verification.run import verify_all

    if out is not None and out.suffix.lower() != ".md":
        raise InputError(f"{out}: the table is written as .md; got {out.suffix!r}")
    figures = chosen_figures(only, family)
    with progress.choose(quiet or as_json) as shown:
        found = verify_all(figures, jobs=jobs, progress=shown)
    if as_json:
        click.echo(json_text([verified_record(one) for one in found]))
    else:
        for line in verified_lines(found):
            click.echo(line)
    if out is not None:
        write_atomically(out, markdown(found).encode())
        click.echo(f"wrote {out}", err=as_json)
    if not all(one.agrees for one in found):
        click.get_current_context().exit(1)
