"""Ranges of numbers of points, in powers of two, and of dimensions, as options take them."""

from __future__ import annotations

import re
from typing import Any

import click

from gbnbench.cli.options import WholeNumbers

RANGE = re.compile(r"\s*(\d+)\s*-\s*(\d+)\s*")


class NumberRanges(WholeNumbers):
    """Whole numbers and ranges separated by commas, such as ``1-3,8``.

    Parameters
    ----------
    doubling : bool
        Let a range be the powers of two in it, such as 16, 32, 64 for ``16-64``, and not every number.
    """

    name = "numbers"

    def __init__(self, *, doubling: bool = False) -> None:
        self.doubling = doubling

    def convert(
        self, value: Any, param: click.Parameter | None, ctx: click.Context | None
    ) -> tuple[int, ...]:
        """Read the text, as ``WholeNumbers.convert`` does, ranges too."""
        if isinstance(value, tuple):
            return value
        numbers: list[int] = []
        for word in str(value).split(","):
            found = RANGE.fullmatch(word)
            if found is None:
                numbers.extend(super().convert(word, param, ctx))
                continue
            low, high = int(found[1]), int(found[2])
            numbers.extend(self._between(word.strip(), low, high, param, ctx))
        return tuple(dict.fromkeys(numbers))

    def _between(
        self, word: str, low: int, high: int, param: click.Parameter | None, ctx: click.Context | None
    ) -> list[int]:
        if not 1 <= low <= high:
            self.fail(f"a range must begin at 1 or more and not above its end; got {word}", param, ctx)
        if not self.doubling:
            if high - low >= 1000:
                self.fail(f"a range must hold at most 1000 numbers; got {word}", param, ctx)
            return list(range(low, high + 1))
        powers = [2**k for k in range(high.bit_length()) if low <= 2**k <= high]
        if not powers:
            self.fail(f"a range is of powers of two, and there is none in {word}", param, ctx)
        return powers
