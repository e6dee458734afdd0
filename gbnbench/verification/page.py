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
# Generators compared with what is known about them

`gbnbench generators --verify -o docs/verification.md` draws these sets anew, measures them and writes this
page; its exit code is 1 if a figure does not agree. *Reference* is the figure to compare with, and *kind*
says where it comes from:

{kinds}

*Ours* is either a measure of all sets together, as defined in [the measures](measures.md), or the mean of
a figure of each set, as defined at [the end of this page](#measures-defined-here). It agrees if the
condition in the next column holds; *room* gives the reason for that tolerance. The `anisotropy_db` of an
isotropic method is expected to be -10 log10 M over M sets; this is an expectation, not what the
publication of the method measured.
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
        A table a family, how many agree, the measures that only this page has, what has no reference.
    """
    kinds = "\n".join(f"- *{kind}*: {meaning};" for kind, meaning in KINDS.items())
    parts = [HEAD.format(kinds=f"{kinds[:-1]}.")]
    agree = paragraph(f"**{agreeing(found)}**")
    parts.append(f"{agree}\nMeasured by gbnbench {__version__}.\n")
    for family, group in groupby(found, lambda one: GENERATORS[parse(one.figure.generator)[0]].family):
        rows = [_row(COLUMNS), _row(["---"] * len(COLUMNS)), *(_row(_cells(one)) for one in group)]
        parts.append(f"## {family.capitalize()}\n\n" + "\n".join(rows) + "\n")
    parts.append("\n".join(["## Without a reference", "", *_without_reference(), ""]))
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
    yield "These generators have no row, for the following reasons:"
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
