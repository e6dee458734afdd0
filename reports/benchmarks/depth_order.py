"""Figure of the order of deep sets against the freedom that the band takes, and of depth against order.

Run it as ``python -m gbnbench.reports.benchmarks.depth_order TABLE.csv PICTURE.png``.
"""

from __future__ import annotations

import sys
from typing import Any

import matplotlib as mpl
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullFormatter, NullLocator

from gbnbench.reports import layout, style

ORDER = (
    ("valence6", "neighbours: share of 6", False),
    ("psi6", r"$\psi_6$", False),
    ("peak", "peak of radial power", False),
    ("excess", "excess energy a point", True),
)
MARKERS = "os^vDP*X"
REFERENCES = (100, 320, 1000)
BESIDE: dict[str, Any] = {
    "color": style.INK, "linestyle": (0, (4, 1.5)), "marker": "s", "markersize": 3.2, "mfc": "white"
}  # fmt: skip
CAPTION = (
    "Means over {seeds} seeds; n = {n}, d = {d}. A curve a steepness c of P = exp(-c (edge² - nu²)), a point "
    "an edge from {low:g} to {high:g}; all from {start} gradients of Gaussian Blue Noise but for the last "
    "panel. Bars: least and most of the seeds. 2 chi = V_d edge^d / d: share of the coordinates that the "
    "band binds. Grey lines, and numbers beside squares: Gaussian Blue Noise (GBN) after so many gradients. "
    "Floors below 1e-28 are rounding. Starts that did not converge: {failed} of {tried}."
)


def means(table: pd.DataFrame, n: int, d: int) -> pd.DataFrame:
    """Summarise the converged seeds of each setting by their mean, least and greatest value.

    Parameters
    ----------
    table : DataFrame
        Rows of ``depth_order.csv``, one for each setting and seed.
    n, d : int
        Number of points and dimension of the rows that are used.

    Returns
    -------
    DataFrame
        One row for each generator, steepness, edge, number of gradients and chi. Each measure has a
        column of its mean, and columns ending in ``_min`` and ``_max``.
    """
    part = table[(table.n == n) & (table.d == d) & table.converged.astype(str).eq("True")]
    keys = ["generator", "c_pi2", "edge", "gradients", "chi"]
    names = [*(name for name, *_ in ORDER), "noise_floor"]
    grouped = part.groupby(keys, dropna=False)[names].agg(["mean", "min", "max"])
    grouped.columns = pd.Index(["_".join(pair).removesuffix("_mean") for pair in grouped.columns.to_list()])
    return grouped.reset_index()


@style.styled
def figure(table: pd.DataFrame, n: int = 1024, d: int = 2, start: int = 100) -> Figure:
    """Draw ``depth_order.csv``.

    Parameters
    ----------
    table : DataFrame
        Columns of ``gbnbench.benchmarks.experiments.depth_order_row.COLUMNS``.
    n, d : int
        Number of points and dimension of the rows that are drawn.
    start : int
        Gradients of Gaussian Blue Noise that the drawn sets started from.

    Returns
    -------
    Figure
        One panel for each measure of order against chi, and a last one of the noise floor against
        order.
    """
    found = means(table, n, d)
    deep, gbn = found[found.generator == "deep"], found[found.generator == "gbn"].sort_values("gradients")
    tried = table[(table.n == n) & (table.d == d) & (table.generator == "deep")]
    steep = sorted(deep.c_pi2.unique())
    edges = sorted(deep.edge.unique())
    caption = CAPTION.format(
        seeds=tried.seed.nunique(), n=n, d=d, start=start, low=edges[0], high=edges[-1],
        failed=int((~tried.converged.astype(str).eq("True")).sum()), tried=len(tried),
    )  # fmt: skip
    sheet = layout.sheet(
        "What depth costs in order", caption, len(ORDER) + 2, 2.35, [1.9], columns=3, left=0.6,
        between=0.92, right=0.5, under=0.44, key=0.36, titles=True,
    )  # fmt: skip
    looks = dict(zip(steep, zip(_colours(len(steep)), MARKERS, strict=False), strict=True))
    axes = [stack[0] for stack in sheet.cells]
    here = deep[deep.gradients == start]
    for ax, (name, label, logarithmic) in zip(axes, ORDER, strict=False):
        ax.set_title(label, loc="left")
        ax.set_xlabel(r"share of coordinates bound, $2\chi$")
        if logarithmic:
            ax.set_yscale("log")
        for c, (colour, marker) in looks.items():
            line = here[here.c_pi2 == c].sort_values("chi")
            bars = [line[name] - line[f"{name}_min"], line[f"{name}_max"] - line[name]]
            ax.errorbar(
                2 * line.chi,
                line[name],
                bars,
                color=colour,
                marker=marker,
                markersize=3,
                elinewidth=0.5,
                zorder=3,
            )
        _reference(ax, gbn, name)
    _depth(axes[4], here, gbn, looks)
    _starts(axes[5], deep, gbn, looks)
    handles = [
        Line2D([], [], color=colour, marker=marker, markersize=3.5) for colour, marker in looks.values()
    ]
    names = [rf"$c = {c:g}\,\pi^2$" for c in looks]
    handles.append(Line2D([], [], **BESIDE))
    names.append("Gaussian Blue Noise")
    sheet.figure.legend(
        handles, names, loc="lower center", ncols=len(names), columnspacing=1.4,
        bbox_to_anchor=(0.5, (sheet.foot + 0.03) / sheet.figure.get_size_inches()[1]),
    )  # fmt: skip
    return sheet.figure


