"""Figure 8: the classic measures of blue noise, a column a method."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from matplotlib.figure import SubFigure
from matplotlib.patches import Patch
from matplotlib.ticker import FixedLocator, MaxNLocator

from gbnbench.reports.comparison import spectrum, valence, zone_plate
from gbnbench.reports.paper import gallery_requests, panels, radial_axes, wording
from gbnbench.reports.paper.data import ComparisonRequest, DataRequest
from gbnbench.reports.paper.figure import PAGE, Drawing, FigureOptions, PaperFigure
from gbnbench.reports.paper.method_columns import generated_column, user_columns

PAPER = ("bnot", "kdm", "vnc", "ccvt", "bluenets")
ROWS = ("points", "spectrum", "radial\npower", "zone plate", "valence")


def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
    """Ask for generators that are commonly compared, and the user's sets."""
    strata = ComparisonRequest(
        ("jittered",), (gallery_requests.size(options),), (2,), gallery_requests.sets(options)
    )
    methods = gallery_requests.methods_shown(options, PAPER)
    return {
        "strata": strata, "relaxed": gallery_requests.relaxed(options),
        "classic": gallery_requests.classic(options),
        **gallery_requests.method_requests(options, methods),
    }  # fmt: skip


def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:
    """Draw points, spectrum, radial power, zone plate and valence for each method.

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
        generated_column(data["strata"], "jittered", n),
        generated_column(data["relaxed"], "lloyd", n),
        *user_columns(data, gallery_requests.methods_shown(options, PAPER), n),
        generated_column(data["classic"], "fpo", n),
        generated_column(data["classic"], "gbn", n),
    ]
    top = 0.5 + max(float(one.source.radial.power.max()) for one in columns)
    wide = (PAGE - 0.35) / len(columns) - 0.06

    def paint(panel: SubFigure) -> None:
        axes = panel.subplots(5, len(columns), height_ratios=[1, 1, 0.62, 1, 1], squeeze=False)
        for k, one in enumerate(columns):
            points, grey, power, plate, cells = axes[:, k]
            panels.scatter(points, one.source, wide)
            points.set_title(one.title, size=8, pad=3)
            spectrum.panel(grey, one.source, None, ticks=False)
            radial_axes.white(power)
            radial_axes.curve(power, one.source.radial, one.stroke)
            power.set(xlim=(0, 2), ylim=(0, top))
            power.xaxis.set_major_locator(FixedLocator([0, 1, 2]))
            power.yaxis.set_major_locator(MaxNLocator(4, integer=True))
            power.tick_params(labelleft=k == 0, pad=1.5)
            zone_plate.panel(plate, one.source)
            valence.panel(cells, one.source)
            for patch in cells.patches:
                patch.set_linewidth(min(0.35, 0.22 * wide))
        for ax, name in zip(axes[:, 0], ROWS, strict=True):
            ax.set_ylabel(name, labelpad=2)
        panel.legend(
            [Patch(facecolor=p, edgecolor="#8a94a3", linewidth=0.5) for p in valence.DEGREE_COLOURS.values()],
            [f"{name} neighbours" if k == 4 else name for k, name in valence.DEGREE_NAMES.items()],
            loc="outside lower center", ncols=5, fontsize=7, handlelength=1.0, columnspacing=1.4,
            handletextpad=0.4,
        )  # fmt: skip

    def each(measure: str, scale: float = 1.0, form: str = ".2f") -> str:
        return ", ".join(
            f"{format(scale * one.source.measures[measure], form)} ({one.title})" for one in columns
        )

    floors = ", ".join(
        f"{wording.rounded(one.source.measures['noise_floor'])} ({one.title})" for one in columns
    )
    caption = (
        "The classic measures of blue noise. From top to bottom: a set; the mean spectrum in PSA's grey, "
        "white from a power of 16; radial power on exact shells against nu, with white noise at 1; a zone "
        "plate sampled at the points; and the Voronoi cells by number of neighbours, the valence of the "
        f"Delaunay triangulation. Highest radial power: {each('peak', form='.1f')}. Points with six "
        f"neighbours, in percent: {each('valence6', 100, '.0f')}. Noise floor, mean power up to a nu of "
        f"0.25: {floors}. {wording.counted(columns)}, d = 2; GBN is at sigma = 1 with 320 gradients of "
        f"Nesterov's method, the work of the paper's 10,000 steps. "
        + wording.missing_sets_note(options, PAPER, "of the state of the art")
    ).rstrip()
    height = 0.88 + 4.62 * wide
    return Drawing(PAGE, height, paint, caption)


FIGURE = PaperFigure(
    "8",
    "Classic measures",
    "By the classic measures GBN hardly differs from the state of the art but for the zone plate, whose low "
    "frequencies are cleaner; its radial power has the flattest low band together with the smallest peak.",
    needs,
    draw,
)
