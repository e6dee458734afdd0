"""The sections of the page that show the sources of one size and dimension."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from matplotlib.figure import Figure

from gbnbench.reports import style
from gbnbench.reports.comparison import gallery, loglog, points, radial, rdf, spectrum, table
from gbnbench.reports.comparison.figure_files import stem
from gbnbench.reports.comparison.left_out import left_out
from gbnbench.reports.comparison.run_columns import measure_rows
from gbnbench.reports.html.charts import loglog_chart, radial_chart
from gbnbench.reports.html.pictures import Picture, figure_picture, gallery_panel, small_picture
from gbnbench.reports.source_groups import Group, members
from gbnbench.runs.comparison_result import Run, SourceResult
from gbnbench.runs.joined_runs import JoinedRuns

ALTERNATIVE_TEXTS = {  # of the pictures in each row of the gallery
    "points": "Points, first realization of {name}",
    "spectrum": "Power spectrum of {name}, log10, zero frequency in the middle",
    "radial power": "Radial power of {name} against nu",
    "anisotropy\n(dB)": "Anisotropy of {name} in decibels against nu",
    "zone plate": "Zone plate of {name}",
    "valence": "Voronoi cells of {name} coloured by number of Delaunay neighbours",
    "valence\n(%)": "Share of points of {name} with each number of Delaunay neighbours, percent",
}


def anchor(group: Group) -> str:
    """Return what the names of a group's sections end in."""
    return f"n{group[0]}-d{group[1]}"


def figure_or_drawn(drawn: Mapping[str, bytes], name: str, draw: Callable[[], Figure], alt: str) -> Picture:
    """Take a figure's PNG, or draw it where it is not there.

    Parameters
    ----------
    drawn : mapping of bytes
        PNGs by the stems of their files.
    name : str
        Stem of the figure's file.
    draw : callable
        Draws it.
    alt : str
        Text for readers who do not see it.

    Returns
    -------
    Picture
    """
    return small_picture(drawn[name], alt) if name in drawn else figure_picture(draw(), alt)


def group_sections(
    run: Run, group: Group, drawn: Mapping[str, bytes], several: bool, joined: JoinedRuns | None = None
) -> dict[str, Any]:
    """Return what the templates need for the sections of one (n, d).

    Parameters
    ----------
    run : Run
        The comparison.
    group : (n, d)
        Size and dimension.
    drawn : mapping of bytes
        PNGs by the stems of their files, which are not drawn again.
    several : bool
        Whether the page has other groups too.
    joined : JoinedRuns, optional
        The runs of which ``run`` was joined.

    Returns
    -------
    dict
    """
    sources = members(run, group)
    overlay = figure_or_drawn(
        drawn,
        stem(run, "loglog", group),
        lambda: loglog.figure(run, group),
        "Log-log overlay of the radial power of all sources",
    )
    radials = figure_or_drawn(
        drawn,
        stem(run, "radial", group),
        lambda: radial.figure(run, group),
        "Radial power of each source, its anisotropy below it",
    )
    pairs = None
    if any(source.rdf is not None for source in sources):
        pairs = figure_or_drawn(
            drawn,
            stem(run, "rdf", group),
            lambda: rdf.figure(run, group),
            "Radial distribution functions of all sources",
        )
    return {
        "anchor": anchor(group),
        "mark": f", n = {group[0]}, d = {group[1]}" if several else "",
        "single": any(source.realizations == 1 for source in sources),
        "rows": _rows(run, group),
        "measure_rows": [] if joined is None else measure_rows(joined, group),
        "gallery": _gallery(run, sources),
        "loglog": overlay,
        "loglog_chart": loglog_chart(run, group),
        "radial": radials,
        "radial_chart": radial_chart(run, group),
        "rdf": pairs,
    }


def _rows(run: Run, group: Group) -> list[dict[str, Any]]:
    strokes = style.strokes(run)
    return [
        {
            "label": table.row_label(row.source, run),
            "stroke": strokes[row.source.key],
            "cells": [row.cells[column.name] for column in table.COLUMNS],
        }
        for row in table.rows(run, group)
    ]


def _gallery(run: Run, sources: Sequence[SourceResult]) -> dict[str, Any]:
    strokes = style.strokes(run)
    lowest = float(spectrum.norm(sources).vmin or spectrum.LOWEST)
    rows = [
        (
            name,
            [
                gallery_panel(name, ratio, draw, source, ALTERNATIVE_TEXTS[name].format(name=source.label))
                for source in sources
            ],
        )
        for name, ratio, draw in gallery.rows(run, sources)
    ]
    remarks = [*map(points.note, sources), *map(spectrum.note, sources), left_out(sources)]
    return {
        "heads": [(source.label, strokes[source.key]) for source in sources],
        "rows": rows,
        "notes": " ".join(dict.fromkeys(filter(None, remarks))),
        "decades": f"{-math.log10(lowest):.0f}",
        "plane": any(source.d == 2 for source in sources),
    }
