"""Tables of text that the benchmarks print."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any


def number(value: Any) -> str:
    """Three significant digits."""
    from gbnbench.reports.numbers import number

    return number(float(value))


def table(head: Sequence[str], rows: Sequence[Sequence[Any]]) -> Iterator[str]:
    """Align columns: words left, numbers right."""
    columns = list(zip(head, *(map(str, row) for row in rows), strict=True))
    shown = []
    for column in columns:
        width = max(map(len, column))
        words = not any(cell[:1].isdigit() for cell in column[1:])
        shown.append([cell.ljust(width) if words else cell.rjust(width) for cell in column])
    for line in zip(*shown, strict=True):
        yield "  ".join(line).rstrip()
