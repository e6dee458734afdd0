"""Figure of radial distribution functions, the density of pairs at each distance over that of white noise."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.figure import Figure

from gbnbench.core.torus import FloatArray
from gbnbench.reports import captions, layout, style
from gbnbench.reports.source_groups import Group, members
from gbnbench.runs.comparison_result import Run

CAP = 5.0  # a lattice's shells are narrow and tall: the axis stops here
REACH = 5.0  # in densest spacings; beyond it every curve lies on 1


@style.styled
def figure(run: Run, group: Group | None = None) -> Figure:
    """Draw the radial distribution function of every source that has one.

    Parameters
    ----------
    run : Run
        The comparison.
    group : (n, d), optional
        Draw only the sources of this size and dimension; all sources where not given.

    Returns
    -------
    Figure
        One plot of all these sources.
    """
    strokes = style.strokes(run)
    drawn = [(s, s.rdf) for s in members(run, group) if s.rdf is not None]
    labels = [captions.name(source, run, 30) for source, _ in drawn]
    curves = [(t["r"].to_numpy(dtype=float), t["g"].to_numpy(dtype=float)) for _, t in drawn]
    tops = [float(np.nanmax(g)) for _, g in curves if np.isfinite(g).any()]
    top = min(CAP, 1.1 * max(tops, default=2.0))
    caption = "g(r) over all realizations, a step a bin, r in densest spacings; 1 is white noise. "
    if max(tops, default=0.0) > top:
        caption += f"The axis stops at {top:g}; the highest value is {max(tops):.3g}. "
    sheet = layout.sheet(
        "Radial distribution function",
        caption + captions.settings(run, group),
        1,
        6.0,
        [2.9],
        left=0.55,
        under=0.42,
        right=layout.legend_room(labels),
        titles=False,
    )
    ax = sheet.cells[0][0]
    ax.axhline(1, color=style.RULE, linewidth=0.9, zorder=0)
    handles = []
    for (source, _), (r, g) in zip(drawn, curves, strict=True):
        stroke = strokes[source.key]
        handles += ax.plot(
            *_steps(r, g), color=stroke.colour, linestyle=stroke.dash, linewidth=1.1, drawstyle="steps-post"
        )
    farthest = max((float(np.nanmax(_steps(r, g)[0])) for r, g in curves if len(r)), default=1.0)
    ax.set_xlim(0, min(REACH, farthest) if math.isfinite(farthest) and farthest > 0 else 1.0)
    ax.set_ylim(0, max(top, 1.5))
    ax.grid(True)
    ax.set_xlabel("r / densest spacing")
    ax.set_ylabel("g(r)")
    layout.beside(ax, handles, labels)
    return sheet.figure


def _steps(r: FloatArray, g: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Give where bins begin, and the last one ends, with the value from there on."""
    if len(r) < 2:
        return r, g
    return np.append(r, 2 * r[-1] - r[-2]), np.append(g, g[-1])
