"""Figure 12: step blue noise, by the energy's harmonics up to an edge, beside other ways to it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any

from matplotlib.figure import SubFigure
from matplotlib.ticker import FixedLocator, FuncFormatter

from gbnbench.core.results.radial import RadialPower
from gbnbench.reports import style
from gbnbench.reports.comparison import spectrum
from gbnbench.reports.paper import gallery_requests, panels, radial_axes, wording
from gbnbench.reports.paper.data import ComparisonRequest, DataRequest
from gbnbench.reports.paper.figure import PAGE, Drawing, FigureOptions, PaperFigure
from gbnbench.reports.paper.method_columns import generated_column, user_columns
from gbnbench.reports.paper.method_styles import stroke

EDGES = (0.5, 0.6, 0.7)  # nu: the paper's, and two wider ones; 320 gradients do not empty the last
CLAIM = 1e-8  # the paper's low band is below
PAPER = ("step",)
LOW, HIGH = 1e-32, 1e2


def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
    """Ask for truncated energies, a band emptied by Gauss-Newton, and the user's sets of Heck's step."""
    sources = (*(f"gbn[edge={edge}]" for edge in EDGES), f"stealthy[edge={EDGES[-1]}]")
    run = ComparisonRequest(sources, (gallery_requests.size(options),), (2,), gallery_requests.sets(options))
    return {"sets": run, **gallery_requests.method_requests(options, PAPER)}


def band(radial: RadialPower, edge: float) -> float:
    """Return the highest radial power below an edge.

    Parameters
    ----------
    radial : RadialPower
        Radial power on exact shells.
    edge : float
        Edge in nu; the shell at the edge is left out.

    Returns
    -------
    float
        Power over that of white noise.
    """
    return float(radial.power[radial.nu < edge * (1 - 1e-9)].max())


def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:
    """Draw points, spectrum and radial power in log scale for each way to step blue noise.

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
    cut = [generated_column(data["sets"], f"gbn[edge={e}]", n, f"harmonics to {e}") for e in EDGES]
    newton = generated_column(data["sets"], f"stealthy[edge={EDGES[-1]}]", n, f"stealthy to {EDGES[-1]}")
    theirs = [replace(one, title="Step") for one in user_columns(data, PAPER, n)]
    columns, edges = [*cut, newton, *theirs], [*EDGES, EDGES[-1], None]
    wide = (PAGE - 0.4) / len(columns) - 0.1

    def paint(panel: SubFigure) -> None:
        axes = panel.subplots(3, len(columns), height_ratios=[1, 1, 0.85])
        for k, one in enumerate(columns):
            points, grey, power = axes[:, k]
            panels.scatter(points, one.source, wide)
            panels.heading(points, "abcde"[k], one.title)
            spectrum.panel(grey, one.source, None, ticks=False)
            radial_axes.white(power)
            power.axhline(CLAIM, color=style.FAINT, linewidth=0.7, linestyle=(0, (3, 2)))
            if edges[k] is not None:
                power.axvline(edges[k], color=style.FAINT, linewidth=0.7, linestyle=(0, (1, 1.5)))
            radial_axes.curve(power, one.source.radial, stroke("gbn") if k < len(cut) else one.stroke)
            power.set(xlim=(0, 2), xlabel=radial_axes.NU)
            power.xaxis.set_major_locator(FixedLocator([0, 0.5, 1, 1.5, 2]))
            power.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
            radial_axes.log_power(power, LOW, HIGH, ticks=5)
            power.tick_params(labelleft=k == 0)
        axes[2, 0].set_ylabel("radial power")

    most = [
        wording.rounded(band(one.source.radial, edge))
        for one, edge in zip(columns, edges, strict=False)
        if edge is not None
    ]
    caption = (
        "Step blue noise. (a to c) The energy truncated to the frequencies up to nu = "
        f"{wording.listed([str(edge) for edge in EDGES])} (dotted), the first being the paper's edge, after "
        "320 gradients of Nesterov's method: the highest radial power below the edge is "
        f"{wording.listed(most[:3])}; the paper has less than {CLAIM:.0e} (dashed). What is not converged "
        "keeps the Gaussian's exponential profile. (d) Minimum-norm Gauss-Newton steps empty the widest of "
        f"these bands down to rounding, {most[3]}. "
    )
    if theirs:
        given = ", the sets given" if "step" in options.sets else ""
        low = wording.rounded(band(theirs[0].source.radial, EDGES[0]))
        caption += f"(e) The step of Heck et al. 2013{given}: the highest below {EDGES[0]} is {low}. "
    caption += (
        "Top: a set; middle: the mean spectrum in PSA's grey; bottom: radial power on exact shells in log "
        f"scale, with white noise at 1. {wording.counted(columns)}, d = 2. The edge bounds |f| here, "
        "in the paper each of its components."
    )
    if not theirs:
        caption += " The step of Heck et al. in the paper is left out: no sets were given (--sets step=PATH)."
    return Drawing(PAGE, 0.6 + 2.95 * wide, paint, caption)


FIGURE = PaperFigure(
    "12",
    "Step blue noise",
    "Truncating the energy's harmonics at sqrt(N)/2 gives an almost perfect step whose radial power at low "
    "frequencies is below 1e-8, orders of magnitude below the step of Heck et al. 2013.",
    needs,
    draw,
)
