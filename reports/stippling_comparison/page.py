"""Page ``report.html`` of a comparison of stipplings: one self-contained file that opens offline."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from matplotlib.figure import Figure

from gbnbench.core.atomic_write import write_whole
from gbnbench.reports import style
from gbnbench.reports.comparison.figure_files import png
from gbnbench.reports.html import notes
from gbnbench.reports.html.environment import template_environment
from gbnbench.reports.html.pictures import Picture
from gbnbench.reports.stippling_comparison import captions, gallery, panels
from gbnbench.reports.stippling_comparison.figure_files import FIGURES
from gbnbench.reports.stippling_comparison.table import COLUMNS, row_label, rows
from gbnbench.studies.stippling_comparison.stippling_results import StipplingRun

PANEL = 2.5  # inches, shown at 250 CSS pixels
FLATTEST, TALLEST = 0.04, 4.0  # height of a panel over its width, whatever the image's
ROWS = {  # alternative texts
    "points": "Points of {name}, first set",
    "close": "Points of {name} in the flattest square",
    "found back": "Picture found back from the points of {name}",
    "difference": "Set of {name} less the density, blurred",
    "spectrum there": "Power of {name} in the flattest square, zero frequency in the middle",
}


def write_report(run: StipplingRun, path: str | Path, drawn: Mapping[str, bytes] | None = None) -> None:
    """Write the page of a comparison, whole or not at all.

    Parameters
    ----------
    run : StipplingRun
        The comparison. Nothing in it is measured again.
    path : path
        Usually ``report.html`` in the folder; an older page there is replaced.
    drawn : mapping of bytes, optional
        PNGs that ``write_figures`` made of the same run, by their names: not drawn again.
    """
    write_whole(Path(path), page(run, drawn or {}).encode("utf-8"))


@style.styled
def page(run: StipplingRun, drawn: Mapping[str, bytes] = MappingProxyType({})) -> str:
    """Return the page as text; every label, path and setting in it is escaped.

    Parameters
    ----------
    run : StipplingRun
        The comparison.
    drawn : mapping of bytes
        PNGs by their names, which are not drawn again.

    Returns
    -------
    str
        HTML.
    """
    spectra, stipplings = (drawn.get(name) or png(FIGURES[name](run)) for name in ("spectra", "stipplings"))
    template = template_environment(COLUMNS).get_template("stipplings.html")
    text = template.render(
        title=_title(run),
        version=run.manifest["version"],
        settings=captions.settings(run),
        patch=captions.patch_text(run),
        skipped=run.manifest.get("skipped") or [],
        failures=run.failures,
        rows=[
            {
                "label": row_label(row.source, run),
                "stroke": style.numbered_stroke(k),
                "cells": [row.cells[column.name] for column in COLUMNS],
            }
            for k, row in enumerate(rows(run))
        ],
        heads=[(row_label(source, run), style.numbered_stroke(k)) for k, source in enumerate(run.sources)],
        gallery=_gallery(run),
        scale=gallery.difference_scale(run),
        powers=panels.POWER,
        spectra=Picture("Spectra of all sources, and their variance against CPU seconds", spectra),
        stipplings=Picture("First set of every source, large", stipplings),
        provenance=notes.provenance(run.manifest),
        manifest=json.dumps(run.manifest, indent=2, ensure_ascii=False, default=str),
    )
    return text.encode("utf-8", "replace").decode("utf-8")  # odd file names hold lone surrogates


def _title(run: StipplingRun) -> str:
    labels = ", ".join(source.label for source in run.sources[:4])
    more = f" and {len(run.sources) - 4} more" if len(run.sources) > 4 else ""
    return f"gbnbench: {run.manifest['settings']['density']['name']} by {labels}{more}"


def _gallery(run: StipplingRun) -> list[tuple[str, Picture | None, list[Picture]]]:
    """Rows: title, the picture of the image, those of the sources."""
    scale = gallery.difference_scale(run)
    patch = run.patch
    kept = [name for name in ROWS if patch is not None or name not in ("close", "spectrum there")]
    found: list[tuple[str, Picture | None, list[Picture]]] = []
    for name in kept:
        image: Picture | None = None
        if name in ("points", "found back"):
            framed = patch if name == "points" else None
            image = _picture(run, "The image", lambda ax, p=framed: panels.ink(ax, run.density, patch=p))
        elif name == "close" and patch is not None:
            image = _picture(run, "Its square", lambda ax: panels.ink(ax, patch.of(run.density)), square=True)
        square = name in ("close", "spectrum there")
        pictures = [
            _picture(
                run, ROWS[name].format(name=source.label),
                lambda ax, s=source, n=name: gallery.panel(ax, n, s, run, scale, PANEL), square=square,
            )
            for source in run.sources
        ]  # fmt: skip
        found.append((name, image, pictures))
    return found


def _picture(run: StipplingRun, alt: str, draw: Callable[..., None], *, square: bool = False) -> Picture:
    ratio = 1.0 if square else min(max(run.density.shape[0] / run.density.shape[1], FLATTEST), TALLEST)
    figure = Figure(figsize=(PANEL, PANEL * ratio))
    draw(figure.add_axes((0.008, 0.008, 0.984, 0.984)))
    return Picture(alt, png(figure, dpi=200))
