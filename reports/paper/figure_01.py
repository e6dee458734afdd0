"""Figure 1: sets and spectra of several methods, and their radial power in log-log scale."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import SubFigure

from gbnbench.analysis.radial.profile_measures import exponential_fit, powerlaw_fit
from gbnbench.core.results.radial import RadialPower
from gbnbench.reports import style
from gbnbench.reports.comparison import spectrum
from gbnbench.reports.paper import gallery_requests, panels, radial_axes, wording
from gbnbench.reports.paper.data import ComparisonRequest, DataRequest
from gbnbench.reports.paper.figure import PAGE, Drawing, FigureOptions, PaperFigure
from gbnbench.reports.paper.method_columns import Column, generated_column, user_columns
from gbnbench.reports.paper.method_styles import NAMES

PAPER = ("bnot", "kdm", "vnc", "bluenets")
BEFORE_FPO = ("bnot", "kdm", "vnc")
CLOSE = 0.5  # nu that the closeup reaches
NARROW = 3  # columns beside which there is room for the plot


def _long(options: FigureOptions) -> tuple[str, int]:
    gradients = options.pick(60, 3000, 3000)
    return f"gbn[gradients={gradients}]", gradients


def _large(options: FigureOptions) -> int:
    n: int = options.pick(144, 4096, 4096)
    return n


def _long_n(options: FigureOptions) -> int:
    """Return the number of points of the long runs in the plot: that of the gallery below the full scale."""
    n: int = _large(options) if options.scale == "full" else gallery_requests.size(options)
    return n


def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
    """Ask for sets for the gallery and larger ones for the plot."""
    return {
        "classic": gallery_requests.classic(options),
        "long": ComparisonRequest(
            (_long(options)[0],), (gallery_requests.size(options),), (2,), options.pick(2, 8, 1000)
        ),
        "large": ComparisonRequest(
            ("jittered", "sobol", "fpo", "gbn"), (_large(options),), (2,), options.pick(2, 8, 1000)
        ),
        **(
            {"large-long": ComparisonRequest((_long(options)[0],), (_long_n(options),), (2,), 1000)}
            if _long_n(options) != gallery_requests.size(options)
            else {}
        ),
        **gallery_requests.method_requests(options, gallery_requests.methods_shown(options, PAPER)),
    }


def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:
    """Draw points, spectrum and the middle of the spectrum for each method, and the radial power of all.

    Parameters
    ----------
    data : mapping
        Data under the names that ``needs`` gives them.
    options : FigureOptions
        Scale, sets of the user and seed.

    Returns
    -------
    Drawing
        The figure, as wide as the page, with its caption.
    """
    n, text, long_n = gallery_requests.size(options), _long(options)[0], _long_n(options)
    methods = gallery_requests.methods_shown(options, PAPER)
    early, late = (
        user_columns(data, [m for m in methods if (m in BEFORE_FPO) is first], n) for first in (True, False)
    )
    long = generated_column(data["long"], text, n, "GBN, 1M")
    gallery = [
        *early,
        generated_column(data["classic"], "fpo", n),
        *late,
        generated_column(data["classic"], "gbn", n),
        long,
    ]
    strata, sobol, fpo, gbn = (
        generated_column(data["large"], name, _large(options)) for name in ("jittered", "sobol", "fpo", "gbn")
    )
    longest = generated_column(data.get("large-long", data["long"]), text, long_n, "GBN, 1M")
    lines = [sobol, strata, *early, fpo, *late, gbn, longest]
    beside = len(gallery) <= NARROW
    wide = 1.12 if beside else min(1.5, (PAGE - 0.5) / len(gallery) - 0.04)

    def paint(panel: SubFigure) -> None:
        if beside:
            pictures, plot = panel.subfigures(
                1, 2, squeeze=False, width_ratios=[len(gallery) * (wide + 0.05) + 0.15, 3.3]
            )[0]
        else:
            pictures, plot = panel.subfigures(2, 1, squeeze=False, height_ratios=[3 * wide + 0.4, 2.7])[:, 0]
        _pictures(pictures, gallery, wide)
        _plot(plot.subplots(), lines, "abcdefghijklmnop"[len(gallery)])

    return Drawing(PAGE, 3.95 if beside else 3 * wide + 3.2, paint, _caption(gallery, lines, options))


def _pictures(panel: SubFigure, gallery: Sequence[Column], wide: float) -> None:
    axes = panel.subplots(3, len(gallery), squeeze=False)
    for k, one in enumerate(gallery):
        points, grey, close = axes[:, k]
        panels.scatter(points, one.source, wide)
        panels.heading(points, "abcdefghijklmnop"[k], one.title)
        spectrum.panel(grey, one.source, None, ticks=False)
        panels.power_map(close, one.source, CLOSE)
    panels.power_bar(list(axes[2]), location="bottom", shrink=0.9)


def _plot(ax: Axes, lines: Sequence[Column], letter: str) -> None:
    low = min(one.source.radial.nu[0] for one in lines)
    radial_axes.white(ax)
    for k, one in enumerate(lines):
        many = len(one.source.radial.nu) > 2000
        thin = {"linewidth": 0.4, "alpha": 0.7} if one is lines[0] else {"linewidth": 0.7 if many else 0.9}
        radial_axes.curve(ax, one.source.radial, one.stroke, one.title, zorder=2 + 0.1 * k, **thin)
    named = {one.source.label: one for one in lines}
    if theirs := [one for one in lines if one.title == NAMES["bnot"]]:
        _between(ax, theirs[0].source.radial, named["gbn"].source.radial)
    nu = np.geomspace(low, 0.35, 50)
    ax.plot(nu, math.pi**2 / 3 * nu**2, ":", color=style.INK, linewidth=0.9, zorder=4)
    epsilon = named["gbn"].source.measures["profile_epsilon"]
    nu = np.geomspace(low, 0.72, 200)
    ax.plot(nu, epsilon * np.exp(4 * math.pi**2 * nu**2), ":", color=style.INK, linewidth=0.9, zorder=4)
    radial_axes.log_nu(ax, 0.95 * low)
    radial_axes.log_power(ax, radial_axes.lowest(one.source.radial for one in lines), 30, ticks=9)
    ax.set_ylabel("radial power")
    ax.legend(loc="lower right", fontsize=6.8, handlelength=2.0, borderaxespad=0.2, labelspacing=0.3)
    panels.heading(ax, letter, "radial power")


def _between(ax: Axes, above: RadialPower, below: RadialPower) -> None:
    """Shade what GBN gains over BNOT, as the paper does; their shells differ where n does."""
    shared = (below.nu >= above.nu[0]) & (below.nu <= 1) & (below.power > 0)
    nu = below.nu[shared]
    upper = np.exp(np.interp(np.log(nu), np.log(above.nu), np.log(above.power)))
    ax.fill_between(
        nu,
        below.power[shared],
        upper,
        where=upper > below.power[shared],
        color="#fbe3d3",
        linewidth=0,
        zorder=0,
    )


def _caption(gallery: Sequence[Column], lines: Sequence[Column], options: FigureOptions) -> str:
    gradients = _long(options)[1]
    bnot = any(one.title == NAMES["bnot"] for one in lines)
    shaded = " Shaded: what GBN gains over BNOT." if bnot else ""
    fits = ", ".join(
        f"{exponential_fit(one.source.radial).residual_db:.1f} and "
        f"{powerlaw_fit(one.source.radial).residual_db:.1f} ({one.title})"
        for one in lines
    )
    floors = ", ".join(
        f"{wording.rounded(one.source.measures['noise_floor'])} ({one.title})" for one in lines
    )
    return (
        "Blue noise of different methods. Top: a set; middle: the mean spectrum in PSA's grey, white from a "
        f"power of 16; below: log10 of its middle, up to a nu of {CLOSE:g}: in grey all are dark there, and "
        "differ. Last panel: radial power on exact shells; the grey line at 1 is white noise; dotted: "
        "(pi^2/3) nu^2, the low band of stratified sets, and epsilon exp(4 pi^2 nu^2), the ideal Gaussian "
        f"blue noise, at GBN's fitted epsilon.{shaded} Noise floor, mean power up to a nu of 0.25: {floors}. "
        f"Residuals in dB of the exponential and of the power law fitted to each: {fits}. GBN took 320 "
        "gradients of Nesterov's method, the work of the paper's 10,000 steps of descent; GBN, 1M, takes "
        f"{gradients:,} in place of its million steps (k gradients do the work of about k^2/9). Pictures: "
        f"{wording.counted(gallery)}; plot: {wording.counted(lines)}; d = 2. "
        f"{wording.missing_sets_note(options, PAPER)}"
    ).rstrip()


FIGURE = PaperFigure(
    "1",
    "Methods, their spectra and radial power",
    "The spectra of blue-noise methods look alike, but the middle of GBN's is perfectly black. In log-log "
    "scale two families appear: polynomial (BNOT, stratified), which is straight, and exponential (GBN, VnC, "
    "KDM, FPO). GBN's noise floor is ten orders below that of other kernel methods, two below BNOT's.",
    needs,
    draw,
)
