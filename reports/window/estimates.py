"""Figure of a window's estimates: points, structure factor with its confidence band, pair correlation."""

from __future__ import annotations

import io
from pathlib import Path

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from gbnbench.analysis.window.estimates import WindowEstimates
from gbnbench.core.atomic_write import write_whole
from gbnbench.core.torus import FloatArray
from gbnbench.reports import layout, style

WIDTH, HEIGHT = 2.7, 2.5  # inches of each panel
MOST_POINTS = 20_000  # that are drawn


def figure_name(path: Path, index: int, sets: int) -> Path:
    """Name the picture of one of several sets.

    Parameters
    ----------
    path : Path
        What the user named.
    index, sets : int
        Which set, and of how many.

    Returns
    -------
    Path
        ``name-0.png``, ``name-1.png``; of a single set the name itself.
    """
    return path if sets == 1 else path.with_name(f"{path.stem}-{index}{path.suffix}")


@style.styled
def figure(points: FloatArray, found: WindowEstimates, title: str) -> Figure:
    """Draw the estimates of one set.

    Parameters
    ----------
    points : (n, d) float64
        The set; its first two coordinates are drawn.
    found : WindowEstimates
        Its estimates.
    title : str
        Title, such as the name of the file.

    Returns
    -------
    Figure
    """
    page = layout.sheet(
        title, _caption(found), 3, WIDTH, (HEIGHT,), columns=3, between=0.55, under=0.42, left=0.55
    )
    (dots,), (spectrum,), (pairs,) = page.cells
    _points(dots, points, found)
    _structure_factor(spectrum, found)
    _pair_correlation(pairs, found)
    return page.figure


def save(path: Path, points: FloatArray, found: WindowEstimates, title: str) -> None:
    """Draw the estimates of one set into a file, whose extension names the format.

    Parameters
    ----------
    path : Path
        The file: .png, .pdf or .svg.
    points, found, title
        As for ``figure``.
    """
    with mpl.rc_context({"svg.hashsalt": "gbnbench"}):
        stream = io.BytesIO()
        figure(points, found, title).savefig(stream, format=path.suffix[1:].lower(), dpi=style.DPI)
    write_whole(path, stream.getvalue())


def _caption(found: WindowEstimates) -> str:
    sides = " x ".join(f"{side:g}" for side in found.window.sides)
    text = (
        f"{found.n} points in a window of {sides}. Middle: structure factor by "
        f"{' x '.join(map(str, found.tapers))} sine tapers with the 95% interval of each bin; hollow where "
        "the window does not resolve it, Poisson points at 1. Right: pair correlation with translation edge "
        "correction, one standard error to either side."
    )
    said = [
        f"{name} = {found.scalars[key]:.3g} +- {found.scalars.standard_error[key]:.2g}"
        for name, key in (("S(0)", "s_zero"), ("H", "hyperuniformity"), ("alpha", "exponent"))
        if np.isfinite(found.scalars[key])
    ]
    return text + (" Fitted: " + ", ".join(said) + "." if said else "")


def _points(ax: Axes, points: FloatArray, found: WindowEstimates) -> None:
    low, high = found.window.low, found.window.high
    shown = points[:: -(-len(points) // MOST_POINTS)]
    flat = found.d == 1
    size = float(np.clip(900 / len(shown), 0.3, 6.0))
    ax.scatter(
        shown[:, 0], np.zeros(len(shown)) if flat else shown[:, 1], s=size, color=style.INK, linewidths=0,
        rasterized=True,
    )  # fmt: skip
    ax.set_title("points" if found.d <= 2 else "points, first two axes")
    ax.set_xlim(low[0], high[0])
    ax.ticklabel_format(useMathText=True)  # of windows in any unit
    if flat:
        ax.set_yticks([])
        return
    ax.set_ylim(low[1], high[1])
    ax.set_aspect("equal", adjustable="box")


def _structure_factor(ax: Axes, found: WindowEstimates) -> None:
    table = found.structure_factor
    ax.axhline(1, color=style.RULE, linewidth=0.8, zorder=0)
    ax.fill_between(table["nu"], table["low"], table["high"], color=style.COLOURS[0], alpha=0.22, linewidth=0)
    ax.plot(table["nu"], table["S"], color=style.COLOURS[0], linewidth=0.9)
    for resolved in (True, False):
        part = table[table["resolved"] == resolved]
        ax.plot(
            part["nu"], part["S"], "o", markersize=2.4, color=style.COLOURS[0],
            markerfacecolor=style.COLOURS[0] if resolved else "white", markeredgewidth=0.7,
        )  # fmt: skip
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlabel(r"$\nu = k / (2 \pi) \cdot \lambda^{-1/d}$")
    ax.set_title("structure factor S")


def _pair_correlation(ax: Axes, found: WindowEstimates) -> None:
    table = found.pair_correlation
    ax.axhline(1, color=style.RULE, linewidth=0.8, zorder=0)
    ax.fill_between(
        table["spacings"], table["g"] - table["standard_error"], table["g"] + table["standard_error"],
        color=style.COLOURS[1], alpha=0.25, linewidth=0,
    )  # fmt: skip
    ax.plot(table["spacings"], table["g"], color=style.COLOURS[1], linewidth=0.9)
    ax.set_xlim(0, float(table["spacings"].iloc[-1]))
    ax.set_ylim(0, max(1.6, 1.08 * float(table["g"].max())))
    ax.set_xlabel("distance in mean spacings")
    ax.set_title("pair correlation g")
