"""``gbnbench stipple``: an image as dots, for the screen, for print and for plotters."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import click

from gbnbench.cli import options
from gbnbench.cli.late_progress import late_progress
from gbnbench.core.errors import InputError

if TYPE_CHECKING:
    from gbnbench.api.stippling import Stippling
    from gbnbench.io.images import Image
    from gbnbench.studies.stippling.darkness import Darkness, ToneCurve

EPILOG = """\b
Examples:
  gbnbench stipple camera -o camera.png                           an image of scikit-image's by its name
  gbnbench stipple photo.jpg -n 20000 -o photo.svg --order tour   for a plotter, 160 mm wide
  gbnbench stipple photo.jpg -o photo.pdf --colour cmyk           a layer an ink
  gbnbench stipple moon -o moon.csv --invert                      light is dense; x, y and amplitude
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
    "File to write, replacing any: .png, .svg, .pdf, .eps, .gcode, or .txt and .csv with amplitudes.",
    required=True,
)
@click.option("--method", default="gbn", show_default=True, help="Generator, such as 'gbn[sigma=0.85]'.")
@click.option("--invert", is_flag=True, help="Light is dense, for white ink on black.")
@click.option(
    "--gamma",
    type=float,
    default=1.0,
    show_default=True,
    help="Exponent of the tones; 2.2 takes them as light, with denser mid-tones.",
)
@click.option("--white-cutoff", type=float, help="Tone, 0 to 1, from which on there are no dots.")
@click.option("--toroidal", is_flag=True, help="Opposite borders meet, for tiles.")
@click.option("--colour", type=click.Choice(["cmyk"]), help="A layer an ink, each dotted by itself.")
@click.option("--width-mm", type=float, default=160.0, show_default=True, help="Width of the page.")
@click.option(
    "--dots",
    type=click.Choice(["equal", "tone"]),
    default="equal",
    show_default=True,
    help="Dots of one size, denser in the dark; or also larger there.",
)
@click.option("--dot-mm", type=float, help="Diameter of all dots.  [default: they cover what is dark]")
@click.option("--dpi", type=float, default=300.0, show_default=True, help="Pixels an inch of a .png.")
@click.option(
    "--order",
    type=click.Choice(["drawn", "tour"]),
    default="drawn",
    show_default=True,
    help="Order of the dots; tour is a short path for plotters, and its length is told.",
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
    toroidal: bool, colour: str | None, width_mm: float, dots: Literal["equal", "tone"],
    dot_mm: float | None, dpi: float, order: str, gcode_template: Path | None, preview: bool, seed: int,
    quiet: bool,
) -> None:  # fmt: skip
    """Draw an image by dots whose density follows its tones.

    IMAGE is a file (PNG, JPEG, TIFF and what else Pillow reads, or an array as .npy), or the name of an image
    of scikit-image's such as camera, coins or astronaut.
    """
    from gbnbench.api.stipple import draw
    from gbnbench.api.stippled_page import in_tour_order, page_of, write_stippling
    from gbnbench.cli.generate import check_folder
    from gbnbench.generators.adaptive.registry import adaptive_generator
    from gbnbench.reports.stippling.gcode import read_template
    from gbnbench.reports.stippling.page import Page
    from gbnbench.reports.stippling.png import picture_size
    from gbnbench.studies.stippling.darkness import ToneCurve
    from gbnbench.studies.stippling.inks import shared_out

    _check(image, out, width_mm, dots, dot_mm, gcode_template)
    check_folder(out)
    template = None if gcode_template is None else read_template(gcode_template)
    generator = adaptive_generator(method)
    darkness = _darkness(image, ToneCurve(invert, gamma, white_cutoff), colour)
    for remark in dict.fromkeys(remark for one in darkness.values() for remark in one.remarks):
        click.echo(f"gbnbench: {remark}", err=True)
    rows, columns = next(iter(darkness.values())).values.shape
    sheet = Page(width_mm, width_mm * rows / columns, ())
    if out.suffix.lower() == ".png":
        picture_size(sheet, dpi)
    count = n if n is not None else _default_n(darkness, width_mm, dot_mm)
    drawn: dict[str, Stippling] = {}
    for k, (ink, share) in enumerate(shared_out(darkness, count).items()):
        dark = darkness[ink]
        with late_progress(quiet) as told:
            made = draw(
                dark if dots == "equal" else replace(dark, values=dark.values**0.5), share, method=generator,
                seed=seed, realization=k, toroidal=toroidal, progress=told,
            )  # fmt: skip
        made = replace(made, coverage=dark.coverage)
        if order == "tour":
            made, length = in_tour_order(made)
            told_length = length * width_mm / made.size[0]
            click.echo(f"tour of {ink}: {told_length / 1000:.4g} m")
        drawn[ink] = made
    replaced = ", replacing what was there" if out.exists() else ""
    write_stippling(out, drawn, width_mm=width_mm, dots=dots, dot_mm=dot_mm, dpi=dpi, template=template)
    if preview:
        from gbnbench.cli.braille import braille

        click.echo(braille(drawn.values()))
    counts = ", ".join(f"{len(made.points):,} dots of {ink}" for ink, made in drawn.items())
    page = page_of(drawn, width_mm=width_mm, dots=dots, dot_mm=dot_mm)
    sizes = sorted({round(2 * r, 3) for layer in page.layers for r in (layer.radii.min(), layer.radii.max())})
    across = f"{sizes[0]:g}" if len(sizes) == 1 else f"{sizes[0]:g} to {sizes[-1]:g}"
    click.echo(
        f"wrote {out}: {counts}, {across} mm across, on {sheet.width:g} x {sheet.height:.4g} mm{replaced}"
    )


