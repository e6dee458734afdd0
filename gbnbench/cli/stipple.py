"""``gbnbench stipple``: an image as dots, for the screen, for print and for plotters."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Literal

import click

from gbnbench.cli import options
from gbnbench.cli.executor_option import executor
from gbnbench.cli.late_progress import late_progress
from gbnbench.core.atomic_write import check_folder

if TYPE_CHECKING:
    from gbnbench.cli.stipple_drawing import StippleOptions

EPILOG = """\b
Examples:
  gbnbench stipple camera -o camera.png                           an image of scikit-image's by its name
  gbnbench stipple photo.jpg -n 20000 -o photo.svg --order tour   for a plotter, 160 mm wide
  gbnbench stipple photo.jpg -o photo.pdf --colour cmyk           one layer for each ink
  gbnbench stipple photo.jpg -o photo.svg --palette '#d00,#08c,#000'
  gbnbench stipple camera -o camera.gif --progressive             dot by dot
  gbnbench stipple moon -o moon.png --invert                      white dots on black
  gbnbench stipple photos/*.jpg -o dots/ --format svg             each into the folder, by all cores
"""


@click.command(cls=options.Command, epilog=EPILOG)
@click.argument("images", metavar="IMAGE...", nargs=-1, required=True)
@click.option(
    "-n",
    "n",
    type=click.IntRange(1),
    help="Number of dots.  [default: one for 2.5 x 2.5 black pixels, at most 20,000; with --dot-mm, by "
    "coverage]",
)
@click.option(
    "-o", "--out", metavar="FILE", required=True,
    help="File to write; one that exists is replaced. .png, .svg, .pdf, .eps, .gcode; .txt and .csv with "
    "amplitudes; .gif and .mp4 show how the picture forms. For several images, a folder.",
)  # fmt: skip
@click.option(
    "--format", "file_format", metavar="SUFFIX", help="Format of the files in a folder.  [default: png]"
)
@click.option("--method", default="gbn", show_default=True, help="Generator, such as 'gbn[sigma=0.85]'.")
@click.option("--invert", is_flag=True, help="Draw white dots on black, dense where the image is light.")
@click.option(
    "--gamma",
    type=float,
    default=1.0,
    show_default=True,
    help="Exponent of the tones. 2.2 turns tones into the light they stand for: mid-tones become denser, "
    "with --invert sparser.",
)
@click.option(
    "--white-cutoff",
    type=float,
    help="Tone, 0 to 1, from which on there are no dots; with --invert, where the paper is black, there are "
    "none from 1 minus this tone downwards.",
)
@click.option(
    "--toroidal",
    is_flag=True,
    help="Opposite borders meet, for tiles; a dot that crosses a border is drawn at both.",
)
@click.option(
    "--colour",
    type=click.Choice(["cmyk", "palette"]),
    help="One layer for each ink; with gbn each ink is blue noise, and so are all inks together.",
)
@click.option(
    "--palette",
    metavar="COLOURS",
    help="Inks, such as '#d00,#08c,#000', or how many to find in the image.  [default: 4 with --colour "
    "palette]",
)
@click.option("--width-mm", type=float, default=160.0, show_default=True, help="Width of the page.")
@click.option(
    "--margin-mm",
    type=float,
    help="Blank paper on each side.  [default: half a dot, so that none hangs over the border]",
)
@click.option(
    "--paper",
    metavar="COLOUR",
    help="Colour of the paper, as #rgb, #rrggbb or a CSS name.  [default: white; with --invert black]",
)
@click.option("--ink", metavar="COLOUR", help="Colour of one ink.  [default: black; on dark paper white]")
@click.option(
    "--dots",
    type=click.Choice(["equal", "tone"]),
    default="equal",
    show_default=True,
    help="Dots of one size, denser in the dark; or dots that are larger there too.",
)
@click.option(
    "--dot-mm", type=float, help="Diameter of all dots.  [default: such that they cover what is dark]"
)
@click.option(
    "--dpi", type=float, help="Pixels per inch of a .png, .gif or .mp4.  [default: 300 for .png, else 100]"
)
@click.option(
    "--order",
    type=click.Choice(["drawn", "tour"]),
    default="drawn",
    show_default=True,
    help="Order of the dots; tour is a short path for plotters, and its length is printed.",
)
@click.option(
    "--progressive", is_flag=True, help="Order the dots so that the first ones, however many, draw the image."
)
@click.option(
    "--frames",
    type=click.IntRange(1),
    help="Frames of a .gif or .mp4: dots finding their places, or with --progressive more and more.  "
    "[default: 60]",
)
@click.option(
    "--gcode-template",
    type=click.Path(path_type=Path, dir_okay=False),
    help="TOML file with the lines start, layer, move, down, up and end of a .gcode.",
)
@click.option("--preview", is_flag=True, help="Show the dots in the terminal, as Braille.")
@options.seed
@options.jobs
@executor
@options.quiet
@options.device
def stipple(
    images: tuple[str, ...], n: int | None, out: str, file_format: str | None, method: str, invert: bool,
    gamma: float, white_cutoff: float | None, toroidal: bool, colour: str | None, palette: str | None,
    width_mm: float, margin_mm: float | None, paper: str | None, ink: str | None,
    dots: Literal["equal", "tone"], dot_mm: float | None, dpi: float | None, order: str, progressive: bool,
    frames: int | None, gcode_template: Path | None, preview: bool, seed: int, jobs: int | None, quiet: bool,
) -> None:  # fmt: skip
    """Draw an image by dots whose density follows its tones.

    An IMAGE is a file (PNG, JPEG, TIFF or any other format that Pillow reads, or an array as .npy), or
    the name of an image in scikit-image such as camera, coins or astronaut. Several images are drawn into
    a folder by worker processes. One that cannot be drawn does not keep the others from being drawn, and
    if the command is stopped, the same command continues it.
    """
    from gbnbench.cli import stipple_files, stipple_input
    from gbnbench.cli.stipple_batch import stipple_folder
    from gbnbench.cli.stipple_drawing import StippleOptions
    from gbnbench.generators.adaptive.registry import adaptive_generator
    from gbnbench.reports.stippling.gcode import read_template
    from gbnbench.studies.stippling.darkness import ToneCurve

    page = stipple_input.PageOptions(width_mm, margin_mm, dots, dot_mm, dpi, paper, ink)
    first, *others = images
    many = bool(others) or stipple_files.is_folder(out)
    if many:
        files = stipple_files.files_of(images, out, file_format)
        stipple_files.check(out, frames, preview=preview)
    else:
        files = {first: stipple_files.file_of(out, file_format)}
    for image, file in files.items():
        stipple_input.check(
            image, file, page, inks=colour is not None or palette is not None, order=order,
            progressive=progressive, template=gcode_template,
        )  # fmt: skip
    template = None if gcode_template is None else read_template(gcode_template)
    generator = adaptive_generator(method)
    curve = ToneCurve(invert, gamma, white_cutoff)
    on, layer = stipple_input.colours(page, invert=invert)
    given = StippleOptions(
        n, generator, curve, toroidal, progressive, colour, palette, order, page, on, layer, template, seed
    )
    if many:
        stipple_folder(files, given, jobs, quiet=quiet)
    else:
        _stipple_one(first, files[first], given, frames, preview=preview, quiet=quiet)


def _stipple_one(
    image: str, out: Path, given: StippleOptions, frames: int | None, *, preview: bool, quiet: bool
) -> None:
    """Draw one image in this process, and say what was drawn."""
    from gbnbench.api.stippled_frames import FormingDots
    from gbnbench.api.stippled_page import write_stippling
    from gbnbench.cli.stipple_drawing import drawn, planned
    from gbnbench.cli.stipple_frames import checked_frames, write_animation

    check_folder(out)
    plan = planned(image, given, out.suffix.lower())
    for remark in plan.remarks:
        click.echo(f"gbnbench: {remark}", err=True)
    moving = checked_frames(
        out, frames, plan.sheet, given.page.dpi, given.generator, plan.counts, progressive=given.progressive
    )
    kept = FormingDots(moving.steps, moving.frames) if moving is not None and moving.steps else None
    with late_progress(quiet) as told, late_progress(quiet) as ordering:
        made = drawn(plan, given, told, kept, ordering)
    for tour in made.tours(out.suffix.lower()):
        click.echo(tour)
    replaced = ", replacing what was there" if out.exists() else ""
    if moving is None:
        write_stippling(out, made.layers, plan.style, dpi=given.dpi, template=given.template)
    else:
        write_animation(out, made.page, moving, kept, made.mm, quiet=quiet)
    if preview:
        from gbnbench.cli.braille import braille

        click.echo(braille(made.layers.values()))
    click.echo(f"wrote {out}: {made.summary(out.suffix.lower())}{replaced}")
