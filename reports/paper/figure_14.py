"""Figure 14: radial power on exact shells and over annuli of width 2."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from matplotlib.figure import SubFigure

from gbnbench.analysis.radial.radial_power import radial
from gbnbench.reports.paper import gallery_requests, panels, radial_axes, wording
from gbnbench.reports.paper.data import ComparisonRequest, DataRequest
from gbnbench.reports.paper.figure import PAGE, Drawing, FigureOptions, PaperFigure
from gbnbench.reports.paper.method_columns import generated_column, user_columns

WIDTH = 2.0  # cycles per unit length: PSA's default
PAPER = ("bnot",)


def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
    """Ask for many Owen-scrambled Sobol sets, and for GBN or the user's BNOT."""
    many = ComparisonRequest(("sobol",), (gallery_requests.size(options),), (2,), options.pick(4, 160, 1000))
    return {
        "sobol": many,
        "classic": gallery_requests.classic(options),
        **gallery_requests.method_requests(options, PAPER),
    }


def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:
    """Draw the radial power on exact shells above that over annuli, for each example.

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
    examples = [
        *(user_columns(data, PAPER, n) or [generated_column(data["classic"], "gbn", n)]),
        generated_column(data["sobol"], "sobol", n),
    ]
    exact = [one.source.radial for one in examples]
    rings = [radial(one.source.spectrum, by="annuli", width=WIDTH) for one in examples]
    low = [radial_axes.lowest([shells]) / 3 for shells in exact]

    def paint(panel: SubFigure) -> None:
        axes = panel.subplots(2, 2, sharex=True)
        for row, (powers, name) in enumerate([(exact, "exact shells"), (rings, "annuli of width 2")]):
            for k, (power, one) in enumerate(zip(powers, examples, strict=True)):
                ax = axes[row, k]
                radial_axes.white(ax)
                radial_axes.curve(ax, power, one.stroke, marker="o", markersize=1.6 if row == 0 else 2.6,
                             markeredgewidth=0, linewidth=0.45 if row == 0 else 0.9)  # fmt: skip
                radial_axes.log_nu(ax, 0.9 * n**-0.5)
                radial_axes.log_power(ax, low[k], 30)
                panels.heading(ax, "abcd"[2 * row + k], f"{one.title}, {name}")
                if row == 0:
                    ax.set_xlabel("")
                if k == 0:
                    ax.set_ylabel("radial power")

    first = [
        f"{wording.rounded(float(ring.power[0]))} at a mean |f| of {ring.frequency[0]:.2f} where the exact "
        f"power at |f| = 1 is {wording.rounded(float(shells.power[0]))} ({one.title})"
        for ring, shells, one in zip(rings, exact, examples, strict=True)
    ]
    caption = (
        "What averaging over annuli hides. Top: radial power on exact shells, all frequencies of one |f|, a "
        f"dot a shell; bottom: the same spectra over annuli of width {WIDTH:g}, PSA's default, "
        f"{len(rings[0].nu):,} in place of {len(exact[0].nu):,} values. The grey line at 1 is white noise. "
        f"The innermost annulus has {' and '.join(first)}. The dips of Owen-Sobol, which the annuli hide, "
        "are the shells that lie on the axes alone, |f| = 1, 2, 3, 4, 6, 7, 8, 9, 11 and so on: its "
        "projections on either axis are stratified n-fold. "
        f"{wording.counted(examples)}, d = 2."
    )
    if "bnot" not in data:
        caption += " The first example here is GBN; sets given as --sets bnot=PATH take its place."
    return Drawing(PAGE, 3.7, paint, caption)


FIGURE = PaperFigure(
    "14",
    "Exact shells and annuli",
    "Averaging a periodogram over annuli, as PSA does by default with a width of 2, distorts the lowest "
    "frequencies and hides a wealth of detail, above all of Owen-scrambled Sobol, whose profile is of the "
    "polynomial family like those of stratified sets and BNOT.",
    needs,
    draw,
)
