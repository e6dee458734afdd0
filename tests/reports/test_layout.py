"""Sheets of equal cells: how many stand in a row."""

from __future__ import annotations

import pytest

from gbnbench.reports.layout import sheet


@pytest.mark.parametrize(
    ("count", "most", "rows"),
    [(1, 4, [1]), (4, 4, [4]), (5, 4, [3, 2]), (12, 12, [12]), (13, 12, [7, 6]), (15, 12, [8, 7])],
)
def test_rows_are_of_like_length(count: int, most: int, rows: list[int]) -> None:
    made = sheet("Title", "Caption.", count, 1.0, [1.0], columns=most)
    heights = [stack[0].get_position().y0 for stack in made.cells]
    assert [heights.count(y) for y in sorted(set(heights), reverse=True)] == rows
    assert sum(made.first) == len(rows)
