"""Figure with the radial power of all sources in one log-log plot (Ahmed, Ren & Wonka 2022, Fig. 1(g))."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, NullLocator
from numpy.typing import NDArray

from gbnbench.core.torus import FloatArray
from gbnbench.reports import captions, layout, style
from gbnbench.reports.log_ticks import PowersOfTen
from gbnbench.reports.source_groups import Group, members
from gbnbench.runs.comparison_result import Run, SourceResult

FEW = 40  # with fewer shells than this each one gets a dot
NEAR = 0.25  # of 4 pi^2, within which a fitted c is Gaussian blue noise's
FITTED = 6.0  # dB, the largest residual of a fit that says so; a step's is 25 though its c may be near
# Where power is exactly 0, double precision leaves some 1e-30 and float 1e-13; deep sets reach 1e-26.
ZERO = {"double": 1e-27, "float": 1e-12}


def guide(sources: list[SourceResult]) -> tuple[float, float] | None:
    """Return epsilon of the deepest source with a fitted c near 4 pi^2, and the nu where its guide is 1."""
    measured = [s.measures.measured for s in sources]
    near = [
        m
        for m in measured
        if abs(m.get("profile_c", math.nan) / (4 * math.pi**2) - 1) <= NEAR
        and m.get("profile_residual_db", math.nan) <= FITTED
    ]
    fits = [m.get("profile_epsilon", math.nan) for m in near]
    deep = [e for e in fits if math.isfinite(e) and ZERO["double"] < e < 1e-3]
    if not deep:
        return None
    epsilon = min(deep)
    return epsilon, math.sqrt(-math.log(epsilon) / (4 * math.pi**2))


@style.styled
def figure(run: Run, group: Group | None = None) -> Figure:
    """Draw the power of every exact shell of every source.

    Parameters
    ----------
    run : Run
        The comparison.
    group : (n, d), optional
        Draw only the sources of this size and dimension; all sources where not given.

    Returns
    -------
    Figure
        One plot of all sources. Shells whose power is zero to rounding stand as triangles on its floor.
    """
    sources = members(run, group)
    strokes = style.strokes(run)
    gone = [zero_to_rounding(source) for source in sources]
    powers = [np.where(zero, np.nan, s.radial.power) for s, zero in zip(sources, gone, strict=True)]
    bottom, top = power_limits(powers)

    caption = "Mean power over each exact shell |f|, no smoothing; the grey line at 1 is white noise. "
    if any(zero.any() for zero in gone):
        caption += "Triangles on the floor: shells whose power is zero to rounding (some 1e-27). "
    curve = guide(sources)
    if curve is not None:
        caption += (
            "Dotted: epsilon exp(4 pi^2 nu^2), the ideal Gaussian blue noise, at the deepest epsilon fitted "
            "with c near 4 pi^2. "
        )
    labels = [captions.name(source, run, 30) for source in sources]
    room = layout.legend_room(labels)
    if curve is not None:
        labels.append("ε exp(4π²ν²)")
    caption += captions.settings(run, group)
    sheet = layout.sheet(
        "Radial power, log-log", caption, 1, 6.6, [4.6], left=0.7, under=0.42, right=room, titles=False
    )
    ax = sheet.cells[0][0]
    handles = []
    for source, power, zero in zip(sources, powers, gone, strict=True):
        nu, stroke = source.radial.nu, strokes[source.key]
        few = len(nu) < FEW
        (line,) = ax.plot(
            nu,
            power,
            color=stroke.colour,
            linestyle=stroke.dash,
            marker="o" if few else "",
            markersize=3,
            linewidth=1.0,
            zorder=2 + 1 / (1 + _roughness(power)),
        )
        alone = without_neighbours(power)
        if not few and alone.any():
            ax.plot(nu[alone], power[alone], "o", markersize=2.2, color=stroke.colour)
        if zero.any():
            ax.plot(
                nu[zero],
                np.full(int(zero.sum()), bottom),
                "v",
                markersize=3,
                color=stroke.colour,
                clip_on=False,
                alpha=0.6,
            )
        handles.append(line)
    ax.axhline(1, color=style.RULE, linewidth=0.9, zorder=0)
    span = [float(v) for s in sources if len(s.radial.nu) for v in (s.radial.nu.min(), s.radial.nu.max())]
    if curve is not None:
        epsilon, end = curve
        line_nu = np.geomspace(min([*span, end]), end, 160)
        (dotted,) = ax.plot(
            line_nu,
            epsilon * np.exp(4 * math.pi**2 * line_nu**2),
            color=style.FAINT,
            linestyle=":",
            linewidth=1.3,
        )
        handles.append(dotted)
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_ylim(bottom, top)
    if span:
        ax.set_xlim(min(span) * 0.93, max(span) * 1.07 if max(span) > min(span) else max(span) * 2)
    decades = math.log10(top / bottom)
    ax.yaxis.set_major_locator(LogLocator(numticks=12))
    if decades > 12:
        ax.yaxis.set_minor_locator(NullLocator())
    ax.xaxis.set_major_formatter(PowersOfTen(minor_thresholds=(2, 0.8)))
    ax.xaxis.set_minor_formatter(PowersOfTen())
    ax.yaxis.set_major_formatter(PowersOfTen())
    ax.yaxis.set_minor_formatter(PowersOfTen())
    ax.grid(True, which="major")
    ax.set_xlabel("nu = |f| n^(-1/d)")
    ax.set_ylabel("radial power")
    layout.beside(ax, handles, labels)
    return sheet.figure


def zero_to_rounding(source: SourceResult) -> NDArray[np.bool_]:
    """Mark shells whose power is zero to rounding, and for a lattice also those just above."""
    limit = ZERO.get(source.spectrum.precision, ZERO["double"])
    zero = source.radial.power <= limit
    return source.radial.power <= 1000 * limit if 2 * zero.sum() > len(zero) else zero


def power_limits(powers: Sequence[FloatArray]) -> tuple[float, float]:
    """Return the ends of the axis of power that all sources share.

    Parameters
    ----------
    powers : sequence of (shells,) float64
        Power of each source, nan where none is drawn.

    Returns
    -------
    (float, float)
    """
    finite = np.concatenate([p[np.isfinite(p)] for p in powers] or [np.empty(0)])
    if not finite.size:
        return 1e-3, 8.0
    return min(float(finite.min()) / 3, 0.05), max(8.0, float(finite.max()) * 2)


def without_neighbours(power: FloatArray) -> NDArray[np.bool_]:
    """Mark the shells that no line reaches, because neither shell beside them is drawn."""
    drawn = np.isfinite(power)
    reached = np.zeros(len(power), dtype=bool)
    reached[1:] |= drawn[:-1]
    reached[:-1] |= drawn[1:]
    return drawn & ~reached


def _roughness(power: FloatArray) -> float:
    """Return the median jump between neighbouring shells in nepers; the roughest curves are drawn first."""
    jumps = np.abs(np.diff(np.log(power)))
    jumps = jumps[np.isfinite(jumps)]
    return float(np.median(jumps)) if jumps.size else 0.0
