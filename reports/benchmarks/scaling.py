"""Figure of the cost of a spectrum as points, frequencies, dimensions and sets grow."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, MaxNLocator, NullFormatter, PercentFormatter

from gbnbench.reports import layout, style
from gbnbench.reports.benchmarks.speed_error import machine_line

# Colour, marker and dash of each method.
LOOKS: dict[str, tuple[str, str, Any]] = {
    "gbnbench double": (style.COLOURS[1], "o", "-"),
    "gbnbench float": (style.COLOURS[0], "s", "-"),
    "two-group product double": (style.COLOURS[4], "v", (0, (1, 1.2))),
    "two-group product float": (style.COLOURS[5], "^", (0, (1, 1.2))),
}
PLAIN = {"double": "two-group product double", "float": "two-group product float"}
SWEPT = {"n": "n", "F": "F", "d": "d", "realizations": "sets"}
TITLES = {"n": "points", "F": "frequencies", "d": "dimensions", "realizations": "sets"}
CAPTION = (
    "CPU time over all threads, fastest round, against the operations of the plain product: two a "
    "frequency of the cube and point. The grey line has slope 1. Where dimensions grow, the number of "
    "frequencies stays near 20,000 as far as it can, and time is that of 1e9 operations. gbnbench "
    "chooses the evaluation; where it is not the plain two-group product, that is drawn too. Below: the"
    " plain product's share of what one core can do, by a loop of multiply-adds in the same process. "
)


@style.styled
def figure(scaling: pd.DataFrame, machine: Mapping[str, Any]) -> Figure:
    """Draw the table ``scaling.csv``.

    Parameters
    ----------
    scaling : DataFrame
        Columns of ``gbnbench.benchmarks.spectra.scaling.SCALING``.
    machine : mapping
        The record ``machine.json``.

    Returns
    -------
    Figure
        CPU time, and below it the share of peak speed, one column for each quantity that is varied.
    """
    sweeps = list(dict.fromkeys(scaling.sweep))
    sheet = layout.sheet(
        "How the cost grows",
        CAPTION + machine_line(machine),
        len(sweeps),
        2.3,
        [1.9, 0.95],
        gaps=[0.14],
        left=0.62,
        between=0.6,
        under=0.46,
        key=0.34,
    )
    for (above, below), sweep in zip(sheet.cells, sweeps, strict=True):
        part = scaling[scaling.sweep == sweep]
        across = "d" if sweep == "d" else "flops"
        _cost(above, part, sweep, across)
        _share(below, part, across)
        for ax in (above, below):
            _abscissa(ax, part, across)
        above.set_title(f"More {TITLES.get(sweep, sweep)}{_fixed(part)}", loc="left")
        above.tick_params(labelbottom=False)
        above.set_ylabel("ms of 1e9 operations" if sweep == "d" else "CPU time [ms]")
        below.set_xlabel("d" if sweep == "d" else "operations")
        below.set_ylabel("of peak")
    handles = {
        str(line.get_label()): line
        for above, _ in sheet.cells
        for line in above.lines
        if line.get_label() in LOOKS
    }
    names = [name for name in LOOKS if name in handles]
    sheet.figure.legend(
        [handles[name] for name in names],
        names,
        loc="lower center",
        ncols=len(names),
        bbox_to_anchor=(0.5, (sheet.foot + 0.02) / sheet.figure.get_size_inches()[1]),
        handlelength=2.6,
    )
    return sheet.figure


def _cost(ax: Axes, part: pd.DataFrame, sweep: str, across: str) -> None:
    """Time against work, the first and last sizes named; time an operation where dimensions grow."""
    part = part.assign(shown=part.cpu_ms / part.flops * 1e9 if sweep == "d" else part.cpu_ms)
    ax.set_yscale("log")
    ax.grid(True)
    for method, (colour, marker, dash) in LOOKS.items():
        rows = part[part.method == method]
        if len(rows):
            ax.plot(
                rows[across], rows.shown, color=colour, marker=marker, linestyle=dash,
                markersize=3.2, label=method, zorder=4 if method.startswith("gbnbench") else 3,
            )  # fmt: skip
    least, most = float(part.shown.min()), float(part.shown.max())
    ax.set_ylim(least / 2.4, most * 2.4)
    if sweep != "d":
        ends = part.sort_values("flops")
        _slope_one(ax, ends)
        _name(ax, ends.iloc[0], least, sweep, first=True)
        _name(ax, ends.iloc[-1], most, sweep, first=False)
    ax.yaxis.set_major_locator(LogLocator(subs=(1.0,) if most / least > 15 else (1.0, 2.0, 5.0)))
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.yaxis.set_minor_formatter(NullFormatter())


def _name(ax: Axes, row: Any, at: float, sweep: str, first: bool) -> None:
    """Write an end's size: the first under the curves, the last over them."""
    ax.annotate(
        f"{SWEPT[sweep]} = {int(row[SWEPT[sweep]]):,}",
        (row.flops, at),
        xytext=(-3, -5) if first else (3, 5),
        textcoords="offset points",
        ha="left" if first else "right",
        va="top" if first else "bottom",
        size=6.5,
        color=style.FAINT,
    )


def _slope_one(ax: Axes, ends: pd.DataFrame) -> None:
    """Draw a line of slope 1 through our largest size in the first precision, as far as it was met."""
    ours = ends[ends.family == "gbnbench"]
    ours = ours[ours.precision == ours.precision.iloc[0]]
    if len(ours) < 2:
        return
    end = ours.iloc[-1]
    start = max(float(ours.flops.iloc[0]), float(end.flops * ours.cpu_ms.min() / end.cpu_ms))
    line = [start, float(end.flops)]
    ax.plot(line, [end.cpu_ms * x / end.flops for x in line], color=style.RULE, linewidth=3, zorder=1)


def _share(ax: Axes, part: pd.DataFrame, across: str) -> None:
    """Share of the peak, of the plain product at every size."""
    known = part[part.share_of_peak.notna()]
    if not len(known):
        layout.empty(ax, "peak not measured")
        return
    for precision, rows in known.groupby("precision"):
        colour, marker, dash = LOOKS[PLAIN[str(precision)]]
        ax.plot(rows[across], rows.share_of_peak, color=colour, marker=marker, linestyle=dash, markersize=3.0)
    ax.set_ylim(0, max(1.0, 1.05 * float(known.share_of_peak.max())))
    ax.yaxis.set_major_formatter(PercentFormatter(1.0, decimals=0))
    ax.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2.5, 5, 10]))
    ax.grid(True)


def _abscissa(ax: Axes, part: pd.DataFrame, across: str) -> None:
    low, high = float(part[across].min()), float(part[across].max())
    if across == "d":
        ax.set_xlim(low - 0.5, high + 0.5)
        ax.xaxis.set_major_locator(MaxNLocator(integer=True))
        return
    ax.set_xscale("log")
    ax.set_xlim(low / 1.6, high * 1.6)
    ax.xaxis.set_major_locator(LogLocator(numticks=6))
    ax.xaxis.set_minor_formatter(NullFormatter())


def _fixed(part: pd.DataFrame) -> str:
    """Say what stays the same over a sweep."""
    said = [f"{name}={int(part[name].iloc[0])}" for name in ("n", "d", "F") if part[name].nunique() == 1]
    return ": " + " ".join(said) if said else ""
