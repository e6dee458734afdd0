"""Figure of time against error for every method of computing a power spectrum, one panel for each case."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patheffects import withStroke
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from gbnbench.reports import layout, style

WIDTH, HEIGHT, COLUMNS = 2.3, 1.9, 4  # inches; panels in a row
ROOM = 26  # points that the name of a precision takes beside its marker
# Colour, marker and dash of each family: told apart in any one of the three.
LOOKS: dict[str, tuple[str, str, Any]] = {
    "gbnbench": (style.COLOURS[1], "o", "-"),
    "two-group product": (style.COLOURS[4], "v", (0, (1, 1.2))),
    "FINUFFT": (style.COLOURS[0], "s", (0, (4, 1.5))),
    "ducc0, half": (style.COLOURS[7], "<", (0, (3, 1, 1, 1))),
    "ducc0, all": (style.COLOURS[7], ">", (0, (1, 1))),
    "gbnbench without a device": (style.COLOURS[5], "p", ""),
    "naive kernel": (style.COLOURS[6], "X", ""),
    "numpy separable": (style.COLOURS[2], "^", ""),
    "zgemm on ready tables": (style.COLOURS[3], "D", ""),
}
OTHER = (style.FAINT, "P", "")
CAPTION = (
    "CPU time over all threads against the root mean square error of sqrt(P) at random frequencies; "
    "lower left is better. Markers are the fastest round, bars reach to the median. A power P is known "
    "to 1% where the error is below sqrt(P)/200. gbnbench chooses the evaluation; where it is not the "
    "plain two-group product, that is drawn too. "
)


@style.styled
def figure(speed: pd.DataFrame, machine: Mapping[str, Any]) -> Figure:
    """Draw the table ``periodogram.csv``.

    Parameters
    ----------
    speed : DataFrame
        Columns of ``gbnbench.benchmarks.spectra.speed_error.SPEED``.
    machine : mapping
        The record ``machine.json``: processor, device, versions.

    Returns
    -------
    Figure
        CPU time against error, one panel for each case.
    """
    cases = list(dict.fromkeys(speed.case))
    drawn = speed[speed.error_rms.notna()]
    families = [f for f in [*LOOKS, *sorted(set(drawn.family) - set(LOOKS))] if f in set(drawn.family)]
    caption = CAPTION
    for library in ("FINUFFT", "ducc0, half", "ducc0, all"):
        if names := list(dict.fromkeys(drawn[drawn.family == library].method)):
            tolerances = ", ".join(name.removeprefix(f"{library} ") for name in names)
            caption += f"{library}, one thread, tolerances from right to left: {tolerances}. "
    sheet = layout.sheet(
        "What a spectrum costs, and how exact it is",
        caption + machine_line(machine),
        len(cases),
        WIDTH,
        [HEIGHT],
        columns=COLUMNS,
        left=0.6,
        between=0.46,
        under=0.46,
        key=0.58,
    )
    limits = float(drawn.error_rms.min()) / 30, float(drawn.error_rms.max()) * 6
    for (ax,), case, first in zip(sheet.cells, cases, sheet.first, strict=True):
        _panel(ax, speed[speed.case == case], families, limits)
        ax.set_title(case, loc="left")
        ax.set_xlabel("rms error of sqrt(P)")
        if first:
            ax.set_ylabel("CPU time [ms]")
    height = sheet.figure.get_size_inches()[1]
    sheet.figure.legend(
        handles=[_handle(family) for family in families],
        loc="lower center",
        ncols=-(-len(families) // 2),
        bbox_to_anchor=(0.5, (sheet.foot + 0.02) / height),
        handlelength=2.6,
        columnspacing=1.6,
    )
    return sheet.figure


def _panel(ax: Axes, rows: pd.DataFrame, families: list[str], limits: tuple[float, float]) -> None:
    ax.set_xscale("log")
    ax.set_xlim(*limits)
    ax.set_yscale("log")
    ax.grid(True)
    for family in families:
        part = rows[(rows.family == family) & rows.error_rms.notna()]
        if not len(part):
            continue
        colour, marker, dash = LOOKS.get(family, OTHER)
        front = 4 if family == "gbnbench" else 3
        ax.errorbar(
            part.error_rms,
            part.cpu_ms,
            yerr=np.vstack([np.zeros(len(part)), (part.cpu_ms_median - part.cpu_ms).clip(lower=0)]),
            color=colour,
            marker=marker,
            linestyle=dash or "none",
            markersize=4.6 if family == "gbnbench" else 3.8,
            linewidth=1.2,
            elinewidth=0.8,
            zorder=front,
        )
        if family == "gbnbench":
            for row in part.itertuples():
                at = float(str(row.error_rms)), float(str(row.cpu_ms))
                below = str(row.precision) == "double" or _crowded(rows[rows.family == "FINUFFT"], at)
                _name(ax, str(row.precision), at, colour, below)
    top, bottom = rows.cpu_ms[rows.error_rms.notna()].max(), rows.cpu_ms[rows.error_rms.notna()].min()
    ax.set_ylim(bottom / 2.6, top * 2.2)
    ax.yaxis.set_major_locator(LogLocator(subs=(1.0,) if top / bottom > 30 else (1.0, 3.0)))
    ax.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.xaxis.set_major_locator(LogLocator(numticks=6))
    ax.xaxis.set_minor_formatter(NullFormatter())
    for row in rows[rows.error_rms.isna()].itertuples():
        text = f"{row.method}: {float(str(row.cpu_ms)):,.0f} ms"
        ax.text(0.98, 0.97, text, transform=ax.transAxes, ha="right", va="top", size=6.5, color=style.FAINT)


def _crowded(curve: pd.DataFrame, at: tuple[float, float]) -> bool:
    """Return whether a curve passes above and to the right of a marker, where its name would stand."""
    if not len(curve):
        return False
    known = curve.sort_values("error_rms")
    beside = np.log(at[0] * np.array([2.0, 10.0, 50.0]))
    passing = np.interp(beside, np.log(known.error_rms.to_numpy(float)), np.log(known.cpu_ms.to_numpy(float)))
    return bool(((passing > np.log(0.95 * at[1])) & (passing < np.log(2.0 * at[1]))).any())


def _name(ax: Axes, precision: str, at: tuple[float, float], colour: str, below: bool) -> None:
    """Write the precision below its marker, or above and on the side where there is room."""
    left, right = ax.get_xlim()
    tight = 72 * WIDTH * np.log(right / at[0]) / np.log(right / left) < ROOM
    side = "center" if below else "right" if tight else "left"
    text = ax.annotate(
        precision,
        at,
        xytext=(0, -5) if below else (-4 if tight else 4, 3),
        textcoords="offset points",
        ha=side,
        va="top" if below else "bottom",
        size=6.5,
        color=colour,
        zorder=6,
    )
    text.set_path_effects([withStroke(linewidth=2, foreground="white")])


def _handle(family: str) -> Line2D:
    colour, marker, dash = LOOKS.get(family, OTHER)
    return Line2D([], [], color=colour, marker=marker, linestyle=dash or "none", markersize=4.2, label=family)


def machine_line(machine: Mapping[str, Any]) -> str:
    """Describe the machine of a benchmark in one line."""
    versions = machine.get("versions", {})
    parts = [f"{machine.get('processor', 'unknown processor')}, {machine.get('cores', '?')} cores"]
    parts.append(str(machine.get("device", "unknown device")))
    parts += [
        f"{name} {versions[name]}" for name in ("finufft", "ducc0", "numpy", "gbnbench") if versions.get(name)
    ]
    return " · ".join(parts)
