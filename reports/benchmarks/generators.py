"""Figure of the noise floor of every generator against the CPU time of a set.

Run it as ``python -m gbnbench.reports.benchmarks.generators TABLE.csv PICTURE.png``.
"""

from __future__ import annotations

import sys

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from gbnbench.generators.protocol import FAMILIES
from gbnbench.generators.registry import GENERATORS
from gbnbench.reports import layout, style

MARKERS = "ovsD^P"
HIGH, LONG = 0.026, 12  # of a name: share of the axis, and factor of time
ASIDE, LETTER = 1.25, 1.19  # factors of time: from a mark to its name, and of a letter
CAPTION = (
    "Mean power up to nu = 0.25 of one set of {n:,} points in 2D, white noise being 1, over CPU seconds of "
    "one thread. Right: the same between {low:g} and 2. Below 1e-29 only rounding is left. The floor is one "
    "measure of several: sets of fpo and others that keep points apart have high ones."
)
LOW = 1e-5


@style.styled
def figure(table: pd.DataFrame, n: int = 1024, d: int = 2) -> Figure:
    """Draw ``generators.csv``.

    Parameters
    ----------
    table : DataFrame
        Columns of ``gbnbench.benchmarks.experiments.generators.COLUMNS``.
    n, d : int
        Number of points and dimension of the rows that are drawn.

    Returns
    -------
    Figure
        All generators that were measured, and the larger floors in a panel of their own.
    """
    rows = table[(table.n == n) & (table.d == d) & table.cpu_s.notna()]
    sheet = layout.sheet(
        "What a noise floor costs", CAPTION.format(n=n, low=LOW), 2, 3.6, [3.9], columns=2, left=0.6,
        between=0.5, under=0.4, key=0.36, titles=False,
    )  # fmt: skip
    (everything,), (above,) = sheet.cells
    high = rows.noise_floor > LOW
    _panel(everything, rows, rows[~high])
    _panel(above, rows[high], rows[high])
    everything.set_ylabel("noise floor")
    handles = [
        Line2D([], [], color=style.COLOURS[k], marker=MARKERS[k], linestyle="", markersize=4)
        for k in range(len(FAMILIES))
    ]
    sheet.figure.legend(
        handles, list(FAMILIES), loc="lower center", ncols=len(FAMILIES), columnspacing=1.2,
        bbox_to_anchor=(0.5, (sheet.foot + 0.03) / sheet.figure.get_size_inches()[1]),
    )  # fmt: skip
    return sheet.figure


def _panel(ax: Axes, rows: pd.DataFrame, named: pd.DataFrame) -> None:
    """Mark all rows, and name some: from above down, below the last name where they would meet.

    A name stands left of its mark where it would cover another mark on the right and none there.
    """
    ax.set(xscale="log", yscale="log", xlabel="CPU seconds a set", xlim=(1e-4, 60))
    ax.grid()
    for name, x, y in zip(rows.generator, rows.cpu_s, rows.noise_floor, strict=True):
        k = FAMILIES.index(GENERATORS[name].family)
        ax.plot(x, y, MARKERS[k], color=style.COLOURS[k], markersize=3.6, zorder=3)
    chosen = named.sort_values("noise_floor", ascending=False)
    bottom, top = ax.get_ylim()
    gap = (top / bottom) ** HIGH
    placed: list[tuple[float, float]] = []
    for name, x, y in zip(chosen.generator, chosen.cpu_s, chosen.noise_floor, strict=True):
        at = y
        for other, height in placed:
            if max(x / other, other / x) < LONG and height / gap < at:
                at = height / gap
        placed.append((x, at))
        beside = rows[(rows.noise_floor / at).between(gap**-0.6, gap**0.6)].cpu_s / x
        long = ASIDE * LETTER ** len(name)
        free = not beside.between(1 / long, 0.95).any() and x / long > ax.get_xlim()[0]
        left = free and beside.between(1.05, long).any()
        ax.annotate(
            name, (x, y), xytext=(x / ASIDE if left else ASIDE * x, at), size=6, va="center",
            ha="right" if left else "left",
            arrowprops=None if at == y else {"arrowstyle": "-", "color": style.RULE, "linewidth": 0.5},
        )  # fmt: skip


def main(arguments: list[str]) -> None:
    """Draw the table into each file named after it, .png or .pdf."""
    drawn = figure(pd.read_csv(arguments[0]))
    for path in arguments[1:]:
        drawn.savefig(path, dpi=style.DPI)


if __name__ == "__main__":
    main(sys.argv[1:])
