"""Figure of the spectra of all sources: of the set less its density, and in the flattest square; and cost."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from gbnbench.core.results.radial import RadialPower
from gbnbench.core.results.resolution import gaussian_response
from gbnbench.reports import layout, style
from gbnbench.reports.captions import shown
from gbnbench.reports.stippling_comparison import captions
from gbnbench.reports.stippling_comparison.table import row_label
from gbnbench.studies.stippling_comparison.stippling_results import StipplingResult, StipplingRun

FILTER = 1.0  # width of the Gaussian, in mean spacings
FILTERED_NU, FILTERED_LOW = 0.7, 1e-8  # beyond which a filtered spectrum holds nothing to be seen

Pick = Callable[[StipplingResult], RadialPower | None]


def panel(ax: Axes, run: StipplingRun, pick: Pick, *, filtered: bool = False) -> None:
    """Draw one curve a source, and the line of independent points.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    run : StipplingRun
        The comparison.
    pick : callable
        Takes a source's spectrum.
    filtered : bool
        Whether the spectra are those of sets blurred by a Gaussian of one mean spacing.
    """
    found = [
        (k, radial)
        for k, source in enumerate(run.sources)
        if (radial := pick(source)) is not None and len(radial.nu) > 0
    ]
    if not found:  # an image of few pixels a side has no whole cycle below the highest nu
        layout.empty(ax, "no frequency so low")
        return
    nu = max((radial.nu for _, radial in found), key=lambda values: float(values[-1]))
    white = gaussian_response(nu, FILTER) if filtered else np.ones(len(nu))
    ax.plot(nu, white, color=style.FAINT, linewidth=0.8, zorder=0)
    low = 1.0
    for k, radial in found:
        stroke = style.numbered_stroke(k)
        low = min(low, float(radial.power[radial.power > 0].min()))
        ax.plot(radial.nu, radial.power, color=stroke.colour, linestyle=stroke.dash, linewidth=1)
    ax.set_yscale("log")
    ax.set_ylim(FILTERED_LOW if filtered else 10 ** math.floor(math.log10(low)), 10)
    if filtered:
        ax.set_xlim(0, FILTERED_NU)
    else:
        ax.set_xscale("log")
        ax.set_xlim(0.95 * float(min(radial.nu[0] for _, radial in found)), float(nu[-1]))
        ax.xaxis.set_major_formatter("{x:g}")
    ax.grid(visible=True)
    ax.set_xlabel("nu")


def cost_panel(ax: Axes, run: StipplingRun) -> None:
    """Draw the variance against the time that a set takes.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    run : StipplingRun
        The comparison.
    """
    for k, source in enumerate(run.sources):
        if math.isfinite(source.cpu_seconds):
            ax.plot(
                max(source.cpu_seconds, 1e-3), source.measures["relative_variance"], "o", markersize=5,
                color=style.numbered_stroke(k).colour,
            )  # fmt: skip
    ax.set(xscale="log", yscale="log", xlabel="CPU seconds a set", ylabel="variance")
    ax.grid(visible=True)


@style.styled
def figure(run: StipplingRun) -> Figure:
    """Draw the spectra of all sources, and quality against cost.

    Parameters
    ----------
    run : StipplingRun
        The comparison.

    Returns
    -------
    Figure
        Four panels with one legend, three where no square of the image holds enough points.
    """
    spectra: list[tuple[str, Pick, bool]] = [
        ("points less density", lambda s: s.difference, False),
        ("the same, filtered by a Gaussian", lambda s: s.difference.filtered(FILTER), True),
    ]
    if run.patch is not None:
        spectra.insert(0, ("in the square", lambda s: s.patch, False))
    labels = [shown(row_label(source, run), 34) for source in run.sources]
    caption = (
        "Mean power over annuli and sets; the line of independent points is grey. "
        + ("In the square: against nu of the spacing there, seen through a taper. " if run.patch else "")
        + "Points less density: the whole image, against nu of the mean spacing; filtered by a Gaussian "
        "whose width is one mean spacing. Variance: mean of ((A - T) / T)^2 over the density. "
        f"{captions.patch_text(run)} {captions.settings(run)}"
    )
    sheet = layout.sheet(
        "Spectra", caption, len(spectra) + 1, 3.1, [2.3], columns=2, left=0.6, between=0.65, under=0.45,
        right=0.2 + layout.legend_room(labels),
    )  # fmt: skip
    for (ax,), (title, pick, filtered) in zip(sheet.cells, spectra, strict=False):
        panel(ax, run, pick, filtered=filtered)
        ax.set_ylabel("power")
        ax.set_title(title, loc="left")
    cost = sheet.cells[-1][0]
    cost.set_title("quality against cost", loc="left")
    cost_panel(cost, run)
    second = sheet.cells[1][0]
    strokes = [style.numbered_stroke(k) for k in range(len(labels))]
    handles = [second.plot([], [], color=s.colour, linestyle=s.dash)[0] for s in strokes]
    layout.beside(second, handles, labels)
    return sheet.figure
