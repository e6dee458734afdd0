"""Figure of a single spectrum: its picture in 2D, its radial power in log scale and its anisotropy."""

from __future__ import annotations

import math

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LogNorm
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator, MaxNLocator, NullFormatter

from gbnbench import __version__
from gbnbench.analysis.radial.radial_power import shells_from_cube
from gbnbench.analysis.spectrum.box_shells import pooled_spectrum
from gbnbench.core.results.measures import Measures
from gbnbench.core.results.radial import ShellSpectrum
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.sides import sides_text
from gbnbench.reports import captions, layout, style
from gbnbench.reports.comparison import radial, spectrum
from gbnbench.reports.comparison.loglog import ZERO
from gbnbench.reports.log_ticks import PowersOfTen
from gbnbench.runs.comparison_result import Run, SourceResult
from gbnbench.runs.spectrum_files import rings_of

WIDTH, UPPER, LOWER, GAP = 3.3, 2.25, 0.95, 0.1  # inches


@style.styled
def figure(result: Spectrum | ShellSpectrum, label: str) -> Figure:
    """Draw the spectrum of points that belong to no comparison.

    Parameters
    ----------
    result : Spectrum or ShellSpectrum
        A whole or half cube of frequencies, or shells; not a list of frequencies.
    label : str
        Name of the points, for the title.

    Returns
    -------
    Figure
        Radial power above anisotropy, and in 2D the spectrum beside them.
    """
    source = _source(result, label)
    run = Run({"device": result.device.split(" (")[0], "version": __version__}, (source,))
    square = isinstance(result, Spectrum) and result.d == 2
    shell = "exact shell |f| against nu = |f| n^(-1/d)"
    if source.sides is not None:
        shell = (
            f"pooled shell |k| of the torus with sides {sides_text(source.sides)} against nu = |k| n^(-1/d)"
        )
    caption = f"Mean power over each {shell}, DC excluded; the line at 1 is white noise. "
    limits = radial.decibel_limits([source])
    decibel = source.anisotropy["anisotropy_db"].to_numpy(dtype=float)
    if np.isfinite(decibel).any():
        caption += (
            "Anisotropy of each ring round(|f|) around its shells' own means; a ring at an end holds only "
            "the shells inside; dashed: isotropic noise over M sets, -10 log10(M) dB. "
        )
    if (decibel < limits[0]).any() or (decibel > limits[1]).any():
        caption += "Anisotropy beyond its axis stands at the edge. "
    if (source.radial.power <= ZERO[result.precision]).any():
        caption += f"Triangles on the floor: power that is zero to rounding, {ZERO[result.precision]:.0e}. "
    scale = spectrum.norm([source]) if square else None
    if scale is not None:
        caption = (
            f"Left: log10 of power at every integer frequency, zero in the middle, axes in nu, clipped at "
            f"{scale.vmin:.0e} and {scale.vmax:g}, DC left out. Right: {caption[0].lower()}{caption[1:]}"
        )
    sheet = layout.sheet(
        captions.shown(label, 60),
        caption + captions.settings(run),
        2 if square else 1,
        WIDTH if square else 5.2,
        [UPPER, LOWER],
        gaps=[GAP],
        left=0.35 if square else 0.65,
        between=0.8,
        under=0.42,
        key=0.35 if square else 0.0,
        titles=False,
    )
    if scale is not None:
        _picture(sheet.cells[0], source, sheet, scale)
    power, anisotropy = sheet.cells[-1]
    _profile(power, source)
    radial.anisotropy_panel(anisotropy, source, style.strokes(run)[source.key], limits)
    for line in list(anisotropy.lines):
        if not np.isfinite(decibel).any():
            line.remove()  # there is nothing to compare with it
        elif line.get_marker() == "o":
            line.set_clip_on(False)  # markers at the edge are drawn whole
    power.tick_params(labelbottom=False)
    anisotropy.set_xlabel("nu")
    power.set_ylabel("radial power")
    anisotropy.set_ylabel("anisotropy, dB")
    for ax in (power, anisotropy):
        ax.set_xlim(*_reach(source))
    sheet.figure.align_ylabels([power, anisotropy])
    return sheet.figure


def _picture(cell: list[Axes], source: SourceResult, sheet: layout.Sheet, scale: LogNorm) -> None:
    """Draw the log10 map over the whole height of a cell, and its colour bar."""
    upper, lower = cell
    top, foot = upper.get_position(), lower.get_position()
    lower.remove()
    upper.set_position((foot.x0, foot.y0, foot.width, top.y1 - foot.y0))
    spectrum.panel(upper, source, scale)
    spectrum.add_colour_bar(sheet, scale)


def _profile(ax: Axes, source: SourceResult) -> None:
    """Radial power in log scale; shells that are zero to rounding stand as triangles on the floor."""
    nu, power = source.radial.nu, source.radial.power
    zero = power <= ZERO[source.spectrum.precision]
    there = power[~zero]
    bottom = min(float(there.min()) / 3, 0.05) if there.size else 1e-3
    top = max(8.0, 2 * float(there.max()) if there.size else 8.0)
    few = len(nu) < radial.FEW
    colour = style.COLOURS[0]
    ax.axhline(1, color=style.RULE, linewidth=0.8, zorder=0)
    shown = np.where(zero, np.nan, power)
    ax.plot(nu, shown, color=colour, linewidth=0.9, marker="o" if few else "", markersize=2.6)
    beside = np.concatenate([[True], zero, [True]])
    alone = ~zero & beside[:-2] & beside[2:]  # no line reaches these
    ax.plot(nu[alone], power[alone], "o", color=colour, markersize=2.6)
    ax.plot(
        nu[zero], np.full(int(zero.sum()), bottom), "v", color=colour, markersize=3, alpha=0.6, clip_on=False
    )
    ax.set_yscale("log")
    ax.set_ylim(bottom, top)
    ax.yaxis.set_major_locator(LogLocator(numticks=9))
    ax.yaxis.set_major_formatter(PowersOfTen())
    ax.yaxis.set_minor_formatter(NullFormatter())
    ax.xaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))


def _reach(source: SourceResult) -> tuple[float, float]:
    """Range of nu, of shells and rings: from 0, or from a band's own start."""
    nu = np.concatenate([source.radial.nu, source.anisotropy["nu"].to_numpy(dtype=float)])
    low, high = float(nu.min()), float(nu.max())
    room = 0.02 * high if low < high / 2 else max(0.05 * (high - low), 0.01 * high)
    return (0.0 if low < high / 2 else low - room), high + room


def _source(result: Spectrum | ShellSpectrum, label: str) -> SourceResult:
    """Wrap the result as the other pictures take it, without points."""
    if isinstance(result, Spectrum):
        whole, shells = result.whole(), shells_from_cube(result)
    else:
        none = np.empty((0, result.d), np.int64)
        n, d, sets, fmax = result.n, result.d, result.realizations, result.fmax
        whole = Spectrum(np.empty(0), n, d, sets, fmax, none, result.precision, sides=result.sides)
        shells = result
    return SourceResult(
        key="spectrum",
        label=label,
        n=result.n,
        d=result.d,
        realizations=result.realizations,
        points=np.empty((result.realizations, 0, result.d)),
        spectrum=whole,
        radial=(shells if shells.sides is None else pooled_spectrum(shells)).radial(),
        anisotropy=rings_of(shells),
        rdf=None,
        valence=None,
        zone_plate=None,
        measures=Measures({}),
        cpu_seconds=math.nan,
        warnings=(),
    )
