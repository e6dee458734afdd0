"""Figure of the variance of integration against n in log-log scale (Ahmed, Ren & Wonka 2022, Fig. 9)."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, LogFormatterSciNotation, LogLocator, NullLocator

from gbnbench.analysis.integration.variance import MOST_SCATTER
from gbnbench.core.readable_text import display_width
from gbnbench.reports import captions, layout, style
from gbnbench.studies.integration.study_folder import IntegrationStudy

CAPTION = (
    "Mean squared error of the mean over n points, over {instances} integrands of each family and {sets} "
    "sets of each source. {bands}: 95%, over integrands and sets. "
)
PREDICTED = (
    "Crosses: what the sets' power spectra predict (the inner product with the integrands' spectra), with a "
    "bar for what white noise beyond the frequencies summed would add. "
)
SLOPES = (
    "Grey: the slope of random sampling, 1/n. In the key: fitted slopes with standard errors, bent where the "
    "variances lie over 0.3 decades from the line. "
)


def strokes(study: IntegrationStudy) -> dict[str, style.Stroke]:
    """Assign each source label a stroke that is the same in every panel."""
    labels = dict.fromkeys(study.variance["source"])
    by_source = {}
    for k, label in enumerate(labels):
        turn, colour = divmod(k, len(style.COLOURS))
        by_source[str(label)] = style.Stroke(style.COLOURS[colour], style.DASHES[turn % len(style.DASHES)])
    return by_source


def panel(ax: Axes, part: pd.DataFrame, by_source: dict[str, style.Stroke]) -> None:
    """Draw one family in one dimension.

    Parameters
    ----------
    ax : Axes
        Empty.
    part : DataFrame
        Rows of ``IntegrationStudy.variance``.
    by_source : mapping
        Source label -> stroke.
    """
    ax.set_xscale("log", base=2)
    ax.set_yscale("log")
    for label, rows in part.groupby("source", sort=False):
        stroke, line = by_source[str(label)], rows[rows["variance"] > 0].sort_values("n")
        ax.plot(
            line["n"],
            line["variance"],
            color=stroke.colour,
            linestyle=stroke.dash,
            marker="o",
            markersize=2.6,
        )
        if len(line) > 1:
            ax.fill_between(
                line["n"], line["low"], line["high"], color=stroke.colour, alpha=0.18, linewidth=0
            )
        else:
            ax.vlines(line["n"], line["low"], line["high"], color=stroke.colour, linewidth=1.2, alpha=0.6)
        predicted = line[line["foretold"] > 0]
        least = predicted["foretold"]
        ax.plot(predicted["n"], least, "x", color=stroke.colour, markersize=5, markeredgewidth=0.9)
        ax.vlines(predicted["n"], least, least + predicted["beyond"], color=stroke.colour, linewidth=0.9)
    sizes = np.array(sorted(part["n"].unique()), dtype=float)
    positive = part[part["variance"] > 0]
    if len(sizes) > 1 and len(positive):
        guide_line(ax, sizes, positive)
    if len(sizes):
        ax.set_xlim(sizes[0] / 1.3, sizes[-1] * 1.3)
    if len(sizes) <= 12:
        ax.xaxis.set_major_locator(FixedLocator(_apart(sizes)))
        ax.xaxis.set_minor_locator(NullLocator())
    ax.xaxis.set_major_formatter(FuncFormatter(lambda n, _: f"{n:,.0f}"))
    low, high = ax.get_ylim()
    few = math.log10(high / low) < 2  # decades: powers of ten alone would leave one label or none
    ax.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5) if few else (1,), numticks=9))
    if few:
        ax.yaxis.set_major_formatter(LogFormatterSciNotation(labelOnlyBase=False, minor_thresholds=(9, 9)))
    ax.yaxis.set_minor_locator(NullLocator())
    ax.grid(True)


def _apart(sizes: Any) -> list[float]:
    """Sizes to label: those that leave room for a label, the largest first."""
    room = 0.17 * (np.log2(sizes[-1] / sizes[0]) + 1)
    kept: list[float] = []
    for size in sizes[::-1]:
        if not kept or np.log2(kept[-1] / size) >= room:
            kept.append(float(size))
    return kept


def guide_line(ax: Axes, sizes: Any, part: pd.DataFrame) -> None:
    """Draw 1/n through the first variance of random sampling, or through the largest first one without it.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    sizes : (sizes,) float64
        Numbers of points, ascending.
    part : DataFrame
        Rows of ``IntegrationStudy.variance`` that the panel shows, with positive variances.
    """
    first = part[part["n"] == part["n"].min()]
    anchor = first[first["source"] == "random"] if (first["source"] == "random").any() else first
    row = anchor.loc[anchor["variance"].idxmax()]
    n = np.array([sizes[0], sizes[-1]])
    ax.plot(n, row["variance"] * row["n"] / n, color="#9aa3af", linewidth=2.2, zorder=0, alpha=0.7)


@style.styled
def figure(study: IntegrationStudy) -> Figure:
    """Draw one panel for each family of integrands and dimension of a study."""
    table = study.variance
    parts = list(table.groupby(["integrand", "d"], sort=False))
    by_source = strokes(study)
    shifts = int(table["shifts"].max())
    several = bool(len(study.slopes))
    caption = CAPTION.format(
        instances=_span(table["instances"]),
        sets=_span(table["realizations"]),
        bands="Bands" if several else "Bars",
    )
    caption += PREDICTED if table["foretold"].notna().any() else ""
    caption += SLOPES if several else ""
    caption += f"{shifts} random shifts of each set. " if shifts else ""
    caption += f"Seed {study.manifest.get('seed')} · gbnbench {study.manifest.get('version')}"
    keys = {key: _key(study, part) for key, part in parts}
    longest = max((display_width(label) for labels in keys.values() for label in labels), default=0)
    columns = min(2 if len(parts) <= 4 else 3, len(parts))
    sheet = layout.sheet(
        "Variance of integration", caption, len(parts), 3.4, [2.9], columns=columns, left=0.7,
        between=0.85 + layout.legend_room(["x" * longest]), under=0.46,
        right=layout.legend_room(["x" * longest]),
    )  # fmt: skip
    for (ax,), (key, part) in zip(sheet.cells, parts, strict=True):
        panel(ax, part, by_source)
        ax.set_title(f"{captions.shown(str(key[0]), 40)}, d = {key[1]}", loc="left")
        ax.set_xlabel("points n")
        ax.set_ylabel("variance")
        handles = [
            Line2D(
                [],
                [],
                color=by_source[label].colour,
                linestyle=by_source[label].dash,
                marker="o",
                markersize=2.6,
            )
            for label in dict.fromkeys(part["source"].astype(str))
        ]
        layout.beside(ax, handles, keys[key])
    return sheet.figure


def _key(study: IntegrationStudy, part: pd.DataFrame) -> list[str]:
    """Name the sources of a panel with their slopes."""
    labels = []
    slopes = study.slopes
    for label in dict.fromkeys(part["source"].astype(str)):
        found = slopes[
            (slopes["source"] == label) & (slopes["d"] == part["d"].iloc[0])
            & (slopes["integrand"] == part["integrand"].iloc[0])
        ]  # fmt: skip
        text = captions.shown(label, 22)
        if len(found) and math.isfinite(found["slope"].iloc[0]):
            text += f"  {found['slope'].iloc[0]:.2f} ± {found['standard_error'].iloc[0]:.2f}"
            text += " bent" if found["scatter"].iloc[0] > MOST_SCATTER else ""
        labels.append(text)
    return labels


def _span(values: Any) -> str:
    low, high = int(min(values)), int(max(values))
    return f"{low:,}" if low == high else f"{low:,} to {high:,}"
