"""Tables in plain text: columns aligned, words left and numbers right."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from gbnbench.core import number_text


def number(value: Any) -> str:
    """Three significant digits."""
    return number_text.number(float(value))


def display_width(text: str) -> int:
    """Return the columns that a text takes in a terminal: two for a Chinese, Japanese or Korean sign.

    Parameters
    ----------
    text : str
        One line.

    Returns
    -------
    int
        Columns.

    Examples
    --------
    >>> display_width("gbn"), display_width("蓝噪声")
    (3, 6)
    """
    from rich.cells import cell_len

    return cell_len(text)


def padded(text: str, width: int, *, right: bool = False) -> str:
    """Fill a text with blanks up to a width in a terminal.

    Parameters
    ----------
    text : str
        The text.
    width : int
        Columns; a longer text stays as it is.
    right : bool
        Whether the text stands on the right.

    Returns
    -------
    str
        Text and blanks.
    """
    blanks = " " * (width - display_width(text))
    return blanks + text if right else text + blanks


def aligned(head: Sequence[str], rows: Sequence[Sequence[Any]]) -> Iterator[str]:
    """Lay out a table with one line a row under its head.

    Parameters
    ----------
    head : sequence of str
        Titles of the columns.
    rows : sequence of sequences
        Cells, written by ``str``.

    Returns
    -------
    iterator of str
        The lines.
    """
    columns = list(zip(head, *(map(str, row) for row in rows), strict=True))
    shown = []
    for column in columns:
        width = max(map(display_width, column))
        words = not any(cell[:1].isdigit() for cell in column[1:])
        shown.append([padded(cell, width, right=not words) for cell in column])
    for line in zip(*shown, strict=True):
        yield "  ".join(line).rstrip()
