"""report.html: one self-contained page of a run, that opens offline, prints and is read without scripts."""

from __future__ import annotations

import base64
import io
import math
from collections.abc import Callable, Mapping, Sequence
from importlib import resources
from pathlib import Path
from string import Template

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.image import imsave

from gbnbench.core.atomic_write import write_whole
from gbnbench.core.number_text import NOTHING
from gbnbench.reports import style
from gbnbench.reports.comparison import gallery, loglog, points, rdf, spectrum, sweep, table, valence
from gbnbench.reports.comparison.figure_files import png
from gbnbench.reports.html import notes
from gbnbench.reports.html.notes import escaped
from gbnbench.runs.comparison_result import Run, SourceResult

PANEL = 2.5  # inches of a gallery picture, shown at 250 CSS pixels
ROWS = {
    "points": "Points, first realization of {name}",
    "spectrum": "Power spectrum of {name}, log10, zero frequency in the middle",
    "radial power": "Radial power of {name} against nu",
    "anisotropy\n(dB)": "Anisotropy of {name} in decibels against nu",
    "zone plate": "Zone plate of {name}",
    "valence": "Voronoi cells of {name} coloured by number of Delaunay neighbours",
    "valence\n(%)": "Share of points of {name} with each number of Delaunay neighbours, percent",
}


def write_report(run: Run, path: str | Path) -> None:
    """Write the page of a run, whole or not at all.

    Parameters
    ----------
    run : Run
        Drawn as it is: nothing is measured again.
    path : path
        Usually ``report.html`` in the run folder; an older page there is replaced at once.
    """
    write_whole(Path(path), page(run).encode("utf-8"))


def page(run: Run) -> str:
    """Return the page as text; every label, path and setting in it is escaped."""
    folder = resources.files("gbnbench.reports.html")
    every = style.groups(run)
    parts = [_group_section(run, group, several=len(every) > 1) for group in every]
    if sweep.several(run):
        picture = _figure(sweep.figure(run), "Measures against the number of points, a curve a source")
        parts.append(f'<section id="sweep"><h2>Against the number of points</h2>{picture}</section>')
    return Template(folder.joinpath("report.html").read_text(encoding="utf-8")).substitute(
        css=folder.joinpath("report.css").read_text(encoding="utf-8"),
        title=escaped(_title(run)),
        version=escaped(run.manifest.get("version", "")),
        settings=escaped(style.settings(run)),
        nav=_nav(every, sweep.several(run)),
        warnings=_warnings(run),
        sections="\n".join(parts),
        undefined=notes.undefined(run),
        definitions=notes.definitions(),
        made=notes.made(run.manifest),
    )


def _title(run: Run) -> str:
    labels = list(dict.fromkeys(source.label for source in run.sources))
    few = ", ".join(label if len(label) <= 40 else f"{label[:39]}…" for label in labels[:4])
    return f"gbnbench: {few}" + (f" and {len(labels) - 4} more" if len(labels) > 4 else "")


def _place(group: style.Group) -> str:
    return f"n{group[0]}-d{group[1]}"


def _nav(every: Sequence[style.Group], swept: bool) -> str:
    links = []
    for n, d in every:
        mark = f" n={n}, d={d}" if len(every) > 1 else ""
        for anchor, title in (("table", "Measures"), ("gallery", "Side by side"), ("loglog", "Log-log")):
            links.append((f"{anchor}-{_place((n, d))}", title + mark))
    links += [("sweep", "Against n")] if swept else []
    links += [("undefined", "Undefined"), ("definitions", "Definitions"), ("made", "What made it")]
    return "".join(f'<a href="#{anchor}">{title}</a>' for anchor, title in links)


def _warnings(run: Run) -> str:
    said = [(table.row_label(s, run), warning) for s in run.sources for warning in s.warnings]
    skipped = run.manifest.get("skipped") or []
    items = [f"<li><strong>{escaped(label)}</strong>: {escaped(warning)}</li>" for label, warning in said]
    items += [f"<li>left out: {escaped(_sentence(item))}</li>" for item in skipped]
    if not items:
        return ""
    heading = '<h2 id="warnings">Before you trust a row</h2>'
    return f'<aside class="warnings" aria-labelledby="warnings">{heading}<ul>{"".join(items)}</ul></aside>'


