"""Page ``report.html`` of a run: one file that opens offline, prints and is whole without scripts."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import MappingProxyType
from typing import Any

from matplotlib.figure import Figure

from gbnbench.core.atomic_write import write_whole
from gbnbench.reports import captions, style
from gbnbench.reports.comparison import (
    gallery,
    loglog,
    points,
    radial,
    rdf,
    spectrum,
    sweep,
    table,
)
from gbnbench.reports.comparison.figure_files import stem
from gbnbench.reports.comparison.left_out import left_out
from gbnbench.reports.html import notes
from gbnbench.reports.html.charts import loglog_chart, radial_chart
from gbnbench.reports.html.environment import template_environment
from gbnbench.reports.html.pictures import Picture, colour_bar, figure_picture, gallery_panel, small_picture
from gbnbench.reports.source_groups import Group, groups, members
from gbnbench.runs.comparison_result import Run, SourceResult

ALTERNATIVE_TEXTS = {  # of the pictures in each row of the gallery
    "points": "Points, first realization of {name}",
    "spectrum": "Power spectrum of {name}, log10, zero frequency in the middle",
    "radial power": "Radial power of {name} against nu",
    "anisotropy\n(dB)": "Anisotropy of {name} in decibels against nu",
    "zone plate": "Zone plate of {name}",
    "valence": "Voronoi cells of {name} coloured by number of Delaunay neighbours",
    "valence\n(%)": "Share of points of {name} with each number of Delaunay neighbours, percent",
}
GROUP_SECTIONS = (
    ("table", "Measures"),
    ("gallery", "Side by side"),
    ("loglog", "Log-log"),
    ("radial", "Radial"),
)


def write_report(run: Run, path: str | Path, drawn: Mapping[str, bytes] | None = None) -> None:
    """Write the page of a run, whole or not at all.

    Parameters
    ----------
    run : Run
        The comparison. Nothing in it is measured again.
    path : path
        Usually ``report.html`` in the run folder; an older page there is replaced.
    drawn : mapping of bytes, optional
        PNGs that ``write_figures`` made of the same run, by the stems of their files: not drawn again.
    """
    write_whole(Path(path), page(run, drawn or {}).encode("utf-8"))


@style.styled
def page(run: Run, drawn: Mapping[str, bytes] = MappingProxyType({})) -> str:
    """Return the page as text; every label, path and setting in it is escaped.

    Parameters
    ----------
    run : Run
        The comparison.
    drawn : mapping of bytes
        PNGs by the stems of their files, which are not drawn again.

    Returns
    -------
    str
        HTML.
    """
    every = groups(run)
    swept = sweep.several(run)
    template = template_environment(table.COLUMNS).get_template("report.html")
    text = template.render(
        title=_title(run),
        version=run.manifest.get("version", ""),
        settings=captions.settings(run),
        links=_links(every, swept),
        warnings=[(table.row_label(s, run), warning) for s in run.sources for warning in s.warnings],
        skipped=[_sentence(source) for source in run.manifest.get("skipped") or []],
        groups=[_group(run, group, drawn, several=len(every) > 1) for group in every],
        compared=bool(run.verdicts),
        sweep=_figure(
            drawn,
            "sweep",
            lambda: sweep.figure(run),
            "Measures against the number of points, a curve a source",
        )
        if swept
        else None,
        undefined_values=notes.undefined_values(run),
        provenance=notes.provenance(run.manifest),
        manifest=json.dumps(run.manifest, indent=2, ensure_ascii=False, default=str),
        colour_bar=colour_bar(),
    )
    return text.encode("utf-8", "replace").decode("utf-8")  # odd file names hold lone surrogates


def _title(run: Run) -> str:
    labels = list(dict.fromkeys(source.label for source in run.sources))
    few = ", ".join(label if len(label) <= 40 else f"{label[:39]}…" for label in labels[:4])
    return f"gbnbench: {few}" + (f" and {len(labels) - 4} more" if len(labels) > 4 else "")


def _anchor(group: Group) -> str:
    return f"n{group[0]}-d{group[1]}"


def _links(every: Sequence[Group], swept: bool) -> list[tuple[str, str]]:
    """Anchor and title of each section."""
    links = []
    for n, d in every:
        mark = f" n={n}, d={d}" if len(every) > 1 else ""
        links += [(f"{name}-{_anchor((n, d))}", title + mark) for name, title in GROUP_SECTIONS]
    links += [("sweep", "Against n")] if swept else []
    return [*links, ("undefined", "Undefined"), ("definitions", "Definitions"), ("made", "What made it")]


def _sentence(item: object) -> str:
    return ", ".join(f"{k}: {v}" for k, v in item.items()) if isinstance(item, Mapping) else str(item)


def _figure(drawn: Mapping[str, bytes], name: str, draw: Callable[[], Figure], alt: str) -> Picture:
    """Take a figure's PNG, or draw it where it is not there."""
    return small_picture(drawn[name], alt) if name in drawn else figure_picture(draw(), alt)


def _group(run: Run, group: Group, drawn: Mapping[str, bytes], several: bool) -> dict[str, Any]:
    """Content of the sections of one (n, d)."""
    sources = members(run, group)
    overlay = _figure(
        drawn,
        stem(run, "loglog", group),
        lambda: loglog.figure(run, group),
        "Log-log overlay of the radial power of all sources",
    )
    radials = _figure(
        drawn,
        stem(run, "radial", group),
        lambda: radial.figure(run, group),
        "Radial power of each source, its anisotropy below it",
    )
    pairs = None
    if any(source.rdf is not None for source in sources):
        pairs = _figure(
            drawn,
            stem(run, "rdf", group),
            lambda: rdf.figure(run, group),
            "Radial distribution functions of all sources",
        )
    return {
        "anchor": _anchor(group),
        "mark": f", n = {group[0]}, d = {group[1]}" if several else "",
        "single": any(source.realizations == 1 for source in sources),
        "rows": _rows(run, group),
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
