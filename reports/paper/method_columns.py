"""Columns of a figure, a method each: the sets of a generator, or the user's."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Any

from gbnbench.core.settings import specification
from gbnbench.generators.registry import find
from gbnbench.reports import style
from gbnbench.reports.paper.method_styles import stroke, title_of
from gbnbench.runs.comparison_result import Run, SourceResult


@dataclass(frozen=True)
class Column:
    """A method in a figure.

    Attributes
    ----------
    title : str
        Name of the method in the figure.
    source : SourceResult
        Its sets and their measures.
    stroke : Stroke
        Colour and dash of its curves.
    """

    title: str
    source: SourceResult
    stroke: style.Stroke


def generated_column(run: Run, text: str, n: int, title: str | None = None) -> Column:
    """Select the plane sets of a generator from a run.

    Parameters
    ----------
    run : Run
        The comparison.
    text : str
        Generator with its settings, as typed.
    n : int
        Number of points.
    title : str, optional
        Title of the column; the name of the method where not given.

    Returns
    -------
    Column
        The column of the figure.
    """
    label = specification(find(text))
    (source,) = (s for s in run.sources if (s.label, s.n, s.d) == (label, n, 2))
    return Column(title or title_of(label), source, stroke(label))


def user_columns(data: Mapping[str, Any], methods: Iterable[str], n: int) -> list[Column]:
    """Select the user's plane sets of these methods.

    Parameters
    ----------
    data : mapping
        Data under the names that ``needs`` gives them.
    methods : iterable of str
        Names of methods; those without plane sets are left out.
    n : int
        Preferred number of points; otherwise the largest sets are taken.

    Returns
    -------
    list of Column
        One column for each method that has plane sets.
    """
    found = []
    for name in methods:
        flat = [source for source in data[name].sources if source.d == 2] if name in data else []
        if flat:
            best = max(flat, key=lambda source: (source.n == n, source.n))
            found.append(Column(title_of(name), best, stroke(name)))
    return found
