"""The page of published figures beside ours, in Markdown."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from gbnbench import __version__
from gbnbench.core.number_text import number
from gbnbench.core.settings import parse
from gbnbench.generators.registry import GENERATORS
from gbnbench.verification.verify import Verified

HEAD = """\
# Generators held against what was published of them

`gbnbench generators --verify -o docs/verification.md` draws these sets anew, measures them and writes this
page; its exit code is 1 where one does not agree. *Ours* is a measure of all sets together, as
[the measures](measures.md) define it, or the mean of a figure of each set. It agrees if it lies between
*from* and *to*; *why* says what that room is for.
"""
COLUMNS = ("generator", "sets", "measure", "published", "ours", "from", "to", "agrees", "why", "source")


def markdown(found: Sequence[Verified]) -> str:
    """Write the page.

    Parameters
    ----------
    found : sequence of Verified
        Family by family.

    Returns
    -------
    str
        A table a family.
    """
    parts = [HEAD]
    for family, group in groupby(found, lambda one: GENERATORS[parse(one.figure.generator)[0]].family):
        rows = [_row(COLUMNS), _row(["---"] * len(COLUMNS)), *(_row(_cells(one)) for one in group)]
        parts.append(f"## {family.capitalize()}\n\n" + "\n".join(rows) + "\n")
    agreeing = sum(one.agrees for one in found)
    parts.append(f"{agreeing} of {len(found)} figures agree. Measured by gbnbench {__version__}.\n")
    return "\n".join(parts)


def _cells(one: Verified) -> list[str]:
    figure = one.figure
    return [
        f"`{figure.generator}`", f"{figure.sets} of n={figure.n}, d={figure.d}", f"`{figure.measure_name}`",
        figure.published, number(one.ours), number(figure.low), number(figure.high),
        "yes" if one.agrees else f"**no** {one.failure}".strip(), figure.reason, figure.source,
    ]  # fmt: skip


def _row(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cell.replace('|', '&#124;') for cell in cells)} |"