def _sentence(item: object) -> str:
    return ", ".join(f"{k}: {v}" for k, v in item.items()) if isinstance(item, Mapping) else str(item)


def _group_section(run: Run, group: style.Group, several: bool) -> str:
    place, sources = _place(group), style.members(run, group)
    mark = f", n = {group[0]}, d = {group[1]}" if several else ""
    single = any(s.realizations == 1 for s in sources)
    told = "Under each value its standard error over realizations"
    told += ", where there are several. " if single else ". "
    told += (
        "★ and green: the best of its column in the direction its head gives;"
        " values that read the same tie. "
        "– is undefined; point at it, or see below. Point at a head for its definition, press it to sort."
    )
    if run.verdicts:
        told += " ▲ better and ▼ worse than the baseline, beyond three standard errors of the difference."
    overlay = _figure(loglog.figure(run, group), "Log-log overlay of the radial power of all sources")
    extra = ""
    if any(source.rdf is not None for source in sources):
        extra = _figure(rdf.figure(run, group), "Radial distribution functions of all sources")
        extra = f'<section id="rdf-{place}"><h2>Radial distribution function{mark}</h2>{extra}</section>'
    return (
        f'<section id="table-{place}"><h2>Measures{mark}</h2><p class="soft">{told}</p>'
        f"{_table(run, group)}</section>"
        f'<section id="gallery-{place}"><h2>Side by side{mark}</h2>{_gallery(run, sources)}</section>'
        f'<section id="loglog-{place}"><h2>Radial power, log-log{mark}</h2>'
        "<p>Mean power over each exact shell |f|. Power laws are straight lines; Gaussian blue noise is flat "
        f"and then curves up.</p>{overlay}</section>{extra}"
    )


def _table(run: Run, group: style.Group) -> str:
    heads = ['<th scope="col"><button type="button">source</button></th>']
    for column in table.COLUMNS:
        arrow = "lower is better" if column.better == "lower" else "higher is better"
        unit = f"&nbsp;[{escaped(column.unit)}]" if column.unit else ""
        title = escaped(f"{column.text} {arrow.capitalize()}. Source: {column.source}.")
        goal = "↓" if column.better == "lower" else "↑"
        heads.append(
            f'<th scope="col" title="{title}"><button type="button">{escaped(column.title)}</button>'
            f'<span class="goal" aria-label="{arrow}">{goal}{unit}</span></th>'
        )
    given = style.strokes(run)
    body = []
    for order, row in enumerate(table.rows(run, group)):
        label = escaped(table.row_label(row.source, run))
        cells = "".join(map(_cell, (row.cells[column.name] for column in table.COLUMNS)))
        swatch = _swatch(given[row.source.key])
        body.append(
            f'<tr data-order="{order}"><th scope="row" title="{label}">{swatch}{label}</th>{cells}</tr>'
        )
    return (
        f'<div class="scroll" tabindex="0" role="region" aria-label="Table of measures">'
        f'<table class="measures">'
        f"<thead><tr>{''.join(heads)}</tr></thead><tbody>{''.join(body)}</tbody></table></div>"
    )


def _cell(cell: table.Cell) -> str:
    if math.isnan(cell.value):
        reason = escaped(cell.reason or "undefined")
        return f'<td data-value=""><abbr title="{reason}">{NOTHING}</abbr></td>'
    kind = ' class="best"' if cell.best else ""
    star = '<span aria-label="best"> ★</span>' if cell.best else ""
    error = f'<span class="se">± {_exponent(cell)}</span>' if cell.error_text else ""
    verdict = ""
    if cell.verdict in table.MARKS:
        verdict = f'<span class="{cell.verdict}">{table.MARKS[cell.verdict]} {cell.verdict}</span>'
    value = f"{cell.value!r}" if math.isfinite(cell.value) else ("1e999" if cell.value > 0 else "-1e999")
    return f'<td{kind} data-value="{value}">{_power(cell.text)}{star}{error}{verdict}</td>'


