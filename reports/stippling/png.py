"""Stipplings as PNG: discs whose pixels are covered as much as they are, inks multiplied."""

from __future__ import annotations

import io
import math

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import InputError
from gbnbench.reports.stippling.page import DotLayer, Page, rgb_of
from gbnbench.reports.stippling.tiles import drawn_layers

MM_AN_INCH = 25.4
MOST_PIXELS = 89_478_485  # so that the picture can be read again
LEAST_DPI = 1.0


def png(page: Page, dpi: float = 300.0) -> bytes:
    """Write a page as PNG.

    Parameters
    ----------
    page : Page
        The page.
    dpi : float
        Pixels an inch, at least 1.

    Returns
    -------
    bytes
        Grey where inks and paper are, else red, green and blue; the resolution is in the file.

    Raises
    ------
    InputError
        If there are too many pixels.
    """
    from PIL import Image

    picture = Image.fromarray(pixels(page, dpi))
    buffer = io.BytesIO()
    picture.save(buffer, "PNG", dpi=(dpi, dpi))
    return buffer.getvalue()


def pixels(page: Page, dpi: float) -> NDArray[np.uint8]:
    """Draw a page.

    Parameters
    ----------
    page : Page
        The page.
    dpi : float
        Pixels an inch.

    Returns
    -------
    (rows, columns) or (rows, columns, 3) uint8
        White paper is 255. Inks multiply on it; they cover any other.

    Raises
    ------
    InputError
        If there are too many pixels.
    """
    columns, rows = picture_size(page, dpi)
    colours = [rgb_of(page.paper), *(layer.rgb for layer in page.layers)]
    grey = all(len(set(rgb)) == 1 for rgb in colours)
    paper, *inks = (np.array(rgb[: 1 if grey else 3], np.float32) for rgb in colours)
    light = np.broadcast_to(paper, (rows, columns, len(paper))).copy()
    for layer, ink in zip(drawn_layers(page), inks, strict=True):
        covered = _covered(page, layer, rows, columns)[..., None]
        light += covered * (light * ink if page.white else ink) - covered * light
    drawn = np.rint(255 * light).astype(np.uint8)
    return drawn[..., 0] if grey else drawn


def picture_size(page: Page, dpi: float) -> tuple[int, int]:
    """Count the pixels of a page.

    Parameters
    ----------
    page : Page
        The page.
    dpi : float
        Pixels an inch.

    Returns
    -------
    columns, rows : int

    Raises
    ------
    InputError
        If there are too many pixels.
    """
    if not math.isfinite(dpi):
        raise InputError(f"dpi must be a number; got {dpi}")
    columns, rows = (max(1, round(side / MM_AN_INCH * dpi)) for side in (page.width, page.height))
    if dpi < LEAST_DPI or columns * rows > MOST_PIXELS:
        raise InputError(
            f"dpi must be at least {LEAST_DPI:g} and give at most {MOST_PIXELS:,} pixels; "
            f"got {dpi:g}, for {columns:,} x {rows:,} pixels"
        )
    return columns, rows


def _covered(page: Page, layer: DotLayer, rows: int, columns: int) -> NDArray[np.float32]:
    """Share of each pixel that the dots cover."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.collections import EllipseCollection
    from matplotlib.figure import Figure

    figure = Figure((columns / 100, rows / 100), dpi=100, facecolor="white")
    axes = figure.add_axes((0, 0, 1, 1), xlim=(0, page.width), ylim=(page.height, 0))
    axes.set_axis_off()
    sides = 2 * layer.radii
    axes.add_collection(
        EllipseCollection(
            sides, sides, np.zeros(len(sides)), units="xy", offsets=layer.centres,
            offset_transform=axes.transData, facecolors="black", linewidths=0, snap=False,
        ),
        autolim=False,
    )  # fmt: skip
    canvas = FigureCanvasAgg(figure)
    canvas.draw()  # type: ignore[no-untyped-call]
    drawn = np.asarray(canvas.buffer_rgba())[..., 0]  # type: ignore[no-untyped-call]
    return np.asarray(1 - drawn / np.float32(255), np.float32)
