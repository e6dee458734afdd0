"""Figure of the noise floor against the CPU time of each optimiser, and of the cost of cut-offs."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from gbnbench.generators.gbn.operation_counts import CUTOFF
from gbnbench.generators.gbn.published_quality import AUTHORS_FLOOR
from gbnbench.reports import layout, style
from gbnbench.reports.benchmarks.speed_error import machine_line

WIDTH, HEIGHT, COLUMNS = 2.35, 2.05, 4  # inches; panels in a row
# Colour and marker of each method; the precision is in the dash and the marker's fill.
LOOKS: dict[str, tuple[str, str]] = {
    "Nesterov": (style.COLOURS[1], "o"),
    "descent": (style.COLOURS[0], "s"),
    "descent, authors' step": (style.COLOURS[2], "^"),
}
PRECISIONS: dict[str, Any] = {"double": "-", "float": (0, (2.2, 1.4))}
OTHER = (style.FAINT, "P")
CAPTION = (
    "Noise floor, the mean power over 0 < nu <= 0.25 (the lowest shell where that is empty), of points after "
    "so many gradients (numbers at the ends of the curves), against CPU time of the optimiser alone on one "
    "set; lower left is better. Curves are geometric means over sets, bars reach over the sets. Kernel width "
    "1 spacing; authors' step 0.25 n^(2/d)/n, ours 1.2 over the largest curvature, in 2D nearly the same. "
    "Grey line: mean floor of ten sets made by the authors' program, 10,000 steps at n=1024; its time is not "
    "shown, being of another machine. Forces: error against every pair and image in long double, in units of "
    "the largest force of one pair; the kernel called whole leaves out pairs beyond 9 sigma in double and 6 "
    "in float. "
)
GRID = "In one dimension the last sets are regular grids, whose floor is rounding. "


@style.styled
def figure(floors: pd.DataFrame, forces: pd.DataFrame, machine: Mapping[str, Any]) -> Figure:
    """Draw the tables ``floor_time.csv`` and ``forces.csv``.

    Parameters
    ----------
    floors : DataFrame
        Columns of ``gbnbench.benchmarks.gbn.floor_time.FLOOR_TIME``.
    forces : DataFrame
        Columns of ``gbnbench.benchmarks.gbn.cutoffs.FORCES``.
    machine : mapping
        The record ``machine.json``.

    Returns
    -------
    Figure
        Noise floor against CPU time, one panel for each case, and panels of the cut-offs.
    """
    whole, cut = floors[floors.kernel == "whole"], floors[floors.kernel != "whole"]
    panels: list[tuple[str, Any, pd.DataFrame]] = [
        (str(case), _race, rows) for case, rows in whole.groupby("case", sort=False)
    ]
    panels += [(f"{case}, kernel cut off", _cutoffs, rows) for case, rows in cut.groupby("case", sort=False)]
    panels += [(f"{case}, forces", _forces, rows) for case, rows in forces.groupby("case", sort=False)]
    sheet = layout.sheet(
        "How deep in what time: Gaussian Blue Noise",
        CAPTION + (GRID if _regular(whole) else "") + machine_line(machine),
        len(panels),
        WIDTH,
        [HEIGHT],
        columns=COLUMNS,
        left=0.66,
        between=0.62,
        under=0.46,
        key=0.34,
        right=0.3,
    )
    for (ax,), (title, draw, rows) in zip(sheet.cells, panels, strict=True):
        ax.set_xscale("log")
        ax.set_yscale("log")
        ax.grid(True)
        ax.set_title(title, loc="left")
        draw(ax, rows)
        for axis in (ax.xaxis, ax.yaxis):
            axis.set_minor_formatter(NullFormatter())
    met = [name for name in LOOKS if name in set(whole.curve)]
    handles = [_handle(name, "double", name) for name in met]
    handles += [_handle("", p, p) for p in PRECISIONS if p in set(floors.precision) | set(forces.precision)]
    sheet.figure.legend(
        handles=handles,
        loc="lower center",
        ncols=len(handles),
        bbox_to_anchor=(0.5, (sheet.foot + 0.02) / sheet.figure.get_size_inches()[1]),
        handlelength=2.8,
        columnspacing=1.6,
    )
    return sheet.figure


def _regular(whole: pd.DataFrame) -> bool:
    """Return whether sets on the line became regular grids, which have all their power in a peak of n."""
    line = whole[whole.d == 1]
    return bool((line.peak > 0.99 * line.n).any())


def _race(ax: Axes, rows: pd.DataFrame) -> None:
    """Draw every method and precision on the whole kernel."""
    for (name, precision), part in rows.groupby(["curve", "precision"], sort=False):
        colour, marker = LOOKS.get(str(name), OTHER)
        _curve(ax, part, colour, marker, str(precision), numbered=precision == "double")
    _floor_axes(ax, rows)


def _cutoffs(ax: Axes, rows: pd.DataFrame) -> None:
    """Draw one curve a cut-off, from light to dark."""
    cutoffs = sorted(set(rows.cutoff))
    shades = mpl.colormaps["viridis"](np.linspace(0.88, 0.0, len(cutoffs)))
    marks = "vsD^oP"
    handles = []
    for k, (cutoff, shade) in enumerate(zip(cutoffs, shades, strict=True)):
        colour = to_hex(shade)
        _curve(ax, rows[rows.cutoff == cutoff], colour, marks[k % len(marks)], "double", numbered=False)
        handles.append(
            Line2D([], [], color=colour, marker=marks[k % len(marks)], markersize=3, label=f"{cutoff:g}")
        )
    ax.legend(
        handles=handles, title="kernel ends at, in sigmas", loc="lower left", fontsize=6.5,
        title_fontsize=6.5, ncols=3, handlelength=1.6, columnspacing=0.9, labelspacing=0.25,
        borderaxespad=0.1, alignment="left",
    )  # fmt: skip
    _floor_axes(ax, rows, room=3000)


def _forces(ax: Axes, rows: pd.DataFrame) -> None:
    """Draw the time of one gradient against its error."""
    for precision, part in rows.groupby("precision", sort=False):
        colour = style.COLOURS[1] if precision == "double" else style.COLOURS[5]
        cut = part[part.kernel != "whole"].sort_values("cutoff")
        ax.plot(
            cut.error_rms, cut.cpu_ms, color=colour, linestyle=PRECISIONS[str(precision)], marker="o",
            markersize=3.4, markerfacecolor=colour if precision == "double" else "white",
        )  # fmt: skip
        whole = part[part.kernel == "whole"]
        ax.plot(whole.error_rms, whole.cpu_ms, "*", color=colour, markersize=8, zorder=5)
        for cutoff, error, spent in zip(cut.cutoff, cut.error_rms, cut.cpu_ms, strict=True):
            shift, side = (0, 4 if precision == "double" else -4), "center"
            if precision == "float" and cutoff > CUTOFF["float"]:  # no more exact: one over the other
                shift, side = (-5, 0), "right"
            _name(ax, f"{cutoff:g}", (error, spent), shift, side)
    handles = [
        Line2D([], [], color=style.COLOURS[1], marker="o", markersize=3.4, label="double"),
        Line2D(
            [], [], color=style.COLOURS[5], marker="o", markersize=3.4, markerfacecolor="white",
            linestyle=PRECISIONS["float"], label="float",
        ),
        Line2D([], [], color=style.FAINT, marker="*", linestyle="none", markersize=7, label="whole"),
    ]  # fmt: skip
    ax.legend(handles=handles, loc="upper right", fontsize=6.5, handlelength=1.8, labelspacing=0.25)
    low, high = float(rows.cpu_ms.min()), float(rows.cpu_ms.max())
    ax.set_ylim(low / 1.35, high * 1.45)
    ax.set_xlim(float(rows.error_rms.min()) / 8, float(rows.error_rms.max()) * 8)
    ax.xaxis.set_major_locator(LogLocator(numticks=6))
    ax.yaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.set_xlabel("rms error of forces")
    ax.set_ylabel("CPU time of a gradient [ms]")


def _curve(ax: Axes, part: pd.DataFrame, colour: str, marker: str, precision: str, numbered: bool) -> None:
    """Draw geometric means over sets at each stop, bars from the lowest to the highest floor."""
    columns = ["cpu_s", "noise_floor"]
    mean = part[columns].map(math.log).groupby(part.gradients).mean().map(math.exp)
    least, most = (part.groupby("gradients").noise_floor.agg(end) for end in ("min", "max"))
    bars = np.vstack([mean.noise_floor - least, most - mean.noise_floor]).clip(min=0)
    double = precision == "double"
    ax.errorbar(
        mean.cpu_s, mean.noise_floor, yerr=bars, color=colour, marker=marker, linestyle=PRECISIONS[precision],
        markersize=3.6, markerfacecolor=colour if double else "white", linewidth=1.1, elinewidth=0.7,
        zorder=3 if double else 4,
    )  # fmt: skip
    if numbered:
        at = float(mean.cpu_s.to_numpy()[-1]), float(mean.noise_floor.to_numpy()[-1])
        above = set(part.step) == {"authors"}  # where descent is below
        _name(ax, f"{int(mean.index[-1]):,}", at, (0, 5 if above else -6), "center", colour)


def _floor_axes(ax: Axes, rows: pd.DataFrame, room: float = 12) -> None:
    """Set limits and ticks, with room below the deepest floor, and draw the authors' floor in the plane."""
    low, high = float(rows.noise_floor.min()), float(rows.noise_floor.max())
    if int(rows.d.iloc[0]) == 2:
        low = min(low, AUTHORS_FLOOR)
        ax.axhline(AUTHORS_FLOOR, color=style.FAINT, linewidth=0.8, zorder=1)
        text = ax.text(
            0.015, AUTHORS_FLOOR / 1.25, f"authors' sets: {AUTHORS_FLOOR:.1e}", size=6.2, color=style.FAINT,
            transform=ax.get_yaxis_transform(), ha="left", va="top", zorder=6,
        )  # fmt: skip
        text.set_path_effects([withStroke(linewidth=2, foreground="white")])
    ax.set_ylim(low / room, high * 3)
    least, most = float(rows.cpu_s.min()) / 1.5, float(rows.cpu_s.max()) * 2.2
    ax.set_xlim(least, most)
    ax.yaxis.set_major_locator(LogLocator(numticks=8))
    ax.xaxis.set_major_locator(LogLocator(subs=(1.0,) if most / least > 30 else (1.0, 2.0, 5.0), numticks=6))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.set_xlabel("CPU time [s]")
    ax.set_ylabel("noise floor")


def _name(
    ax: Axes,
    text: str,
    at: tuple[float, float],
    shift: tuple[float, float],
    side: str,
    colour: str = style.FAINT,
) -> None:
    note = ax.annotate(
        text, at, xytext=shift, textcoords="offset points", ha=side, size=6.2, color=colour, zorder=6,
        va=("top", "center", "bottom")[1 + (shift[1] > 0) - (shift[1] < 0)],
    )  # fmt: skip
    note.set_path_effects([withStroke(linewidth=2, foreground="white")])


def _handle(name: str, precision: str, label: str) -> Line2D:
    colour, marker = LOOKS.get(name, (style.INK, "o"))
    return Line2D(
        [], [], color=colour, marker=marker, linestyle=PRECISIONS[precision], markersize=3.8, label=label,
        markerfacecolor=colour if precision == "double" else "white",
    )  # fmt: skip
