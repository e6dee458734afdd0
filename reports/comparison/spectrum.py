"""Figures of the power spectrum, in log10 with a colour bar and in the grey tones of PSA."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Colormap, LogNorm
from matplotlib.figure import Figure

from gbnbench.core.results.spectrum import Spectrum
from gbnbench.core.torus import FloatArray
from gbnbench.reports import captions, layout, style
from gbnbench.reports.log_ticks import PowersOfTen
from gbnbench.reports.source_groups import Group, members
from gbnbench.runs.comparison_result import Run, SourceResult

CEILING = 10.0
LOWEST = 1e-14  # the log10 map reaches no deeper, lest a lattice's exact zeros flatten everybody else's map
UNEVALUATED = "#9aa3af", "#c6dbef"  # in the log10 map, where DC is left out too, and beside the tones of grey
BEYOND = "Grey: frequencies that are not affordable."
ROUNDING = 1e-24  # what double precision leaves of a lattice's exact zeros stays below this and sets no scale


def plane(spectrum: Spectrum) -> FloatArray | None:
    """Return the power that a picture shows, with frequency x on axis 0 and y on axis 1.

    Returns
    -------
    (2*fmax+1, 2*fmax+1) float64 or None
        The whole spectrum in 2D; in higher dimensions the slice where all other frequencies are 0; in 1D a
        single column, (2*fmax+1, 1). Of a torus with unequal sides the box, (2*f_0+1, 2*f_1+1). Frequencies
        that were not evaluated are nan. None where a list of frequencies has none in that plane.
    """
    f, d = spectrum.fmax, spectrum.d
    wide = (2 * f + 1, 2 * f + 1 if d > 1 else 1)
    if spectrum.frequencies is None:
        first, *others = spectrum.power.shape
        centre = tuple(size // 2 for size in others[1:])
        cut = spectrum.power[:, :, *centre] if d > 1 else spectrum.power
        return np.array(cut, dtype=np.float64).reshape(first, -1)
    listed = np.asarray(spectrum.frequencies)
    flat = np.all(listed[:, 2:] == 0, axis=1) & np.all(np.abs(listed) <= f, axis=1)
    if not flat.any():
        return None
    image = np.full(wide, np.nan)
    row = listed[flat, 0] + f
    column = listed[flat, 1] + f if d > 1 else np.zeros_like(row)
    image[2 * f - row, image.shape[1] - 1 - column] = spectrum.power[flat]  # P(-f) = P(f)
    image[row, column] = spectrum.power[flat]
    return image


def without_dc(image: FloatArray) -> FloatArray:
    """Return a copy of a picture with nan in its centre, whose value n is no noise."""
    clear = image.copy()
    clear[image.shape[0] // 2, image.shape[1] // 2] = np.nan
    return clear


def tone_map(power: FloatArray) -> FloatArray:
    """Return PSA's grey, log2(1 + sqrt(P) / 4) in [0, 1], white from P = 16 (Schlömer & Deussen 2011)."""
    grey: FloatArray = np.clip(np.log2(1 + 0.25 * np.sqrt(np.maximum(power, 0.0))), 0.0, 1.0)
    return grey


def norm(sources: Sequence[SourceResult]) -> LogNorm:
    """Return the log10 scale of all sources, from a decade below their smallest power to 10."""
    lowest = math.inf
    for source in sources:
        image = plane(source.spectrum)
        if image is not None:
            image = without_dc(image)
            positive = image[np.isfinite(image) & (image > ROUNDING)]
            lowest = min(lowest, float(positive.min()) if positive.size else lowest)
    lowest = min(max(lowest, LOWEST), 0.05)
    return LogNorm(10.0 ** math.floor(math.log10(lowest)), CEILING, clip=True)


def palette() -> Colormap:
    """Return the colour map of power: dark where it is low, grey at DC and where it was not evaluated."""
    return colormaps["magma"].with_extremes(bad=UNEVALUATED[0])


def note(source: SourceResult) -> str:
    """Say what part of the spectrum the picture shows; empty in 2D, where it shows the whole."""
    if source.d == 1:
        return "1D: every row is the same."
    cut = [] if source.d == 2 else [f"Slice of the first two of {source.d} frequencies, the others 0."]
    listed = [] if source.spectrum.frequencies is None else [BEYOND]
    return " ".join(cut + listed)


