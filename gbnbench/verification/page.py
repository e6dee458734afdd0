"""The page of figures to agree with beside ours, in Markdown."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import groupby

from gbnbench import __version__
from gbnbench.core.prose_lines import paragraph
from gbnbench.core.settings import parse
from gbnbench.generators.registry import GENERATORS
from gbnbench.verification.published_figure import KINDS, PublishedFigure
from gbnbench.verification.verify import Verified
from gbnbench.verification.without_reference import WITHOUT_REFERENCE
from gbnbench.verification.wording import agreeing, values

HEAD = """\
# Generators held against what is known of them

`gbnbench generators --verify -o docs/verification.md` draws these sets anew, measures them and writes this
page; its exit code is 1 where a figure does not agree. *Reference* is the figure to agree with, and *kind*
says where it comes from:

{kinds}

*Ours* is a measure of all sets together, as [the measures](measures.md) define it, or the mean of a figure of
each set, which [the end of this page](#measures-defined-here) defines. It agrees if it is what the next
column says; *room* says why it need not be nearer. An isotropic method has an `anisotropy_db` of -10 log10 M
over M sets: that is an expectation, which does not say what the publication of the method measured.
"""
COLUMNS = (
    "generator",
    "sets",
    "measure",
    "kind",
    "reference",
    "ours",
    "agrees if",
    "agrees",
    "room",
    "source",
)


def markdown(found: Sequence[Verified]) -> str:
    """Write the page.

    Parameters
    ----------
    found : sequence of Verified
        Family by family.

    Returns
    -------
    str
        A table a family, how many agree, the measures that only this page has, what is held against nothing.
    """
    kinds = "\n".join(f"- *{kind}*: {meaning};" for kind, meaning in KINDS.items())
    parts = [HEAD.format(kinds=f"{kinds[:-1]}.")]
    agree = paragraph(f"**{agreeing(found)}**")
    parts.append(f"{agree}\nMeasured by gbnbench {__version__}.\n")
    for family, group in groupby(found, lambda one: GENERATORS[parse(one.figure.generator)[0]].family):
        rows = [_row(COLUMNS), _row(["---"] * len(COLUMNS)), *(_row(_cells(one)) for one in group)]
        parts.append(f"## {family.capitalize()}\n\n" + "\n".join(rows) + "\n")
    parts.append("\n".join(["## Held against nothing", "", *_without_reference(), ""]))
    definitions = list(_definitions([one.figure for one in found]))
    if definitions:
        parts.append("\n".join(["## Measures defined here", "", *definitions, ""]))
    return "\n".join(parts)


def _cells(one: Verified) -> list[str]:
    figure = one.figure
    ours, agrees_if = values(one)
    return [
        f"`{figure.generator}`", f"{figure.sets} of n={figure.n}, d={figure.d}", f"`{figure.measure_name}`",
        figure.kind, figure.published, ours, agrees_if,
        "yes" if one.agrees else f"**no** {one.failure}".strip(), figure.reason, figure.source,
    ]  # fmt: skip


def _row(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cell.replace('|', '&#124;') for cell in cells)} |"


def _without_reference() -> Iterator[str]:
    yield "These generators have no row, because"
    yield ""
    ends = [*[";"] * (len(WITHOUT_REFERENCE) - 1), "."]
    for (name, reason), end in zip(WITHOUT_REFERENCE.items(), ends, strict=True):
        yield paragraph(f"`{name}`: {reason}{end}", "- ", "  ")


def _definitions(figures: Sequence[PublishedFigure]) -> Iterator[str]:
    """Define each measure that is no scalar of ``gbnbench.measures``; those of one definition together."""
    names: dict[str, list[str]] = {}
    for figure in figures:
        if figure.definition and figure.measure_name not in names.setdefault(figure.definition, []):
            names[figure.definition].append(figure.measure_name)
    for definition, those in names.items():
        text = re.sub(r"``([^`]+)``|(\b2\*\*(?:\w+|\([^)]*\)))", r"`\1\2`", definition.replace("\n", " "))
        of = ", ".join(f"`{name}`" for name in those)
        yield paragraph(f"{of}: {text[0].lower()}{text[1:]}", "- ", "  ")