def _check(
    image: str, out: Path, width_mm: float, dots: str, dot_mm: float | None, template: Path | None
) -> None:
    """Refuse what cannot be written before any work."""
    from gbnbench.api.stippled_page import check_picture

    check_picture(out)
    if out.exists() and Path(image).exists() and out.samefile(image):
        raise click.UsageError(f"{out} is the image itself: name another file")
    for name, value in (("--width-mm", width_mm), ("--dot-mm", dot_mm)):
        if value is not None and not (math.isfinite(value) and value > 0):
            raise click.UsageError(f"{name} must be above 0; got {value}")
    if dot_mm is not None and dots == "tone":
        raise click.UsageError("--dot-mm is of dots of one size: leave out --dots tone")
    if template is not None and out.suffix.lower() != ".gcode":
        raise click.UsageError(f"--gcode-template goes with -o FILE.gcode; got {out}")


def _darkness(source: str, curve: ToneCurve, colour: str | None) -> dict[str, Darkness]:
    """Find what is to be stippled, by the names of the inks."""
    from gbnbench.io.images import read_image
    from gbnbench.studies.stippling.darkness import as_darkness
    from gbnbench.studies.stippling.inks import ink_darkness

    if colour is not None:
        image: Image = read_image(source)
        return ink_darkness(image, curve)
    found = as_darkness(source, curve=curve)
    if found.values.ndim != 2:
        raise InputError(f"{source} is a volume: gbnbench.stipple takes it, the command draws images")
    found.density()  # refuses what is white everywhere
    return {"black": found}


def _default_n(darkness: dict[str, Darkness], width_mm: float, dot_mm: float | None) -> int:
    """Count dots: those that show the pixels, or those of a size that cover what is dark."""
    from gbnbench.studies.stippling.darkness import MOST_POINTS

    if dot_mm is None:
        wanted = min(MOST_POINTS, sum(one.default_n for one in darkness.values()))
    else:
        pixel = width_mm / next(iter(darkness.values())).values.shape[1]
        covered = sum(float(one.values.sum()) for one in darkness.values()) * pixel**2
        wanted = round(covered / (math.pi / 4 * dot_mm**2))
    return max(len(darkness), wanted)