def panel(ax: Axes, source: SourceResult, scale: LogNorm | None, *, ticks: bool = True) -> None:
    """Draw the spectrum of one source, on axes in nu.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    source : SourceResult
        Source to draw.
    scale : LogNorm or None
        Scale of log10 power; None draws PSA's grey tones.
    ticks : bool
        Label the axes.
    """
    image = plane(source.spectrum)
    if image is None:
        layout.empty(ax, "no frequency of the plane was evaluated")
        return
    reach = (source.spectrum.fmax + 0.5) * source.spectrum.spacing
    sides = source.sides or (1.0, 1.0)
    right, up = (
        source.spectrum.spacing * (size / 2) / side for size, side in zip(image.shape, sides, strict=False)
    )
    extent = (-reach, reach, -reach, reach) if source.sides is None else (-right, right, -up, up)
    if scale is None:
        grey = colormaps["gray"].with_extremes(bad=UNEVALUATED[1])
        ax.imshow(tone_map(image).T, cmap=grey, vmin=0, vmax=1, origin="lower", extent=extent, aspect="equal")
    else:
        safe = np.maximum(without_dc(image), float(scale.vmin or LOWEST))
        ax.imshow(safe.T, cmap=palette(), norm=scale, origin="lower", extent=extent, aspect="equal")
    layout.frame(ax)
    if source.sides is not None:  # the same square of nu as for others
        ax.set_xlim(-reach, reach)
        ax.set_ylim(-reach, reach)
    if ticks:
        whole = math.floor(reach)
        marks = [-whole, 0, whole] if whole else [0]
        ax.set_xticks(marks)
        ax.set_yticks(marks if source.d > 1 else [])
        ax.tick_params(length=2, pad=1.5)


@style.styled
def figure(run: Run, group: Group | None = None) -> Figure:
    """Draw log10 of the power above the grey picture of PSA for every source, on shared scales.

    Parameters
    ----------
    run : Run
        The comparison.
    group : (n, d), optional
        Draw only the sources of this size and dimension; all sources where not given.

    Returns
    -------
    Figure
        One pair of pictures for each source.
    """
    sources = members(run, group)
    scale = norm(sources)
    notes = " ".join(dict.fromkeys(filter(None, map(note, sources))))
    caption = (
        f"Power at every integer frequency, zero in the middle, x right, y up, axes in nu = |f| n^(-1/d). "
        f"Upper picture of a pair: log10, one scale for all sources, clipped at {scale.vmin:.0e} and "
        f"{CEILING:g}, DC left out; lower: grey = log2(1 + sqrt(P)/4), white from P = 16 (PSA). {notes} "
    ).replace("  ", " ")
    if BEYOND in caption:
        caption = caption.replace(BEYOND, f"{BEYOND[:-1]}, light blue in the lower picture.")
    sheet = layout.sheet(
        "Power spectra",
        caption + captions.settings(run, group),
        len(sources),
        2.2,
        [2.2, 2.2],
        columns=6 if len(sources) <= 6 else 5,
        gaps=[0.22],
        left=0.35,
        between=0.25,
        under=0.28,
        key=0.55,
    )
    for (log, grey), first, source in zip(sheet.cells, sheet.first, sources, strict=True):
        panel(log, source, scale)
        panel(grey, source, None)
        log.set_title(captions.name(source, run, 28), loc="left")
        log.tick_params(labelbottom=False, labelleft=first)
        grey.tick_params(labelleft=first)
    add_colour_bar(sheet, scale)
    return sheet.figure


def add_colour_bar(sheet: layout.Sheet, scale: LogNorm) -> None:
    """Draw a horizontal bar of log10 power between the cells and the caption.

    Parameters
    ----------
    sheet : Sheet
        Figure whose layout kept room for a key.
    scale : LogNorm
        Scale of the pictures.
    """
    width, height = sheet.figure.get_size_inches()
    bar = sheet.figure.add_axes(
        (0.35 / width, (sheet.foot + 0.36) / height, min(3.0, width - 0.8) / width, 0.1 / height)
    )
    sheet.figure.colorbar(
        ScalarMappable(scale, palette()), cax=bar, orientation="horizontal", format=PowersOfTen()
    )
    bar.set_xlabel("power (white noise = 1)", size=7)
    bar.minorticks_off()
