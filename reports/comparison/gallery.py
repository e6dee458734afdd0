"""Figure with all pictures of every source, one column for each source (Ahmed, Ren & Wonka 2022, Fig. 8)."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from gbnbench.reports import captions, layout, style
from gbnbench.reports.comparison import points, radial, spectrum, valence, zone_plate
from gbnbench.reports.comparison.left_out import left_out
from gbnbench.reports.source_groups import Group, members
from gbnbench.runs.comparison_result import Run, SourceResult

Draw = Callable[[Axes, SourceResult], None]


def rows(run: Run, sources: Sequence[SourceResult]) -> list[tuple[str, float, Draw]]:
    """List the rows of the gallery that these sources have data for.

    Parameters
    ----------
    run : Run
        The comparison.
    sources : sequence of SourceResult
        Columns of the gallery, which share the scales of their axes.

    Returns
    -------
    list of (str, float, callable)
        Title of each row, height of its panels over their width, and the function that draws a source
        into axes.
    """
    strokes = style.strokes(run)
    scale = spectrum.norm(sources)
    top, limits = radial.power_limit(sources), radial.decibel_limits(sources)
    flat = any(source.d == 2 for source in sources)
    found: list[tuple[str, float, Draw]] = [
        ("points", 1.0, points.panel),
        ("spectrum", 1.0, lambda ax, s: spectrum.panel(ax, s, scale, ticks=False)),
        ("radial power", 0.55, lambda ax, s: radial.power_panel(ax, s, strokes[s.key], top)),
        ("anisotropy\n(dB)", 0.32, lambda ax, s: radial.anisotropy_panel(ax, s, strokes[s.key], limits)),
    ]
    if any(source.zone_plate is not None for source in sources):
        found.append(("zone plate", 1.0, zone_plate.panel))
    if flat:
        found.append(("valence", 1.0, valence.panel))
    if any(source.valence is not None for source in sources):
        found.append(("valence\n(%)", 0.3, valence.histogram_panel))
    return found


@style.styled
def figure(run: Run, group: Group | None = None) -> Figure:
    """Draw points, spectrum, radial power, anisotropy, zone plate and valence of every source.

    Parameters
    ----------
    run : Run
        The comparison.
    group : (n, d), optional
        Draw only the sources of this size and dimension; all sources where not given.

    Returns
    -------
    Figure
        One column for each source.
    """
    sources = members(run, group)
    lines = rows(run, sources)
    names = [name for name, _, _ in lines]
    width = 2.4
    notes = [*map(points.note, sources), *map(spectrum.note, sources), left_out(sources)]
    caption = (
        "Rows: first realization; log10 of power, zero frequency in the middle, one scale for all; "
        "radial power on exact shells against nu; anisotropy with the line of isotropic noise"
        + ("; zone plate" if "zone plate" in names else "")
        + (
            "; Voronoi cells by valence with the share of each degree in percent"
            if "valence" in names
            else ""
        )
        + f". {' '.join(dict.fromkeys(filter(None, notes)))} "
    ).replace("  ", " ")
    gap = {"radial power": 0.08, "anisotropy\n(dB)": 0.32, "valence": 0.06}
    sheet = layout.sheet(
        "Side by side",
        caption + captions.settings(run, group),
        len(sources),
        width,
        [width * ratio for _, ratio, _ in lines],
        columns=12,
        gaps=[gap.get(name, 0.1) for name in names[:-1]],
        left=0.72,
        between=0.12,
        under=0.24,
        key=0.8 if "valence" in names else 0.55,
    )
    for stack, first, source in zip(sheet.cells, sheet.first, sources, strict=True):
        stack[0].set_title(captions.name(source, run, 26), loc="left", weight="bold")
        for ax, (name, _, draw) in zip(stack, lines, strict=True):
            draw(ax, source)
            if name == "radial power":
                ax.tick_params(labelbottom=False, labelleft=first)
            if name == "anisotropy\n(dB)":
                ax.tick_params(labelleft=first)
                ax.xaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10], prune="upper"))
            if first:
                ax.set_ylabel(name)
                ax.yaxis.set_label_coords(-0.15, 0.5)
    _keys(sheet, sources, "valence" in names)
    return sheet.figure


def _keys(sheet: layout.Sheet, sources: Sequence[SourceResult], valences: bool) -> None:
    if valences:
        valence.key(sheet)
        sheet = layout.Sheet(sheet.figure, sheet.cells, sheet.first, sheet.foot + 0.27)
    spectrum.add_colour_bar(sheet, spectrum.norm(sources))
