"""Figure of the radial power over exact shells, and below it the anisotropy of the rings, against nu."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from gbnbench.reports import captions, layout, style
from gbnbench.reports.source_groups import Group, members
from gbnbench.runs.comparison_result import Run, SourceResult

CAP = 6.0  # a lattice's harmonics carry power n: the axis stops here and the panel says what it leaves out
FEW = 40  # with fewer shells than this each one gets a dot


def power_limit(sources: Sequence[SourceResult]) -> float:
    """Return the upper end of the power axis that all sources share."""
    tops = [float(np.nanmax(s.radial.power)) for s in sources if np.isfinite(s.radial.power).any()]
    return min(CAP, max([2.0, *(1.12 * top for top in tops)]))


def decibel_limits(sources: Sequence[SourceResult]) -> tuple[float, float]:
    """Return the range of the anisotropy axis that all sources share, in whole steps of 5 dB."""
    values = [-10 * math.log10(max(s.realizations, 1)) for s in sources]
    for source in sources:
        decibel = source.anisotropy["anisotropy_db"].to_numpy(dtype=float)
        values += [float(v) for v in decibel[np.isfinite(decibel)]]
    low, high = max(min(values), -40.0), min(max(values), 40.0)
    return 5 * math.floor((low - 2) / 5), 5 * math.ceil((high + 2) / 5)


def power_panel(ax: Axes, source: SourceResult, stroke: style.Stroke, top: float) -> None:
    """Draw the radial power, one value for each shell, with the line of white noise at 1.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    source : SourceResult
        Source to draw.
    stroke : Stroke
        Colour and dash of the curve.
    top : float
        Upper end of the power axis, as ``power_limit`` gives it.
    """
    nu, power = source.radial.nu, source.radial.power
    ax.axhline(1, color=style.RULE, linewidth=0.8, zorder=0)
    marker = "o" if len(nu) < FEW else ""
    ax.plot(
        nu,
        power,
        color=stroke.colour,
        linewidth=0.9,
        marker=marker,
        markersize=2.6,
        rasterized=len(nu) > 4000,
    )
    ax.set_xlim(0, reach(source))
    ax.set_ylim(0, top)
    ax.xaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10], prune="upper"))
    finite = power[np.isfinite(power)]
    if finite.size and float(finite.max()) > top:
        ax.text(
            0.98,
            0.95,
            f"up to {finite.max():.3g} ↑",
            transform=ax.transAxes,
            ha="right",
            va="top",
            size=6.5,
            color=style.FAINT,
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 1.2, "alpha": 0.85},
        )


def reach(source: SourceResult) -> float:
    """End of the axis of nu: past the last shell and the last ring, which may lie beyond a part of it."""
    nu = [*source.radial.nu[-1:], *source.anisotropy["nu"][-1:]]
    return 1.02 * float(max(nu)) if nu else 1.0


def anisotropy_panel(
    ax: Axes, source: SourceResult, stroke: style.Stroke, limits: tuple[float, float]
) -> None:
    """Draw the anisotropy of the rings, with the line of isotropic noise over as many realizations.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    source : SourceResult
        Source to draw.
    stroke : Stroke
        Colour and dash of the curve.
    limits : (float, float)
        Range of the axis in dB, as ``decibel_limits`` gives it.
    """
    reference = -10 * math.log10(max(source.realizations, 1))
    table = source.anisotropy
    nu = table["nu"].to_numpy(dtype=float)
    decibel = table["anisotropy_db"].to_numpy(dtype=float)
    ax.axhline(reference, color=style.FAINT, linewidth=0.8, linestyle=(0, (3, 2)), zorder=0)
    ax.plot(
        nu,
        np.clip(decibel, *limits),
        color=stroke.colour,
        linewidth=0.9,
        marker="o" if len(nu) < FEW else "",
        markersize=2.2,
    )
    ax.set_xlim(0, reach(source))
    ax.set_ylim(*limits)
    # A mark at the top would touch the 0 of the radial power above.
    ax.yaxis.set_major_locator(MaxNLocator(4, steps=[1, 2, 5, 10], prune="upper"))
    ax.xaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10], prune="upper"))
    if not np.isfinite(decibel).any():
        ax.text(
            0.5, 0.5, "undefined", transform=ax.transAxes, ha="center", va="center", size=7, color=style.FAINT
        )


@style.styled
def figure(run: Run, group: Group | None = None) -> Figure:
    """Draw radial power above anisotropy for every source, on shared scales.

    Parameters
    ----------
    run : Run
        The comparison.
    group : (n, d), optional
        Draw only the sources of this size and dimension; all sources where not given.

    Returns
    -------
    Figure
        One pair of axes for each source.
    """
    sources = members(run, group)
    strokes = style.strokes(run)
    top, limits = power_limit(sources), decibel_limits(sources)
    caption = (
        "Above: mean power over each exact shell |f|, DC excluded; the line at 1 is white noise. The table's "
        "peak is the largest mean over rings one frequency wide, which single shells exceed. Below: "
        "anisotropy of each ring around its shells' own means; the dashed line is isotropic noise over "
        "M realizations, -10 log10(M) dB. "
    )
    sheet = layout.sheet(
        "Radial power and anisotropy",
        caption + captions.settings(run, group),
        len(sources),
        2.75,
        [1.55, 0.8],
        columns=3,
        gaps=[0.1],
        left=0.55,
        between=0.3,
        under=0.42,
    )
    for (power, anisotropy), first, source in zip(sheet.cells, sheet.first, sources, strict=True):
        power_panel(power, source, strokes[source.key], top)
        anisotropy_panel(anisotropy, source, strokes[source.key], limits)
        power.set_title(captions.name(source, run, 34), loc="left")
        power.tick_params(labelbottom=False, labelleft=first)
        anisotropy.tick_params(labelleft=first)
        anisotropy.set_xlabel("nu")
        if first:
            power.set_ylabel("power")
            anisotropy.set_ylabel("dB")
            sheet.figure.align_ylabels([power, anisotropy])
    return sheet.figure
