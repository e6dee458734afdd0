"""Input of ``gbnbench stipple``: options checked, the image as inks, the number of dots."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING

import click

from gbnbench.core.errors import InputError

if TYPE_CHECKING:
    from gbnbench.studies.stippling.darkness import Darkness, ToneCurve

MOST_BY_SIZE = 1_000_000  # dots that are drawn without being asked for by their number


def check(
    image: str, out: Path, width_mm: float, dots: str, dot_mm: float | None, template: Path | None
) -> None:
    """Refuse what cannot be written, before any work.

    Parameters
    ----------
    image, out, width_mm, dots, dot_mm, template
        As the command takes them.

    Raises
    ------
    click.UsageError
        If options contradict one another.
    InputError
        If the suffix of ``out`` names nothing that is written.
    """
    from gbnbench.api.stippled_page import check_picture

    check_picture(out)
    if out.exists() and Path(image).exists() and out.samefile(image):
        raise click.UsageError(f"{out} is the image itself: name another file")
    for name, value in (("--width-mm", width_mm), ("--dot-mm", dot_mm)):
        if value is not None and not (math.isfinite(value) and value > 0):
            raise click.UsageError(f"{name} must be above 0; got {value}")
    if dot_mm is not None and dot_mm > width_mm:
        raise click.UsageError(f"--dot-mm {dot_mm:g} is wider than the page, which has {width_mm:g} mm")
    if dot_mm is not None and dots == "tone":
        raise click.UsageError("--dot-mm is of dots of one size: leave out --dots tone")
    if template is not None and out.suffix.lower() != ".gcode":
        raise click.UsageError(f"--gcode-template goes with -o FILE.gcode; got {out}")


def darkness(
    source: str, curve: ToneCurve, colour: str | None, palette: str | None, seed: int
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
    return {"black": found}


def default_n(inks: dict[str, Darkness], width_mm: float, dot_mm: float | None) -> int:
    """Count dots: those that show the pixels, or those of a size that cover what is dark.

    Parameters
    ----------
    inks : dict of str to Darkness
        What is to be drawn.
    width_mm : float
        Of the page.
    dot_mm : float or None
        Diameter of the dots, if it is given.

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

    if dot_mm is None:
        wanted = min(MOST_POINTS, sum(one.default_n for one in inks.values()))
    else:
        pixel = width_mm / next(iter(inks.values())).values.shape[1]
        covered = sum(float(one.values.sum()) for one in inks.values()) * pixel**2
        wanted = round(covered / (math.pi / 4 * dot_mm**2))
        if wanted > MOST_BY_SIZE:
            raise click.UsageError(
                f"the picture takes {wanted:,} dots of {dot_mm:g} mm: make them larger, or give -n"
            )
    return max(len(inks), wanted)
