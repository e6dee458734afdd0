"""``gbnbench stipple``: an image as dots, for the screen, for print and for plotters."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Literal

import click

from gbnbench.cli import options
from gbnbench.cli.late_progress import late_progress
from gbnbench.core.atomic_write import check_folder

EPILOG = """\b
Examples:
  gbnbench stipple camera -o camera.png                           an image of scikit-image's by its name
  gbnbench stipple photo.jpg -n 20000 -o photo.svg --order tour   for a plotter, 160 mm wide
  gbnbench stipple photo.jpg -o photo.pdf --colour cmyk           a layer an ink
  gbnbench stipple photo.jpg -o photo.svg --palette '#d00,#08c,#000'
  gbnbench stipple camera -o camera.gif --progressive             dot by dot
  gbnbench stipple moon -o moon.png --invert                      white dots on black
"""


@click.command(cls=options.Command, epilog=EPILOG)
@click.argument("image")
@click.option(
    "-n",
    "n",
    type=click.IntRange(1),
    help="Dots.  [default: one for 2.5 x 2.5 pixels of black, 20,000 at most; with --dot-mm by coverage]",
)
@options.out_file(
    "File to write, replacing any: .png, .svg, .pdf, .eps, .gcode; .txt and .csv with amplitudes; "
    ".gif and .mp4 of how it forms.",
    required=True,
)
@click.option("--method", default="gbn", show_default=True, help="Generator, such as 'gbn[sigma=0.85]'.")
@click.option("--invert", is_flag=True, help="Light is dense; dots are white on black.")
@click.option(
    "--gamma",
    type=float,
    default=1.0,
    show_default=True,
    help="Exponent of the tones; 2.2 takes them as light: denser mid-tones, with --invert sparser.",
)
@click.option(
    "--white-cutoff",
    type=float,
    help="Tone, 0 to 1, from which on there are no dots; with --invert, on black paper, no dots at 1 less "
    "that or darker.",
)
@click.option(
    "--toroidal",
    is_flag=True,
    help="Opposite borders meet, for tiles; in pictures dots that cross one are drawn at both.",
)
@click.option(
    "--colour",
    type=click.Choice(["cmyk", "palette"]),
    help="A layer an ink; with gbn each ink is blue noise and so are all together.",
)
@click.option(
    "--palette",
    metavar="COLOURS",
    help="Inks, such as '#d00,#08c,#000', or how many to find in the image; 4 with --colour palette.",
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
    help="Colour of the paper, as #rgb, #rrggbb or a name of CSS.  [default: white; with --invert black]",
)
@click.option("--ink", metavar="COLOUR", help="Colour of one ink.  [default: black; on dark paper white]")
@click.option(
    "--dots",
    type=click.Choice(["equal", "tone"]),
    default="equal",
    show_default=True,
    help="Dots of one size, denser in the dark; or also larger there.",
)
@click.option("--dot-mm", type=float, help="Diameter of all dots.  [default: they cover what is dark]")
@click.option(
    "--dpi", type=float, help="Pixels an inch of a .png, .gif or .mp4.  [default: 300; moving, 100]"
)
@click.option(
    "--order",
    type=click.Choice(["drawn", "tour"]),
    default="drawn",
    show_default=True,
    help="Order of the dots; tour is a short path for plotters, and its length is told.",
)
@click.option(
    "--progressive", is_flag=True, help="Order the dots so that the first ones of any number draw it."
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
    help="TOML with lines start, layer, move, down, up and end for .gcode.",
)
@click.option("--preview", is_flag=True, help="Show the dots in the terminal, as Braille.")
@options.seed
@options.quiet
@options.device
def stipple(
    image: str, n: int | None, out: Path, method: str, invert: bool, gamma: float, white_cutoff: float | None,
    toroidal: bool, colour: str | None, palette: str | None, width_mm: float, margin_mm: float | None,
    paper: str | None, ink: str | None, dots: Literal["equal", "tone"], dot_mm: float | None,
    dpi: float | None, order: str, progressive: bool, frames: int | None, gcode_template: Path | None,
    preview: bool, seed: int, quiet: bool,
) -> None:  # fmt: skip
    """Draw an image by dots whose density follows its tones.

    IMAGE is a file (PNG, JPEG, TIFF and what else Pillow reads, or an array as .npy), or the name of an image
    of scikit-image's such as camera, coins or astronaut.
    """
    from gbnbench.api.drawing import draw_inks, in_progressive_order
    from gbnbench.api.page_style import PageStyle, page_of
    from gbnbench.api.stippled_frames import FormingDots
    from gbnbench.api.stippled_page import in_tour_order, write_stippling
    from gbnbench.cli import stipple_input
    from gbnbench.cli.stipple_frames import checked_frames, write_animation
    from gbnbench.cli.stipple_text import summary
    from gbnbench.generators.adaptive.registry import adaptive_generator
    from gbnbench.reports.stippling.gcode import read_template
    from gbnbench.reports.stippling.page import Page
    from gbnbench.reports.stippling.png import picture_size
    from gbnbench.studies.stippling.darkness import ToneCurve
    from gbnbench.studies.stippling.inks import shared_out

    given = stipple_input.PageOptions(width_mm, margin_mm, dots, dot_mm, dpi, paper, ink)
    stipple_input.check(
        image, out, given, inks=colour is not None or palette is not None, order=order,
        progressive=progressive, template=gcode_template,
    )  # fmt: skip
    check_folder(out)
    template = None if gcode_template is None else read_template(gcode_template)
    generator = adaptive_generator(method)
    curve = ToneCurve(invert, gamma, white_cutoff)
    on, layer = stipple_input.colours(given, invert=invert)
    darkness = stipple_input.darkness(image, curve, colour, palette, seed, layer)
    for remark in dict.fromkeys(remark for one in darkness.values() for remark in one.remarks):
        click.echo(f"gbnbench: {remark}", err=True)
    rows, columns = next(iter(darkness.values())).values.shape
    sheet = Page(width_mm, width_mm * rows / columns, ())
    style = PageStyle(width_mm, 0.0 if toroidal and margin_mm is None else margin_mm, dots, dot_mm, on)
    counts = shared_out(darkness, n if n is not None else stipple_input.default_n(darkness, style))
    moving = checked_frames(out, frames, sheet, dpi, generator, counts, progressive=progressive)
    if out.suffix.lower() == ".png":
        picture_size(sheet, 300 if dpi is None else dpi)
    kept = FormingDots(moving.steps, moving.frames) if moving is not None and moving.steps else None
    wanted = {
        name: dark if dots == "equal" else replace(dark, values=dark.values**0.5)
        for name, dark in darkness.items()
    }
    with late_progress(quiet) as told:
        drawn = draw_inks(
            wanted, counts, method=generator, seed=seed, toroidal=toroidal, progress=told, seen=kept
        )
    lengths = {}
    for name, made in drawn.items():
        placed = replace(made, coverage=darkness[name].coverage)
        if progressive:
            with late_progress(quiet) as told:
                placed = in_progressive_order(placed, told)
        elif order == "tour":
            placed, lengths[name] = in_tour_order(placed)
        drawn[name] = placed
    replaced = ", replacing what was there" if out.exists() else ""
    page = page_of(drawn, style)
    mm = (page.width - 2 * page.margin) / columns
    for name, length in lengths.items():
        click.echo(f"tour of {name}: {length * mm / 1000:.4g} m")
    if moving is None:
        write_stippling(out, drawn, style, dpi=300 if dpi is None else dpi, template=template)
    else:
        write_animation(out, page, moving, kept, mm, quiet=quiet)
    if preview:
        from gbnbench.cli.braille import braille

        click.echo(braille(drawn.values()))
    click.echo(f"wrote {out}: {summary(page)}{replaced}")
