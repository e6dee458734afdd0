"""Input of ``gbnbench stipple``: options checked, colours, the image as inks, the number of dots."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Literal

import click
from click.core import ParameterSource

from gbnbench.core.errors import InputError

if TYPE_CHECKING:
    from gbnbench.api.page_style import PageStyle
    from gbnbench.studies.stippling.darkness import Darkness, ToneCurve

MOST_BY_SIZE = 1_000_000  # dots that are drawn without being asked for by their number


@dataclass(frozen=True)
class PageOptions:
    """Options of the page, as the command takes them.

    Attributes
    ----------
    width_mm, margin_mm, dot_mm, dpi : float or None
        Of the page, its margin, dots and pixels.
    dots : {"equal", "tone"}
        Sizes of dots.
    paper, ink : str or None
        Colours.
    """

    width_mm: float
    margin_mm: float | None
    dots: Literal["equal", "tone"]
    dot_mm: float | None
    dpi: float | None
    paper: str | None
    ink: str | None


def check(
    image: str, out: Path, page: PageOptions, *, inks: bool, order: str, progressive: bool,
    template: Path | None,
) -> None:  # fmt: skip
    """Refuse what cannot be written, before any work.

    Parameters
    ----------
    image : str
        As the command takes it.
    out : Path
        The file.
    page : PageOptions
        The page.
    inks : bool
        Whether there are several inks.
    order, progressive, template
        As the command takes them.

    Raises
    ------
    click.UsageError
        If options contradict one another, or mean nothing to the file.
    InputError
        If the suffix of ``out`` names nothing that is written.
    """
    from gbnbench.api.stippled_page import ANIMATIONS, TEXTS, check_picture

    check_picture(out)
    suffix = out.suffix.lower()
    if out.exists() and Path(image).exists() and out.samefile(image):
        raise click.UsageError(f"{out} is the image itself: name another file")
    for name, value in (("--width-mm", page.width_mm), ("--dot-mm", page.dot_mm)):
        if value is not None and not (math.isfinite(value) and value > 0):
            raise click.UsageError(f"{name} must be above 0; got {value}")
    if page.margin_mm is not None and not 0 <= page.margin_mm < page.width_mm / 2:
        raise click.UsageError(
            f"--margin-mm must be at least 0 and less than half of --width-mm, {page.width_mm / 2:g}; "
            f"got {page.margin_mm:g}"
        )
    if page.dot_mm is not None and page.dot_mm >= page.width_mm:
        raise click.UsageError(
            f"--dot-mm {page.dot_mm:g} is as wide as the page or wider, which has {page.width_mm:g} mm"
        )
    if page.dot_mm is not None and page.dots == "tone":
        raise click.UsageError("--dot-mm is of dots of one size: leave out --dots tone")
    if template is not None and suffix != ".gcode":
        raise click.UsageError(f"--gcode-template goes with -o FILE.gcode; got {out}")
    if page.dpi is not None and suffix != ".png" and suffix not in ANIMATIONS:
        raise click.UsageError(f"--dpi is for pixels, which .png, .gif and .mp4 have: leave it out for {out}")
    if order == "tour" and progressive:
        raise click.UsageError("--progressive is an order of the dots, and so is --order tour: leave out one")
    if order == "tour" and suffix in ANIMATIONS:
        raise click.UsageError(f"--order tour is not to be seen in {out}: leave it out")
    if suffix in TEXTS and (useless := _without_effect(page)):
        raise click.UsageError(f"{out} holds points and no page: leave out {' and '.join(useless)}")
    given = [
        f"--{name.replace('_', '-')}"
        for name in ("margin_mm", "paper", "ink")
        if getattr(page, name) is not None
    ]
    if given and suffix in TEXTS:
        raise click.UsageError(f"{out} holds points and no page: leave out {' and '.join(given)}")
    if page.paper is not None and suffix == ".gcode":
        raise click.UsageError(f"{out} is drawn on the paper that lies there: leave out --paper")
    if inks and (page.paper is not None or page.ink is not None):
        raise click.UsageError("--paper and --ink are of one ink; several are mixed for white paper")


def _without_effect(page: PageOptions) -> list[str]:
    """Sizes that were given and change no points: with -n nothing follows from them."""
    context = click.get_current_context(silent=True)
    counted = context is not None and context.params.get("n") is not None
    useless = ["--dot-mm"] if page.dot_mm is not None and counted else []
    given = context is not None and context.get_parameter_source("width_mm") is not ParameterSource.DEFAULT
    return ["--width-mm", *useless] if given and (counted or page.dot_mm is None) else useless


def colours(page: PageOptions, *, invert: bool) -> tuple[str, str]:
    """Choose the colours of paper and ink.

    Parameters
    ----------
    page : PageOptions
        The page.
    invert : bool
        Whether dots are dense where the image is light: then they are white on black unless said otherwise.

    Returns
    -------
    paper : str
        ``#rrggbb``.
    ink : str
        The same, or ``black`` or ``white``: the name of the layer.

    Raises
    ------
    InputError
        If one is no colour, or both are the same.
    """
    from gbnbench.studies.stippling.colours import luma, read_colour

    paper = read_colour(page.paper or ("black" if invert else "white"))
    ink = read_colour(page.ink or ("white" if luma(paper) < 0.5 else "black"))  # fmt: skip
    if ink == paper:
        raise InputError(f"ink and paper are both {ink}: dots would not be seen")
    if (luma(ink) > luma(paper)) != invert:
        darker, dense, change = ("darker", "light", "leave out") if invert else ("lighter", "dark", "add")
        click.echo(
            f"gbnbench: the picture is a negative: dots are {darker} than the paper and dense where the "
            f"image is {dense}; {change} --invert for the image itself",
            err=True,
        )
    return paper, {"#000000": "black", "#ffffff": "white"}.get(ink, ink)


def darkness(
    source: str, curve: ToneCurve, colour: str | None, palette: str | None, seed: int, ink: str
) -> dict[str, Darkness]:
    """Find what is to be stippled.

    Parameters
    ----------
    source : str
        The image.
    curve : ToneCurve
        From tones to darkness.
    colour, palette : str or None
        As the command takes them.
    seed : int
        With which a palette is found.
    ink : str
        Name of the ink where there is one.

    Returns
    -------
    dict of str to Darkness
        By the names of the inks, in the order of printing.

    Raises
    ------
    click.UsageError
        If a palette goes with other inks.
    InputError
        If this is no image to be drawn so, or nothing is dark.
    """
    from gbnbench.io.images import read_image
    from gbnbench.studies.stippling.darkness import as_darkness
    from gbnbench.studies.stippling.inks import ink_darkness
    from gbnbench.studies.stippling.palette import FOUND, found_palette, palette_darkness, read_palette

    if colour == "cmyk":
        if palette is not None:
            raise click.UsageError("--palette has inks of its own: leave out --colour cmyk")
        return ink_darkness(read_image(source), curve)
    if colour == "palette" or palette is not None:
        inks = FOUND if palette is None else read_palette(palette)
        image = read_image(source)
        return palette_darkness(
            image, found_palette(image, inks, seed) if isinstance(inks, int) else inks, curve
        )
    found = as_darkness(source, curve=curve)
    if found.values.ndim != 2:
        raise InputError(f"{source} is a volume: gbnbench.stipple takes it, the command draws images")
    found.density()  # refuses what is white everywhere
    return {ink: found}


def default_n(inks: dict[str, Darkness], style: PageStyle) -> int:
    """Count dots: those that show the pixels, or those of a size that cover what is dark.

    Parameters
    ----------
    inks : dict of str to Darkness
        What is to be drawn.
    style : PageStyle
        How they lie on the page.

    Returns
    -------
    int
        At least one an ink.

    Raises
    ------
    click.UsageError
        If there are more than ``MOST_BY_SIZE`` of a size.
    """
    from gbnbench.studies.stippling.darkness import MOST_POINTS

    if style.dot_mm is None:
        wanted = min(MOST_POINTS, sum(one.default_n for one in inks.values()))
    else:
        pixel, _ = style.placing(next(iter(inks.values())).values.shape[1], 0)
        covered = sum(float(one.values.sum()) for one in inks.values()) * pixel**2
        wanted = round(covered / (math.pi / 4 * style.dot_mm**2))
        if wanted > MOST_BY_SIZE:
            raise click.UsageError(
                f"the picture takes {wanted:,} dots of {style.dot_mm:g} mm: make them larger, or give -n"
            )
    return max(len(inks), wanted)
