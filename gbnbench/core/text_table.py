"""Tables in plain text: columns aligned, words left and numbers right."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from gbnbench.core import number_text
from gbnbench.core.readable_text import display_width, left, right


def number(value: Any) -> str:
    """Three significant digits."""
    return number_text.number(float(value))


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
        shown.append([left(cell, width) if words else right(cell, width) for cell in column])
    for line in zip(*shown, strict=True):
        yield "  ".join(line).rstrip()
