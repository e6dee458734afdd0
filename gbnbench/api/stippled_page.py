"""Stipplings written as what a file's suffix names, and the order of their dots."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from gbnbench.api.page_style import PageStyle, page_of
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.io.points.stippled_points import AMPLITUDE, INK, PictureHeader
from gbnbench.io.points.writer import write_atomically
from gbnbench.reports.stippling import animation
from gbnbench.reports.stippling.eps import eps
from gbnbench.reports.stippling.gcode import GcodeTemplate, gcode
from gbnbench.reports.stippling.page import Page
from gbnbench.reports.stippling.pdf import pdf
from gbnbench.reports.stippling.png import png
from gbnbench.reports.stippling.svg import svg
from gbnbench.studies.stippling.tour import path_length, tour

if TYPE_CHECKING:
    from gbnbench.api.stippling import Stippling

DEFAULT_STYLE = PageStyle()
PICTURES: dict[str, Callable[[Page], bytes]] = {".svg": svg, ".pdf": pdf, ".eps": eps}
TEXTS = (".txt", ".csv")
AXES = "xyz"
ANIMATIONS = animation.SUFFIXES
SUFFIXES = (".png", *PICTURES, ".gcode", *TEXTS)


def check_picture(path: Path) -> None:
    """Refuse a file whose suffix names nothing that is written.

    Parameters
    ----------
    path : Path
        The file.

    Raises
    ------
    InputError
        If it is none of ``SUFFIXES`` or ``ANIMATIONS``.
    """
    if path.suffix.lower() not in (*SUFFIXES, *ANIMATIONS):
        known = ", ".join((*SUFFIXES, *ANIMATIONS))
        raise InputError(f"{path}: stipplings are written as {known}; got extension {path.suffix!r}")


def in_tour_order(made: Stippling) -> tuple[Stippling, float]:
    """Put the points in the order of a short path through all of them.

    Parameters
    ----------
    made : Stippling
        In two dimensions.

    Returns
    -------
    stippling : Stippling
        In the new order.
    length : float
        Of the path, in pixels.
    """
    from dataclasses import replace

    order = tour(made.pixels)
    ordered = replace(made, pixels=made.pixels[order], amplitudes=made.amplitudes[order])
    return ordered, path_length(ordered.pixels)


def text_of(layers: Mapping[str, Stippling], suffix: str) -> bytes:
    """Write points with their amplitudes as rows of numbers, in the unit square, x to the right and y up.

    Parameters
    ----------
    layers : mapping of str to Stippling
        By the names of their inks.
    suffix : {".txt", ".csv"}
        Rows parted by blanks below a comment, or a table of commas with names.

    Returns
    -------
    bytes
        UTF-8. A .txt has a comment before each ink that tells the picture's size and coverage, which
        ``gbnbench reconstruct`` reads, and one that names the columns; a .csv of several inks a column
        ``ink``.
    """
    if suffix == ".csv":
        import pandas as pd

        tables = [
            pd.DataFrame({**dict(zip(AXES, made.points.T, strict=False)), AMPLITUDE: made.amplitudes})
            for made in layers.values()
        ]
        if len(layers) > 1:
            for name, table in zip(layers, tables, strict=True):
                table.insert(0, INK, name)
        text: str = pd.concat(tables).to_csv(index=False, lineterminator="\n")
        return text.encode()
    lines = []
    for name, made in layers.items():
        lines.append(PictureHeader(made.size, made.coverage).text(name))
        lines.append(f"# {' '.join(AXES[: len(made.size)])} {AMPLITUDE}")
        rows: FloatArray = np.column_stack([made.points, made.amplitudes])
        lines += [" ".join(map(repr, row)) for row in rows.tolist()]
    return ("\n".join(lines) + "\n").encode()


def write_stippling(
    path: Path,
    layers: Mapping[str, Stippling],
    style: PageStyle = DEFAULT_STYLE,
    *,
    dpi: float = 300.0,
    template: GcodeTemplate | None = None,
) -> None:
    """Write a file, whole or not at all.

    Parameters
    ----------
    path : Path
        Its suffix names the format.
    layers : mapping of str to Stippling
        By the names of their inks.
    style : PageStyle
        How they lie on the page; it does not count for text.
    dpi : float
        Pixels an inch of a PNG.
    template : GcodeTemplate, optional
        Lines of a .gcode; by default those of a pen that Z lifts.

    Raises
    ------
    InputError
        If the suffix or a number is wrong, or the place cannot be written.
    """
    check_picture(path)
    suffix = path.suffix.lower()
    if suffix in ANIMATIONS:
        raise InputError(f"{path}: gbnbench.api.stippled_frames.write_frames writes moving pictures")
    write_atomically(path, encoded(suffix, layers, style, dpi=dpi, template=template))


def encoded(
    suffix: str,
    layers: Mapping[str, Stippling],
    style: PageStyle = DEFAULT_STYLE,
    *,
    dpi: float = 300.0,
    template: GcodeTemplate | None = None,
) -> bytes:
    """Make the bytes of a file.

    Parameters
    ----------
    suffix : str
        One of ``SUFFIXES``.
    layers, style, dpi, template
        As ``write_stippling`` takes them.

    Returns
    -------
    bytes
    """
    if suffix in TEXTS:
        return text_of(layers, suffix)
    page = page_of(layers, style)
    if suffix == ".png":
        return png(page, dpi)
    if suffix == ".gcode":
        return gcode(page, template or GcodeTemplate())
    return PICTURES[suffix](page)
