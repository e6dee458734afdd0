"""Figure ``depth``, not in the paper: what depth costs in order, and what it gains in integration."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import SubFigure
from matplotlib.ticker import LogLocator, NullLocator

from gbnbench.core.number_text import number
from gbnbench.generators.spectral_control.deep import Deep
from gbnbench.reports import style
from gbnbench.reports.integration import variance
from gbnbench.reports.paper import gallery_requests, panels, radial_axes, wording
from gbnbench.reports.paper.data import ComparisonRequest, DataRequest, IntegrationRequest
from gbnbench.reports.paper.figure import PAGE, Drawing, FigureOptions, PaperFigure
from gbnbench.reports.paper.method_columns import Column, generated_column, user_columns
from gbnbench.reports.paper.method_styles import stroke, title_of

GRADIENTS = (100, 320, 1000, 3000)  # of Gaussian Blue Noise; 320 are the default
STEEPNESS = (39.5, 59.2, 79.0)  # of the deep profile: 4, 6 and 8 pi^2; 10 pi^2 is the default
BESIDE = "random"
ORDER = {"valence6": r"$v_6$", "psi6": r"$\psi_6$", "peak": "peak"}
SHOWN = {320: style.DASHES[0], 1000: style.DASHES[1], 3000: style.DASHES[2]}
FAMILY = "gaussians"


def _gradients(options: FigureOptions) -> tuple[int, ...]:
    found: tuple[int, ...] = options.pick((20, 60), GRADIENTS, GRADIENTS)
    return found


def _gbn(gradients: int) -> str:
    return "gbn" if gradients == 320 else f"gbn[gradients={gradients}]"


def _deep(options: FigureOptions) -> list[str]:
    steep = options.pick((), STEEPNESS, STEEPNESS)
    return [*(f"deep[c={c:g}]" for c in steep), "deep"]


def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
    """Ask for sets along both paths to depth, and for a study of integration."""
    n, gradients = gallery_requests.size(options), _gradients(options)
    longest, others = gradients[-1], gradients[:-1]
    sources = (*map(_gbn, others), *_deep(options))
    few = options.pick(2, 8, 1000)  # the longest runs are those of figure 1
    sizes = options.pick((16, 36), (64, 128, 256, 512, 1024), (64, 128, 256, 512, 1024, 2048, 4096))
    return {
        "sets": ComparisonRequest(sources, (n,), (2,), options.pick(2, 8, 100)),
        "long": ComparisonRequest((_gbn(longest),), (n,), (2,), few),
        "study": IntegrationRequest(
            (BESIDE, _gbn(gradients[1]), "deep"), sizes, (2,), options.pick(2, 8, 100), (FAMILY,),
            options.pick(2, 20, 100),
        ),
        **gallery_requests.user_set_requests(options, options.sets),
    }  # fmt: skip


def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:
    """Draw spectra and variances of integration above measures of order against the noise floor.

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
    n, gradients = gallery_requests.size(options), _gradients(options)
    gbn = [
        generated_column(data["long" if k == gradients[-1] else "sets"], _gbn(k), n, f"GBN, {k:,}")
        for k in gradients
    ]
    deep = [generated_column(data["sets"], text, n) for text in _deep(options)]
    theirs = user_columns(data, options.sets, n)
    table = data["study"].variance

    def paint(panel: SubFigure) -> None:
        top, bottom = panel.subfigures(2, 1, squeeze=False, height_ratios=(1.28, 1))[:, 0]
        spectra, variance = top.subplots(1, 2, width_ratios=(1.3, 1))
        _spectra(spectra, dict(zip(gradients, gbn, strict=True)), deep[-1], theirs)
        _integration(variance, table)
        for ax, letter, name in zip(bottom.subplots(1, 3), "cde", ORDER, strict=True):
            _order(ax, name, gbn, deep, theirs)
            panels.heading(ax, letter, f"{ORDER[name]} against depth")

    return Drawing(PAGE, 4.6, paint, _caption(gbn, deep, theirs, table, options))


def _spectra(ax: Axes, gbn: Mapping[int, Column], deep: Column, theirs: Sequence[Column]) -> None:
    colour = stroke("gbn").colour
    radials = [deep.source.radial]
    for gradients, one in gbn.items():
        if len(gbn) > 3 and gradients not in SHOWN:
            continue
        dash = SHOWN.get(gradients, style.DASHES[0])
        radial_axes.curve(ax, one.source.radial, style.Stroke(colour, dash), one.title, linewidth=0.8)
        radials.append(one.source.radial)
    radial_axes.curve(ax, deep.source.radial, deep.stroke, deep.title, linewidth=0.9)
    for one in theirs:
        radial_axes.curve(ax, one.source.radial, one.stroke, one.title, linewidth=0.8)
        radials.append(one.source.radial)
    target, edge = Deep().profile(2)
    nu = np.geomspace(deep.source.radial.nu[0], edge, 200)
    ax.plot(nu, target(nu), color=deep.stroke.colour, linewidth=2.6, alpha=0.22, zorder=1.5)
    radial_axes.loglog(ax, radial_axes.lowest(radials) / 3, (float(nu[0]) * 0.95, 2.05))
    ax.set_ylabel("radial power")
    ax.legend(loc="lower right", fontsize=6.5, handlelength=2.4, borderaxespad=0.2, labelspacing=0.3)
    panels.heading(ax, "a", "radial power")


