"""``gbnbench figures``: the figures of the paper, made anew."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gbnbench.cli import options
from gbnbench.cli.executor_option import executor
from gbnbench.core.errors import InputError

if TYPE_CHECKING:
    from gbnbench.io.points import ReadingOptions

EPILOG = """\b
Examples:
  gbnbench figures --quick                 all of them, in minutes
  gbnbench figures 3 9 --out paper         two, with the paper's counts
  gbnbench figures 1 8 --quick --sets bnot=folder-of-sets
"""


@click.command(cls=options.Command, epilog=EPILOG)
@click.argument("names", nargs=-1, metavar="[N]...")
@options.out_folder("Folder for pictures and what they are drawn from.", default="figures")
@click.option(
    "--sets", multiple=True, metavar="NAME=PATH",
    help="File or folder of sets by a method of the paper (bnot, kdm, vnc, bluenets, ccvt, step, ...), used "
    "instead of our own.",
)  # fmt: skip
@click.option(
    "--image", "images", multiple=True, metavar="N=IMAGE",
    help="Image for figure 10, 15, 16 or 17, a file or a name such as camera, used instead of our own.",
)  # fmt: skip
@click.option(
    "--no-captions", is_flag=True, help="Leave the captions out of the pictures; captions.md has them too."
)
@options.reading
@options.quick_or_full("Small counts: minutes instead of hours.", default="full")
@options.seed
@options.jobs
@executor
@options.quiet
@options.device
def figures(
    names: tuple[str, ...],
    quick: bool,
    out: Path,
    sets: tuple[str, ...],
    images: tuple[str, ...],
    no_captions: bool,
    seed: int,
    jobs: int | None,
    quiet: bool,
    reading: ReadingOptions,
) -> None:
    """Make the figures of the paper (Ahmed, Ren & Wonka 2022).

    All of them are made, or those numbered N; 'depth' is a figure of our own. Each becomes a PNG and a
    PDF, and the page index.html shows them all. The data behind them are kept in OUT/data: however a run
    is stopped, the same command continues it. Figures 10 and 15 to 17 show images from scikit-image,
    which --image replaces.
    """
    from gbnbench.execution import progress
    from gbnbench.reports.paper.figure import FigureOptions
    from gbnbench.reports.paper.maker import make
    from gbnbench.reports.paper.registry import find
    from gbnbench.reports.paper.user_sets import check_sets

    wanted = find([] if names == ("all",) else names)
    options = FigureOptions("quick" if quick else "full", _given(sets), seed, reading, _images(images))
    check_sets(wanted, options)
    with progress.choose(quiet) as teller:
        if options.scale == "full":
            teller.say(
                "these are the paper's counts, which take hours for all figures; --quick takes minutes. Stop "
                "it at any time: the same command continues from there."
            )
        made = make(wanted, out, options, jobs or os.cpu_count() or 1, teller, not no_captions)
    for one in made:
        click.echo(f"{out / one.stem}.png  {one.figure.title}")
    click.echo(f"page: {out / 'index.html'}")


def _given(sets: tuple[str, ...]) -> dict[str, str]:
    """Read NAME=PATH."""
    found: dict[str, str] = {}
    for text in sets:
        name, equals, path = text.partition("=")
        if not (name and equals and path):
            raise InputError(f"--sets must read NAME=PATH, such as bnot=folder; got {text!r}")
        if not Path(path).exists():
            raise InputError(f"--sets {name}: {path} is neither a file nor a folder")
        if name.lower() in found:
            raise InputError(f"--sets must name each method once; got {name!r} twice")
        found[name.lower()] = path
    return found


def _images(images: tuple[str, ...]) -> dict[str, str]:
    """Read N=IMAGE."""
    from gbnbench.io.images import read_image
    from gbnbench.reports.paper.stippling_requests import IMAGES

    found: dict[str, str] = {}
    for text in images:
        figure, equals, image = text.partition("=")
        if not (equals and image) or figure not in IMAGES:
            numbers = ", ".join(IMAGES)
            raise InputError(f"--image must read N=IMAGE, N being one of {numbers}; got {text!r}")
        read_image(image)  # refuses what is none before any work
        found[figure] = image
    return found
