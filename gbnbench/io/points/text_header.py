"""The first line of a text of numbers: a header that counts the points, or a point."""

from __future__ import annotations

from pathlib import Path
from typing import NoReturn

import numpy as np

from gbnbench.core.errors import FormatError
from gbnbench.io.points.number_parser import Lexed


def header_form(path: Path, text: Lexed, unit_torus: bool) -> int:
    """Tell the numbers of each header line: 1, a count; 2, a count and a dimension; 0 where all are points.

    On the unit torus a first line of one or two bare whole numbers is a header where one of them exceeds 1,
    which no coordinate does. The few that a point could also be written as are headers only where nothing but
    a header fits. In other units any such line can be a point: it is one where it says another dimension than
    the rows have, a header where no point is as wide, and refused where it could be either.

    Parameters
    ----------
    path : Path
        Named in errors.
    text : Lexed
        The numbers of a text without names.
    unit_torus : bool
        Whether coordinates lie in [0, 1].

    Returns
    -------
    int

    Raises
    ------
    FormatError
        If the line may be either, or the numbers are those of pixels.
    """
    width = int(text.width[0])
    _refuse_column_numbers(path, text, width)
    if width > 2 or not text.bare[:width].all():
        return 0
    first = text.value[:width]
    following = int(text.width[1]) if len(text.width) > 1 else 0
    whole = bool(text.bare.all()) and bool((text.width == width).all())
    if width == 2 and not unit_torus and len(text.line) == 1:
        return 0  # a header would say of points, and there are none
    if width == following == 2 != first[1]:
        if not unit_torus:
            return 0
        if whole and np.any(text.value > 1):
            _refuse_pixels(path, text)
    if unit_torus and np.any(first > 1):
        return width
    if width == 1 and following > 1:
        return 1
    if width == 2 and first[0] == 1 == first[1] and following == 1:
        return 2
    if not unit_torus and first[0] >= 1 and (following != width or not whole):
        return width
    if width == 1 or first[1] == 1 or not unit_torus:
        literal = " ".join(str(int(v)) for v in first)
        point = " ".join(f"{v:.1f}" for v in first)
        raise FormatError(
            path,
            f"'{literal}' may be a header or a point: write the point as '{point}', "
            "or put a header of count and dimension such as '1024 2' first",
            int(text.line[0]),
        )
    return 0


def _refuse_column_numbers(path: Path, text: Lexed, width: int) -> None:
    """Refuse a first line of the whole numbers from 0 on, by which pandas names columns without names."""
    numbers = range(width)
    if width < 2 or len(text.line) < 2 or not text.bare[:width].all() or np.any(text.width != width):
        return
    if np.array_equal(text.value[:width], numbers):
        raise FormatError(
            path,
            f"'{' '.join(map(str, numbers))}' may number the columns, be a header or a point: remove it, or "
            f"write the point as '{' '.join(f'{k}.0' for k in numbers)}'",
            int(text.line[0]),
        )


def _refuse_pixels(path: Path, text: Lexed) -> NoReturn:
    at = int(np.argmax(text.value > 1))
    line = int(text.line[np.searchsorted(np.cumsum(text.width), at, side="right")])
    raise FormatError(
        path,
        f"coordinate {text.value[at]:g} is not in [0, 1]: all numbers are whole, as those of pixels are; "
        "give the image's size, such as --period 512,512 (period= in Python)",
        line,
    )