def _colours(count: int) -> list[str]:
    """From light to dark, in order of steepness."""
    ramp = mpl.colormaps["viridis_r"](np.linspace(0.12, 1.0, count))
    return [to_hex(colour) for colour in ramp]


def _reference(ax: Axes, gbn: pd.DataFrame, name: str) -> None:
    """Lines at Gaussian Blue Noise of each length."""
    for gradients, value in zip(gbn.gradients, gbn[name], strict=True):
        if gradients in REFERENCES:
            ax.axhline(value, color="#9aa3af", linewidth=0.8, zorder=1)
            ax.annotate(
                f"GBN\n{gradients:,}", (1.01, value), xycoords=("axes fraction", "data"), va="center", size=6,
                color=style.FAINT, linespacing=0.95,
            )  # fmt: skip


def _depth(ax: Axes, here: pd.DataFrame, gbn: pd.DataFrame, looks: dict[float, tuple[str, str]]) -> None:
    """Noise floor against psi6: right and down is what one wants less and more of."""
    ax.set_title("depth against order", loc="left")
    ax.set_yscale("log")
    ax.set_xlabel(r"$\psi_6$")
    ax.set_ylabel("noise floor")
    for c, (colour, marker) in looks.items():
        line = here[here.c_pi2 == c].sort_values("edge")
        ax.plot(line.psi6, line.noise_floor, color=colour, marker=marker, markersize=3)
    ax.plot(gbn.psi6, gbn.noise_floor, zorder=4, **BESIDE)
    for gradients, x, y in zip(gbn.gradients, gbn.psi6, gbn.noise_floor, strict=True):
        if gradients in REFERENCES:
            ax.annotate(
                f"{gradients:,}",
                (x, y),
                xytext=(3, 4),
                textcoords="offset points",
                size=6,
                color=style.FAINT,
                bbox={"facecolor": "white", "alpha": 0.8, "edgecolor": "none", "pad": 0.4},
                zorder=5,
            )
    ax.yaxis.set_major_locator(LogLocator(numticks=7))
    ax.yaxis.set_minor_locator(NullLocator())


def _starts(ax: Axes, deep: pd.DataFrame, gbn: pd.DataFrame, looks: dict[float, tuple[str, str]]) -> None:
    """psi6 against the length of the start, at the middle steepness, one curve an edge."""
    c = 8.0 if 8.0 in looks else list(looks)[len(looks) // 2]
    ax.set_title(rf"longer starts, $c = {c:g}\,\pi^2$", loc="left")
    ax.set_xscale("log")
    ax.set_xlabel("gradients of the start")
    ax.set_ylabel(r"$\psi_6$")
    edges = sorted(deep.edge.unique())
    shown = [edges[k] for k in sorted({0, len(edges) // 2, len(edges) - 1})]
    for edge, dash in zip(shown, style.DASHES, strict=False):
        line = deep[(deep.c_pi2 == c) & (deep.edge == edge)].sort_values("gradients")
        colour, marker = looks[c]
        ax.plot(
            line.gradients, line.psi6, color=colour, linestyle=dash, marker=marker, markersize=3,
            label=f"edge {edge:g}",
        )  # fmt: skip
    ax.plot(gbn.gradients, gbn.psi6, label="GBN", **BESIDE)
    ticks = sorted(gbn.gradients.unique())
    ax.xaxis.set_major_locator(FixedLocator([t for t in ticks if t in (25, 50, 100, 200, 320, 1000)]))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.xaxis.set_minor_formatter(NullFormatter())
    ax.xaxis.set_minor_locator(NullLocator())
    ax.set_ylim(top=ax.get_ylim()[1] + 0.25 * (ax.get_ylim()[1] - ax.get_ylim()[0]))
    ax.legend(fontsize=6.5, loc="upper left", handlelength=2.4, ncols=2, columnspacing=1)


def main(arguments: list[str]) -> None:
    """Draw the table into each file named after it, .png or .pdf."""
    drawn = figure(pd.read_csv(arguments[0]))
    for path in arguments[1:]:
        drawn.savefig(path, dpi=style.DPI * 0.85)


if __name__ == "__main__":
    main(sys.argv[1:])
