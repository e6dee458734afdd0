"""Style of every figure: matplotlib settings, colours, and the stroke of each source."""

from __future__ import annotations

from collections.abc import Callable
from contextvars import ContextVar
from dataclasses import dataclass
from functools import wraps
from typing import Any, ParamSpec, TypeVar

import matplotlib as mpl
from matplotlib.figure import Figure

from gbnbench.reports import fonts
from gbnbench.runs.comparison_result import Run

# Okabe & Ito (2008), told apart with any colour vision; their yellow is darkened to be read on white.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#222222", "#9A8B00")
ON_DARK: dict[str, str] = dict(  # the same hues, light enough to be told from a dark page
    zip(
        COLOURS,
        ("#3B9FE0", "#F0843C", "#2CC295", "#E39BC4", "#F2B233", "#8FD0F7", "#E6EAF0", "#C9B92E"),
        strict=True,
    )
)
DASHES: tuple[Any, ...] = ("-", (0, (4, 1.5)), (0, (1, 1.2)), (0, (5, 1.5, 1, 1.5)))
DPI = 130  # of every PNG
INK, FAINT, RULE = "#1d2430", "#667080", "#d5dae1"

STYLE: dict[str, Any] = {
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 8,
    "axes.titlesize": 9,
    "axes.labelsize": 8,
    "axes.labelcolor": INK,
    "axes.edgecolor": "#8a94a3",
    "axes.linewidth": 0.7,
    "axes.grid": False,
    "axes.axisbelow": True,
    "axes.titlepad": 5,
    "axes.titley": 1.0,  # where it would be put anyway, after all ticks were asked for their place
    "axes.labelpad": 2.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.formatter.use_mathtext": False,  # a plain number is laid out in a tenth of the time
    "grid.color": "#e6e9ee",
    "grid.linewidth": 0.6,
    "text.color": INK,
    "text.parse_math": True,
    "xtick.color": "#4a5361",
    "ytick.color": "#4a5361",
    "xtick.labelsize": 7,
    "ytick.labelsize": 7,
    "xtick.major.width": 0.7,
    "ytick.major.width": 0.7,
    "xtick.major.size": 2.8,
    "ytick.major.size": 2.8,
    "xtick.minor.size": 1.6,
    "ytick.minor.size": 1.6,
    "legend.frameon": False,
    "legend.fontsize": 8,
    "lines.linewidth": 1.1,
    "figure.facecolor": "white",
    "savefig.facecolor": "white",
    "image.origin": "lower",
    "pdf.fonttype": 42,
}

P = ParamSpec("P")
T = TypeVar("T")


_in_style: ContextVar[bool] = ContextVar("in_style", default=False)


def styled(draw: Callable[P, T]) -> Callable[P, T]:
    """Make a function draw with gbnbench's style over matplotlib's defaults, whatever the user's settings.

    Where such a function calls others, the settings are made once: there are some three hundred.
    """

    @wraps(draw)
    def inside(*args: P.args, **kwargs: P.kwargs) -> T:
        if _in_style.get():
            return draw(*args, **kwargs)
        within = _in_style.set(True)
        try:
            return alone(*args, **kwargs)
        finally:
            _in_style.reset(within)

    def alone(*args: P.args, **kwargs: P.kwargs) -> T:
        with mpl.rc_context(), fonts.without_font_warnings():
            mpl.rcdefaults()
            mpl.rcParams.update(STYLE)  # type: ignore[arg-type]
            mpl.rcParams["font.family"] = fonts.families()  # matplotlib falls back within these alone
            drawn = draw(*args, **kwargs)
            if isinstance(drawn, Figure):
                fonts.renew(drawn)
            return drawn

    return inside


@dataclass(frozen=True)
class Stroke:
    """Colour and dash of one source, the same in every figure of a run."""

    colour: str
    dash: Any

    @property
    def on_dark(self) -> str:
        """The colour on a dark page."""
        return ON_DARK.get(self.colour, self.colour)


def numbered_stroke(number: int) -> Stroke:
    """Give the stroke of a source by its number: colours go round first, then dashes."""
    turn, colour = divmod(number, len(COLOURS))
    return Stroke(COLOURS[colour], DASHES[turn % len(DASHES)])


def strokes(run: Run) -> dict[str, Stroke]:
    """Assign each source key a stroke; sources of one label share it over all n and d of the run.

    In joined runs colours are of sources and dashes of runs, as long as there are enough of both.
    """
    labels = list(dict.fromkeys(label for label, _ in run.series.values()))
    runs = {number for _, number in run.series.values()}
    if run.series and len(labels) <= len(COLOURS) and len(runs) <= len(DASHES):
        return {
            key: Stroke(COLOURS[labels.index(label)], DASHES[number])
            for key, (label, number) in run.series.items()
        }
    assigned: dict[tuple[str, int], Stroke] = {}
    seen: dict[tuple[str, int, int], int] = {}
    result: dict[str, Stroke] = {}
    for source in run.sources:
        place = (source.label, source.n, source.d)
        twin = seen.get(place, 0)
        seen[place] = twin + 1
        if (source.label, twin) not in assigned:
            assigned[source.label, twin] = numbered_stroke(len(assigned))
        result[source.key] = assigned[source.label, twin]
    return result
