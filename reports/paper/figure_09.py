"""Figure 9: variance of integration in two, three and eight dimensions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import SubFigure
from matplotlib.lines import Line2D

from gbnbench.analysis.integration.integrands.registry import find
from gbnbench.reports.integration import variance
from gbnbench.reports.paper.data import DataRequest, IntegrationRequest, TableRequest
from gbnbench.reports.paper.figure import PAGE, Drawing, FigureOptions, PaperFigure
from gbnbench.reports.paper.method_styles import stroke, title_of
from gbnbench.runs.task_folder import Arrays
from gbnbench.studies.integration.blocks import instances_of

FAMILIES = ("gaussians", "half-space")
TITLES = {"gaussians": "64 Gaussians", "half-space": "half spaces"}
DIMENSIONS = (2, 3, 8)
COMMON = ("random", "jittered", "sobol", "gbn")
SOURCES: dict[int, tuple[str, ...]] = {
    2: (*COMMON, "fpo", "bnot"),
    3: (*COMMON, "sliced"),
    8: (*COMMON, "sliced"),
}
SIZES: dict[str, dict[int, tuple[int, ...]]] = {
    "tiny": {2: (16, 64), 3: (8, 27), 8: (4, 16)},
    "quick": {
        2: (16, 32, 64, 128, 256, 512, 1024, 2048, 4096),
        3: (8, 27, 64, 125, 216, 512, 1000, 2197),
        8: (4, 16, 64, 128, 256, 512, 1024),
    },
    "full": {
        2: (4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192),
        3: (8, 27, 64, 125, 216, 343, 512, 1000, 2197, 4096),
        8: (4, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096),
    },
}
MARK = 512  # points of the nominal grid that the Gaussians' width is that of


def pictures(seed: int, pixels: int) -> Arrays:
    """Compute pictures of the first integrand of each family in the plane.

    Parameters
    ----------
    seed : int
        Seed of the integrands.
    pixels : int
        Pixels along a side.

    Returns
    -------
    dict
        Family -> (pixels, pixels) float64, row 0 at y = 0.
    """
    side = (np.arange(pixels) + 0.5) / pixels
    grid = np.stack(np.meshgrid(side, side), axis=-1).reshape(-1, 2)
    return {name: instances_of(find(name), 2, seed, 1)[0](grid).reshape(pixels, pixels) for name in FAMILIES}


def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
    """Ask for a study in each dimension, and a picture of an integrand of each family."""
    instances = options.pick(4, 50, 100)
    requests: dict[str, DataRequest] = {"integrands": TableRequest(pictures, {"plane": (options.seed, 96)})}
    for d in DIMENSIONS:
        sets = options.pick(2, 8, 1000 if d == 2 else 100)
        ours = tuple(name for name in SOURCES[d] if name not in options.sets)
        requests[f"d{d}"] = IntegrationRequest(ours, SIZES[options.scale][d], (d,), sets, FAMILIES, instances)
    for name, path in options.sets.items():
        requests[_user_study(name)] = IntegrationRequest(
            (path,), (1,), (1,), 1, FAMILIES, instances, reading=options.reading
        )
    return requests


def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:
    """Draw the variance against n, with a row for each family of integrands and a column for each dimension.

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
    tables = {d: _table(data, options, d) for d in DIMENSIONS}
    labels = list(dict.fromkeys(label for table in tables.values() for label in table["source"]))
    strokes = {label: stroke(label) for label in labels}

    def paint(panel: SubFigure) -> None:
        axes = panel.subplots(len(FAMILIES), len(DIMENSIONS), squeeze=False)
        for row, family in enumerate(FAMILIES):
            for column, d in enumerate(DIMENSIONS):
                ax, table = axes[row, column], tables[d]
                variance.panel(ax, table[table["integrand"] == family], strokes)
                letter = "ab"[row]
                ax.set_title(f"({letter}) {TITLES[family]}, {d}D", loc="left")
                if row == len(FAMILIES) - 1:
                    ax.set_xlabel("points n")
                if column == 0:
                    ax.set_ylabel("variance")
                    _inset(ax, data["integrands"]["plane"][family])
        for column, d in enumerate(DIMENSIONS):
            if min(SIZES[options.scale][d]) < MARK < max(SIZES[options.scale][d]):
                axes[0, column].axvline(MARK, color="#9aa3af", linewidth=0.6, linestyle=(0, (2, 2)), zorder=0)
        handles = [
            Line2D(
                [], [], color=strokes[label].colour, linestyle=strokes[label].dash, marker="o", markersize=2.6
            )
            for label in labels
        ]
        names = [title_of(label) for label in labels]
        handles.append(Line2D([], [], color="#9aa3af", linewidth=2.2, alpha=0.7))
        names.append("1/n")
        panel.legend(handles, names, loc="outside lower center", ncols=len(names), columnspacing=1.2)

    return Drawing(PAGE, 4.4, paint, _caption(data))


def _user_study(name: str) -> str:
    """Key of the study of a method that the user has sets of."""
    return f"sets of {name}"


def _table(data: Mapping[str, Any], options: FigureOptions, d: int) -> pd.DataFrame:
    """All variances in one dimension, the user's sets under their method's name."""
    parts = [data[f"d{d}"].variance]
    for name in options.sets:
        theirs = data[_user_study(name)].variance
        parts.append(theirs[theirs["d"] == d].assign(source=name))
    table: pd.DataFrame = pd.concat(parts, ignore_index=True)
    return table


def _inset(ax: Axes, picture: Any) -> None:
    """Show the integrand in the lower left corner, where no curve goes."""
    corner = ax.inset_axes((0.03, 0.04, 0.24, 0.3))
    corner.imshow(picture, cmap="gray", extent=(0, 1, 0, 1), interpolation="nearest")
    corner.set_xticks([])
    corner.set_yticks([])
    for spine in corner.spines.values():
        spine.set_visible(True)


def _caption(data: Mapping[str, Any]) -> str:
    counts = []
    for d in DIMENSIONS:
        table = data[f"d{d}"].variance
        generated = table[table["source"].isin(SOURCES[d])]
        counts.append(f"{int(generated['realizations'].max()):,} sets in {d}D")
    plane = data["d2"].slopes
    slopes = []
    for family in FAMILIES:
        found = plane[(plane["integrand"] == family) & plane["source"].isin(["random", "gbn"])]
        slopes += [
            f"{row.source} {row.slope:.2f} ± {row.standard_error:.2f} for {TITLES[family]}"
            for row in found.itertuples()
        ]
    return (
        "Variance of the integral estimated by the mean over n points: (a) toroidal sums of 64 Gaussians of "
        "width 512^(-1/d), (b) half spaces by a random point and direction; insets: one of each. "
        f"{int(data['d2'].variance['instances'].max())} integrands of each family, {', '.join(counts)}, "
        "all estimated with all. Bands: 95%. Crosses: what the sets' power spectra predict. Grey: 1/n; "
        "dashed upright: n = 512, the nominal grid that the Gaussians' width is of. jittered is made at "
        f"n = m^d alone. Slopes over all n in 2D: {'; '.join(slopes)}."
    )


FIGURE = PaperFigure(
    "9",
    "Variance of integration in 2, 3 and 8 dimensions",
    "GBN is orders of magnitude below the others for smooth isotropic integrands in all dimensions, in a "
    "sigmoid that falls steeply until about 512 points, the nominal sampling of the Gaussians, and slowly "
    "beyond; half spaces show the same rate for all sets, closer to white noise with more dimensions, "
    "Owen-scrambled Sobol slightly ahead.",
    needs,
    draw,
)
