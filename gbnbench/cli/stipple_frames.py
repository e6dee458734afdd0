"""Moving pictures of ``gbnbench stipple``: how many frames, of what, and their file."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import click

from gbnbench.api.stippled_frames import DPI, FRAMES, FormingDots, forming, growing, write_frames
from gbnbench.api.stippled_page import ANIMATIONS
from gbnbench.cli.late_progress import late_progress
from gbnbench.generators.adaptive.gbn.generator import AdaptiveGaussianBlueNoise
from gbnbench.generators.adaptive.protocol import AdaptiveGenerator
from gbnbench.reports.stippling.animation import check_animation
from gbnbench.reports.stippling.page import Page


@dataclass(frozen=True)
class Animation:
    """Frames to be drawn.

    Attributes
    ----------
    frames : int
        How many.
    dpi : float
        Pixels an inch.
    steps : int
        That the method takes while dots find their places; 0 where more and more dots are shown.
    """

    frames: int
    dpi: float
    steps: int


def checked_frames(
    out: Path, frames: int | None, sheet: Page, dpi: float | None, generator: AdaptiveGenerator,
    counts: Mapping[str, int], *, progressive: bool,
) -> Animation | None:  # fmt: skip
    """Find what frames are wanted, and refuse those that cannot be had.

    Parameters
    ----------
    out : Path
        The file.
    frames : int or None
        How many, if that is given.
    sheet : Page
        Of the size of the frames.
    dpi : float or None
        Pixels an inch, if that is given.
    generator : AdaptiveGenerator
        That draws the dots.
    counts : mapping of str to int
        Dots of each ink.
    progressive : bool
        Whether dots are added in their order.

    Returns
    -------
    Animation or None
        None for a file that is no moving picture.

    Raises
    ------
    click.UsageError
        If options contradict one another.
    InputError
        If the file cannot be written.
    """
    if out.suffix.lower() not in ANIMATIONS:
        if frames is not None:
            raise click.UsageError(f"--frames goes with -o FILE.gif or FILE.mp4; got {out}")
        return None
    resolution = DPI if dpi is None else dpi
    if progressive:
        steps, most, what = 0, sum(counts.values()), "dots"
    elif isinstance(generator, AdaptiveGaussianBlueNoise):
        steps = generator.gradients
        most, what = steps + 1, "states while dots find their places"
        if steps == 0:
            raise click.UsageError(
                "gbn[gradients=0] moves no dots: --progressive shows more and more of them"
            )
    else:
        raise click.UsageError(
            f"{generator.name} does not show how its dots find their places: --progressive shows more and "
            "more of them, or take --method gbn"
        )
    if frames is not None and frames > most:
        raise click.UsageError(f"there are {most} {what}: --frames must be at most {most}; got {frames}")
    count = min(FRAMES, most) if frames is None else frames
    check_animation(out, sheet, resolution, count)
    return Animation(count, resolution, steps)


def write_animation(
    out: Path, page: Page, moving: Animation, kept: FormingDots | None, mm: float, *, quiet: bool
) -> None:
    """Draw the frames.

    Parameters
    ----------
    out : Path
        The file.
    page : Page
        As it is at the end.
    moving : Animation
        The frames.
    kept : FormingDots or None
        Where the dots were; None where more and more of them are shown.
    mm : float
        Side of a pixel.
    quiet : bool
        Show no progress.
    """
    pages = growing(page, moving.frames) if kept is None else forming(page, kept.states, mm)
    with late_progress(quiet) as told:
        write_frames(out, pages, moving.frames, moving.dpi, told)
