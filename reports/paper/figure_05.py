"""Figure 5: what cutting the kernel off in space does to the sets."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from matplotlib import colormaps
from matplotlib.colors import to_hex
from matplotlib.figure import SubFigure

from gbnbench.reports import style
from gbnbench.reports.comparison import spectrum
from gbnbench.reports.paper import gallery_requests, panels, radial_axes, wording
from gbnbench.reports.paper.data import ComparisonRequest, DataRequest
from gbnbench.reports.paper.figure import PAGE, Drawing, FigureOptions, PaperFigure
from gbnbench.reports.paper.method_columns import generated_column
from gbnbench.reports.paper.method_styles import stroke

CUTOFFS = (1, 2, 3, 4)  # sigmas
STROKES = (
    *(
        style.Stroke(to_hex(colormaps["viridis"](0.85 - 0.2 * k)), style.DASHES[0])
        for k in range(len(CUTOFFS))
    ),
    stroke("gbn"),
)


def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
    """Ask for sets at each cut-off, of the whole kernel, and of centroidal tessellations."""
    cut = tuple(f"gbn[cutoff={cutoff}]" for cutoff in CUTOFFS)
    return {
        "cut": ComparisonRequest(
            cut, (gallery_requests.size(options),), (2,), gallery_requests.sets(options)
        ),
        "whole": gallery_requests.classic(options),
        "cvt": gallery_requests.relaxed(options),
    }


def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:
    """Draw points, spectrum and radial power for each cut-off.

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
    n = gallery_requests.size(options)
    columns = [
        generated_column(data["cvt"], "lloyd", n, "CVT"),
        *(
            generated_column(data["cut"], f"gbn[cutoff={cutoff}]", n, f"cut at {cutoff}σ")
            for cutoff in CUTOFFS
        ),
        generated_column(data["whole"], "gbn", n, "whole"),
    ]
    strokes = [columns[0].stroke, *STROKES]
    low = radial_axes.lowest(one.source.radial for one in columns)

    def paint(panel: SubFigure) -> None:
        axes = panel.subplots(3, len(columns), height_ratios=[1, 1, 1.05])
        for k, (one, line) in enumerate(zip(columns, strokes, strict=True)):
            points, grey, power = axes[:, k]
            panels.scatter(points, one.source, 1.05)
            panels.heading(points, "abcdef"[k], one.title)
            spectrum.panel(grey, one.source, None, ticks=False)
            radial_axes.white(power)
            radial_axes.curve(power, columns[-1].source.radial, style.Stroke("#c4cad3", "-"), linewidth=1.6)
            radial_axes.curve(power, one.source.radial, line)
            radial_axes.log_nu(power, 0.97 * n**-0.5, marks=(0.05, 0.2, 1))
            radial_axes.log_power(power, low, 100)
            power.tick_params(labelleft=k == 0)
        axes[2, 0].set_ylabel("radial power")

    floors = [f"{wording.rounded(one.source.measures['noise_floor'])} ({one.title})" for one in columns]
    six = [one.source.measures["valence6"] for one in columns]
    near = [one.source.measures["mean_distance"] for one in columns]
    caption = (
        "What cutting the kernel off in space does: Gaussian Blue Noise of sigma = 1 whose points see each "
        f"other within {wording.listed([str(c) for c in CUTOFFS])} sigma alone, and without end, after the "
        "same number of gradients; (a) centroidal Voronoi tessellations by Lloyd's method, beside 1 sigma. "
        "Top: a set; middle: the mean spectrum in PSA's grey; bottom: radial power on exact shells, the "
        f"whole kernel's repeated in grey. Noise floors: {', '.join(floors)}. With 1 sigma "
        f"{100 * six[1]:.0f}% of the points have six neighbours ({100 * six[0]:.0f}% in the tessellations, "
        f"{100 * six[-1]:.0f}% with the whole kernel). With 2 and 3 sigma points pair up and clump, as the "
        "negative lobes of the cut kernel's transform options: the mean distance to the nearest neighbour is "
        f"{near[2]:.2f} and {near[3]:.2f} of the densest packing's, beside {near[-1]:.2f}. "
        f"{wording.counted(columns)} each, d = 2. The paper took 10,000 steps of descent; 320 gradients of "
        "Nesterov's method do the work of about as many."
    )
    return Drawing(PAGE, 3.75, paint, caption)


FIGURE = PaperFigure(
    "5",
    "Effect of truncation",
    "With the same 10,000 steps, kernels cut off at a few sigma distort the spectrum in different ways; "
    "within 1 sigma, about the first ring of Voronoi neighbours, the sets resemble centroidal Voronoi "
    "tessellations.",
    needs,
    draw,
)