def _power(text: str) -> str:
    mantissa, mark, exponent = text.partition("e")
    return f"{mantissa}·10<sup>{exponent.replace('-', '−')}</sup>" if mark else text.replace("-", "−")


def _exponent(cell: table.Cell) -> str:
    """Write the standard error with its value's power of ten."""
    _, mark, exponent = cell.text.partition("e")
    return _power(f"{cell.error_text}e{exponent}") if mark else cell.error_text


def _swatch(stroke: style.Stroke) -> str:
    turn = style.DASHES.index(stroke.dash)
    return f'<span class="swatch dash{turn}" style="border-color:{stroke.colour}"></span>'


def _image(content: bytes, alt: str) -> str:
    return (
        f'<img alt="{escaped(alt)}" src="data:image/png;base64,{base64.b64encode(content).decode("ascii")}">'
    )


def _figure(figure: Figure, alt: str) -> str:
    return f"<figure>{_image(png(figure), alt)}</figure>"


@style.styled
def _panel(
    draw: Callable[[Axes, SourceResult], None], ratio: float, plain: bool, source: SourceResult
) -> bytes:
    """One gallery picture: to the edge where it has no axes, else with room for their ticks."""
    room = 0.02 if plain else 0.27
    under = 0.02 if plain and ratio == 1.0 else 0.2
    height = PANEL * ratio if plain else PANEL * ratio + 0.1
    figure = Figure(figsize=(PANEL, height))
    ax = figure.add_axes(
        (room / PANEL, under / height, (PANEL - room - 0.03) / PANEL, (height - under - 0.04) / height)
    )
    draw(ax, source)
    return png(figure, dpi=160)


def _gallery(run: Run, sources: Sequence[SourceResult]) -> str:
    given = style.strokes(run)
    heads = "".join(
        f'<th scope="col" title="{escaped(s.label)}">{_swatch(given[s.key])}{escaped(s.label)}</th>'
        for s in sources
    )
    body = []
    lines = gallery.rows(run, sources)
    for name, ratio, draw in lines:
        plain = name not in ("radial power", "anisotropy\n(dB)")
        cells = [
            f"<td>{_image(_panel(draw, ratio, plain, s), ROWS[name].format(name=s.label))}</td>"
            for s in sources
        ]
        body.append(f'<tr><th scope="row">{escaped(name)}</th>{"".join(cells)}</tr>')
    said = [*map(points.note, sources), *map(spectrum.note, sources)]
    told = " ".join(dict.fromkeys(filter(None, said)))
    told = f'<p class="soft">{told}</p>' if told else ""
    return (
        f"{_keys(sources)}{told}"
        f'<div class="scroll" tabindex="0" role="region" aria-label="Gallery, a column a source">'
        f'<table class="gallery"><thead><tr><td></td>{heads}</tr></thead>'
        f"<tbody>{''.join(body)}</tbody></table></div>"
    )


def _keys(sources: Sequence[SourceResult]) -> str:
    """Say the colours of spectrum and valence in words."""
    scale = spectrum.norm(sources)
    stream = io.BytesIO()
    imsave(stream, np.tile(np.linspace(0, 1, 256), (4, 1)), cmap=spectrum.palette(), format="png")
    bar = _image(stream.getvalue(), "colour scale of the spectra, dark to bright")
    low, high = (
        f"10<sup>−{-math.log10(float(scale.vmin or spectrum.LOWEST)):.0f}</sup>",
        f"{spectrum.CEILING:g}",
    )
    parts = [f"<span>power, log10: {low} {bar} {high}, DC left out</span>"]
    if any(s.d == 2 for s in sources):
        parts.append("<span>valence:</span>")
        parts += [
            f'<span><i style="background:{paint}"></i>{valence.DEGREE_NAMES[k]}</span>'
            for k, paint in valence.DEGREE_COLOURS.items()
        ]
    parts.append("<span>dashed: isotropic noise over M realizations, −10 log10(M) dB</span>")
    return f'<div class="legend">{"".join(parts)}</div>'