def _integration(ax: Axes, table: Any) -> None:
    strokes = {label: stroke(label.partition("[")[0]) for label in table["source"].unique()}
    variance.panel(ax, table, strokes)
    ax.set_xlabel("points n")
    ax.set_ylabel("variance of the integral")
    for label, line in strokes.items():
        rows = table[table["source"] == label].sort_values("n")
        ax.annotate(
            title_of(label), (float(rows["n"].iloc[-1]), float(rows["variance"].iloc[-1])),
            xytext=(-6, -3) if label == "deep" else (-4, 6), textcoords="offset points", ha="right",
            size=6.5, color=line.colour,
        )  # fmt: skip
    panels.heading(ax, "b", "integration, 64 Gaussians")


def _order(
    ax: Axes, name: str, gbn: Sequence[Column], deep: Sequence[Column], theirs: Sequence[Column]
) -> None:
    """Draw one measure of order against the noise floor, deeper sets to the right."""
    paths = [
        (gbn, stroke("gbn"), "o"), (deep, stroke("deep"), "D"),
        *(([one], one.stroke, "s") for one in theirs),
    ]  # fmt: skip
    for path, line, marker in paths:
        floors = [one.source.measures["noise_floor"] for one in path]
        values = [one.source.measures[name] for one in path]
        errors = [one.source.measures.standard_error[name] for one in path]
        ax.errorbar(
            floors, values, np.nan_to_num(errors), color=line.colour, linestyle=line.dash,
            marker=marker, markersize=3,
            linewidth=0.9, elinewidth=0.7, label=path[-1].title.partition(",")[0],
        )  # fmt: skip
    for one in gbn:
        ax.annotate(
            one.title.partition(", ")[2], (one.source.measures["noise_floor"], one.source.measures[name]),
            xytext=(-4, 2), textcoords="offset points", ha="right", size=6, color=style.FAINT,
        )  # fmt: skip
    ax.set_xscale("log")
    ax.xaxis.set_major_locator(LogLocator(numticks=6))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.invert_xaxis()
    ax.margins(0.2, 0.12)
    ax.set_xlabel("noise floor")
    if name == next(iter(ORDER)):
        ax.legend(fontsize=6.5, loc="upper right", borderaxespad=0.1, handlelength=1.6)


def _caption(
    gbn: Sequence[Column],
    deep: Sequence[Column],
    theirs: Sequence[Column],
    table: Any,
    options: FigureOptions,
) -> str:
    usual, longest, last = gbn[1], gbn[-1], deep[-1]

    def of(one: Column, name: str) -> str:
        return number(one.source.measures[name])

    most = int(table["n"].max())
    at = {row.source: row for row in table[table["n"] == most].itertuples()}
    plain = at[usual.source.label]
    by_n = table.pivot_table("variance", "n", "source")
    ratio = by_n["deep"] / by_n[usual.source.label]
    worse = (
        "; below the Gaussians' own 512 points deep is the worse, by a factor of "
        f"{number(float(ratio.max()))} at most"
        if ratio[ratio.index < 512].max() > 1
        else ""
    )
    edge = Deep().profile(2)[1]
    steep = ", ".join(f"{c / math.pi**2:.0f}" for c in options.pick((), STEEPNESS, STEEPNESS))
    path = (
        f"Deep: c = {steep} and 10 pi^2 at an edge of {edge:g}, v6 from {of(deep[0], 'valence6')} to "
        f"{of(last, 'valence6')}. "
        if steep
        else ""
    )
    also = f" Also {wording.listed([one.title for one in theirs])}, of given files." if theirs else ""
    return (
        "Depth against order. Gaussian Blue Noise (GBN) becomes deeper by longer optimisation (gradients "
        "of Nesterov's method in the labels; 320 do the work of the paper's 10,000 steps) and more ordered "
        "with it; the deep profile P = exp(-c (edge^2 - nu^2)) is reached from a short GBN by the least "
        "move, and its steepness c costs little order. (a) Radial power, the grey line is white noise; pale: "
        "the deep target. (b) Variance of the integral of toroidal sums of 64 Gaussians of width "
        f"512^(-1/2): {int(plain.instances)} integrands, {int(plain.realizations)} sets; bands 95%; "
        f"crosses: predicted by the spectra; grey: 1/n. At n = {most:,} it is {number(plain.variance)} for "
        f"GBN and {number(at['deep'].variance)} for deep{worse}. (c, d, e) Share of six-sided Voronoi "
        "cells, sixfold order and spectral peak against the noise floor, deeper to the right, with "
        f"standard errors. {path}From {usual.title.partition(', ')[2]} to "
        f"{longest.title.partition(', ')[2]} gradients GBN's floor goes from {of(usual, 'noise_floor')} to "
        f"{of(longest, 'noise_floor')}, its v6 from {of(usual, 'valence6')} to {of(longest, 'valence6')}; "
        f"deep has {of(last, 'noise_floor')} and {of(last, 'valence6')}. "
        f"{wording.counted([*gbn, *deep])[0].upper()}{wording.counted([*gbn, *deep])[1:]}; d = 2.{also}"
    )


FIGURE = PaperFigure("depth", "Depth against order", "", needs, draw)
