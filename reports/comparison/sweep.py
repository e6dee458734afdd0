"""Figure of the measures against the number of points, for a run of several sizes."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from gbnbench.analysis.measure_definitions import BY_NAME
from gbnbench.reports import captions, layout, style
from gbnbench.reports.log_ticks import PowersOfTen
from gbnbench.reports.source_groups import Group
from gbnbench.runs.comparison_result import Run, SourceResult

# Each with whether its axis is logarithmic.
MEASURES = (
    ("noise_floor", True),
    ("power_at_1", True),
    ("evacuated_energy", False),
    ("peak", False),
    ("min_distance", False),
    ("psi6", False),
    ("effective_nyquist", False),
    ("cpu_seconds", True),
)


def several(run: Run) -> bool:
    """Return whether some source was measured at more than one n."""
    return any(len({s.n for s in line}) > 1 for line in lines(run).values())


def lines(run: Run) -> dict[tuple[str, int], list[SourceResult]]:
    """Group the sources of equal label and dimension by ascending n: the curves of the plot."""
    joined: dict[tuple[str, int], list[SourceResult]] = {}
    for source in run.sources:
        joined.setdefault((source.label, source.d), []).append(source)
    return {key: sorted(line, key=lambda s: s.n) for key, line in joined.items()}


def value(source: SourceResult, measure: str) -> tuple[float, float]:
    """Return a measure of a source with its standard error.

    Parameters
    ----------
    source : SourceResult
        Source that was measured.
    measure : str
        Name of a measure, or ``cpu_seconds``.

    Returns
    -------
    (float, float)
        Value and standard error; nan where undefined.
    """
    if measure == "cpu_seconds":
        return source.cpu_seconds, math.nan
    got = source.measures
    return got.measured.get(measure, math.nan), got.standard_error.get(measure, math.nan)


def panel(ax: Axes, run: Run, measure: str, logarithmic: bool) -> None:
    """Draw one measure against n, with a curve for each source and bars of one standard error.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    run : Run
        The comparison.
    measure : str
        Name of a measure, or ``cpu_seconds``.
    logarithmic : bool
        Draw the measure in log scale, without values of 0 or below.
    """
    strokes = style.strokes(run)
    if logarithmic:
        ax.set_yscale("log")
        ax.yaxis.set_major_formatter(PowersOfTen())
        ax.yaxis.set_minor_formatter(PowersOfTen())
    drawn = False
    for line in lines(run).values():
        n = np.array([s.n for s in line], dtype=float)
        pairs = [value(s, measure) for s in line]
        y, error = np.array([p[0] for p in pairs]), np.array([p[1] for p in pairs])
        if logarithmic:
            y = np.where(y > 0, y, np.nan)
        error = np.where(np.isfinite(error), error, 0.0)
        below = np.minimum(error, 0.9 * y) if logarithmic else error  # keeps the bar on the log axis
        stroke = strokes[line[0].key]
        if np.isfinite(y).any():
            drawn = True
            ax.errorbar(
                n,
                y,
                yerr=np.vstack([np.nan_to_num(below), error]),
                color=stroke.colour,
                linestyle=stroke.dash,
                marker="o",
                markersize=3,
                linewidth=1.1,
                elinewidth=0.8,
            )
    every = sorted({s.n for s in run.sources})
    ax.set_xscale("log", base=2)
    ax.set_xlim(every[0] / 1.25, every[-1] * 1.25)
    if len(every) <= 8:
        ax.xaxis.set_major_locator(FixedLocator(every))
        ax.xaxis.set_minor_locator(NullLocator())
    ax.xaxis.set_major_formatter(FuncFormatter(lambda n, _: f"{n:,.0f}"))
    ax.grid(True)
    if not drawn:
        layout.empty(ax, "undefined for all sources")


@style.styled
def figure(run: Run, group: Group | None = None) -> Figure:  # noqa: ARG001 - every figure is called alike
    """Draw the noise floor and other measures against n.

    Parameters
    ----------
    run : Run
        The comparison.
    group : (n, d), optional
        Not used: the figure shows the whole run. All figures are called with it.

    Returns
    -------
    Figure
        One panel for each measure.
    """
    joined = lines(run)
    many = len({d for _, d in joined}) > 1
    labels = [captions.shown(label, 30) + (f" (d={d})" if many else "") for label, d in joined]
    caption = "Each measure against the number of points; bars are one standard error over realizations. "
    sheet = layout.sheet(
        "Against the number of points",
        caption + captions.settings(run),
        len(MEASURES),
        2.3,
        [1.7],
        columns=4,
        left=0.55,
        between=0.5,
        under=0.45,
        right=layout.legend_room(labels),
    )
    strokes = style.strokes(run)
    for (ax,), (measure, logarithmic) in zip(sheet.cells, MEASURES, strict=True):
        panel(ax, run, measure, logarithmic)
        definition = BY_NAME.get(measure)
        title = "CPU seconds a set" if definition is None else definition.title
        unit = "" if definition is None or not definition.unit else f" [{definition.unit}]"
        ax.set_title(title + unit, loc="left")
        ax.set_xlabel("n")
    corner = sheet.cells[3][0]
    handles = [
        corner.plot(
            [],
            [],
            color=strokes[line[0].key].colour,
            linestyle=strokes[line[0].key].dash,
            marker="o",
            markersize=3,
        )[0]
        for line in joined.values()
    ]
    layout.beside(corner, handles, labels)
    return sheet.figure
