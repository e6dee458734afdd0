"""Parts that several figures of the paper share: requests for data, names and strokes of methods, panels."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import LogNorm
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from gbnbench.core.results.radial import RadialPower
from gbnbench.core.settings import specification
from gbnbench.generators.registry import find
from gbnbench.reports import style
from gbnbench.reports.comparison import spectrum
from gbnbench.reports.paper.data import ComparisonRequest
from gbnbench.reports.paper.figure import FigureOptions
from gbnbench.runs.comparison_result import Run, SourceResult

NAMES = {
    "random": "Random", "jittered": "Stratified", "sobol": "Owen-Sobol", "halton": "Halton", "lloyd": "CVT",
    "fpo": "FPO", "gbn": "GBN", "deep": "Deep", "stealthy": "Stealthy", "bnot": "BNOT", "kdm": "KDM",
    "vnc": "VnC", "bluenets": "BlueNets", "ccvt": "CCVT", "step": "Step", "staircase": "Staircase",
}  # fmt: skip
_C, _D = style.COLOURS, style.DASHES
STROKES = {
    "gbn": style.Stroke(_C[0], _D[0]),
    "bnot": style.Stroke(_C[1], _D[0]),
    "fpo": style.Stroke(_C[2], _D[0]),
    "sobol": style.Stroke(_C[3], _D[0]),
    "vnc": style.Stroke(_C[4], _D[0]),
    "lloyd": style.Stroke(_C[5], _D[0]),
    "random": style.Stroke(_C[6], _D[0]),
    "jittered": style.Stroke(_C[7], _D[0]),
    "deep": style.Stroke(_C[1], _D[1]),
    "stealthy": style.Stroke(_C[2], _D[1]),
    "kdm": style.Stroke(_C[3], _D[1]),
    "step": style.Stroke(_C[4], _D[1]),
    "bluenets": style.Stroke(_C[5], _D[1]),
    "halton": style.Stroke(_C[6], _D[1]),
    "staircase": style.Stroke(_C[7], _D[1]),
    "ccvt": style.Stroke(_C[1], _D[2]),
    "latin": style.Stroke(_C[3], _D[2]),
    "grid": style.Stroke(_C[6], _D[2]),
    "hexagonal": style.Stroke(_C[7], _D[2]),
}
VARIANT = {_D[0]: _D[1], _D[1]: _D[3], _D[2]: _D[3]}  # dash of a method with settings of its own
POWER = (1e-12, 10.0)  # what the log10 map reaches in these figures
MARKS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0)  # of nu in log scale
NU = r"$\nu=|f|\,n^{-1/2}$"


@dataclass(frozen=True)
class Column:
    """A method in a figure.

    Attributes
    ----------
    title : str
        Name of the method in the figure.
    source : SourceResult
        Its sets and their measures.
    stroke : Stroke
        Colour and dash of its curves.
    """

    title: str
    source: SourceResult
    stroke: style.Stroke


def size(options: FigureOptions) -> int:
    """Return the number of points of a set in the galleries."""
    n: int = options.pick(100, 1024, 1024)
    return n


def sets(options: FigureOptions) -> int:
    """Return the number of sets of each method in the galleries."""
    count: int = options.pick(2, 16, 1000)
    return count


def classic(options: FigureOptions) -> ComparisonRequest:
    """Return the request for FPO and GBN that figures 1 and 8 make."""
    return ComparisonRequest(("fpo", "gbn"), (size(options),), (2,), sets(options))


def relaxed(options: FigureOptions) -> ComparisonRequest:
    """Return the request for Lloyd's method that figures 5 and 8 make."""
    return ComparisonRequest(("lloyd",), (size(options),), (2,), sets(options))


def methods_with_sets(options: FigureOptions, paper: Sequence[str]) -> tuple[str, ...]:
    """List the methods without a generator whose sets the user gave for a figure.

    Parameters
    ----------
    options : FigureOptions
        Scale, sets of the user and seed.
    paper : sequence of str
        Methods of the paper's figure, in its order.

    Returns
    -------
    tuple of str
        Those of the paper first, then methods that the paper does not name.
    """
    return (
        *(name for name in paper if name in options.sets),
        *(name for name in options.sets if name not in NAMES),
    )


def user_set_requests(options: FigureOptions, methods: Iterable[str]) -> dict[str, ComparisonRequest]:
    """Return requests for the user's sets of these methods, equal in every figure so that they are shared.

    Parameters
    ----------
    options : FigureOptions
        Scale, sets of the user and seed.
    methods : iterable of str
        Names of methods.

    Returns
    -------
    dict
        Method -> request, for the methods that the user gave sets of.
    """
    return {
        name: ComparisonRequest((options.sets[name],), reading=options.reading)
        for name in methods
        if name in options.sets
    }


def missing_sets_note(options: FigureOptions, methods: Iterable[str], whose: str = "of the paper") -> str:
    """Name the methods without sets in a sentence for the caption.

    Parameters
    ----------
    options : FigureOptions
        Scale, sets of the user and seed.
    methods : iterable of str
        Methods that the figure could show.
    whose : str
        Words after their names.

    Returns
    -------
    str
        The sentence, empty where the user gave sets of all.
    """
    names = [name for name in methods if name not in options.sets]
    if not names:
        return ""
    verb, them = ("is", "it") if len(names) == 1 else ("are", "them")
    return (
        f"{listed([NAMES[name] for name in names])} {whose} {verb} left out: there is no generator for "
        f"{them} here and no sets were given (--sets {names[0]}=PATH)."
    )


def generated_column(run: Run, text: str, n: int, title: str | None = None) -> Column:
    """Select the plane sets of a generator from a run.

    Parameters
    ----------
    run : Run
        The comparison.
    text : str
        Generator with its settings, as typed.
    n : int
        Number of points.
    title : str, optional
        Title of the column; the name of the method where not given.

    Returns
    -------
    Column
        The column of the figure.
    """
    label = specification(find(text))
    (source,) = (s for s in run.sources if (s.label, s.n, s.d) == (label, n, 2))
    return Column(title or title_of(label), source, stroke(label))


def user_columns(data: Mapping[str, Any], methods: Iterable[str], n: int) -> list[Column]:
    """Select the user's plane sets of these methods.

    Parameters
    ----------
    data : mapping
        Data under the names that ``needs`` gives them.
    methods : iterable of str
        Names of methods; those without plane sets are left out.
    n : int
        Preferred number of points; otherwise the largest sets are taken.

    Returns
    -------
    list of Column
        One column for each method that has plane sets.
    """
    found = []
    for name in methods:
        flat = [source for source in data[name].sources if source.d == 2] if name in data else []
        if flat:
            best = max(flat, key=lambda source: (source.n == n, source.n))
            found.append(Column(title_of(name), best, stroke(name)))
    return found


def title_of(label: str) -> str:
    """Return the name of a method for a figure, from a generator's text or from the name of user's sets."""
    name = label.partition("[")[0]
    return style.shown(NAMES.get(name, name), 14)


def stroke(label: str) -> style.Stroke:
    """Return the stroke of a method in every figure; a method with settings of its own has another dash.

    Examples
    --------
    >>> stroke("gbn") == stroke("gbn"), stroke("gbn").colour == stroke("gbn[sigma=0.8]").colour
    (True, True)
    >>> stroke("gbn") == stroke("gbn[sigma=0.8]")
    False
    """
    name, bracket, _ = label.partition("[")
    usual = STROKES.get(name, style.Stroke(style.FAINT, style.DASHES[3]))
    return style.Stroke(usual.colour, VARIANT.get(usual.dash, usual.dash)) if bracket else usual


def listed(words: Sequence[str]) -> str:
    """Join words as in a sentence, such as ``a, b and c``."""
    return " and ".join(filter(None, [", ".join(words[:-1]), *words[-1:]]))


def counted(columns: Sequence[Column]) -> str:
    """Say how many sets of how many points are shown: ``16 sets of 1,024 points (BNOT: 4 of 1,024)``."""
    counts = Counter((one.source.n, one.source.realizations) for one in columns)
    most = counts.most_common(1)[0][0]
    usual = next(one.source for one in columns if (one.source.n, one.source.realizations) == most)
    text = f"{_sets(usual.realizations)} of {usual.n:,} points"
    odd = [
        f"{one.title}: {one.source.realizations:,} of {one.source.n:,}"
        for one in columns
        if (one.source.n, one.source.realizations) != (usual.n, usual.realizations)
    ]
    return text + (f" ({'; '.join(odd)})" if odd else "")


def _sets(count: int) -> str:
    return f"{count:,} set{'' if count == 1 else 's'}"


def rounded(value: float) -> str:
    """Format a number for a caption with two digits, such as 1.2e-09 or 0.31."""
    return f"{value:.1e}" if value and not 0.01 <= abs(value) < 1000 else f"{value:.2g}"


def heading(ax: Axes, letter: str, title: str) -> None:
    """Write a panel's letter and title above it.

    Parameters
    ----------
    ax : Axes
        Axes of the panel.
    letter : str
        Letter of the panel, without brackets.
    title : str
        Title of the panel.
    """
    ax.set_title(f"({letter}) {title}", loc="left", size=7.5, pad=2.5)


def scatter(ax: Axes, source: SourceResult, inches: float) -> None:
    """Draw the first set of a source in the unit square.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    source : SourceResult
        Source to draw.
    inches : float
        Approximate width of the axes, which sets the size of the dots.
    """
    x = source.points[0]
    diameter = min(max(0.36 * 72 * inches / math.sqrt(len(x)), 0.55), 4.0)
    ax.plot(
        x[:, 0], x[:, 1], "o", markersize=diameter, markeredgewidth=0, color=style.INK,
        rasterized=len(x) > 4096,
    )  # fmt: skip
    ax.set(xlim=(0, 1), ylim=(0, 1), aspect="equal")
    style.frame(ax)


def power_map(ax: Axes, source: SourceResult, reach: float, limits: tuple[float, float] = POWER) -> None:
    """Draw the middle of a spectrum in log10.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    source : SourceResult
        Source to draw.
    reach : float
        Half the side of the square that is shown, in nu.
    limits : (float, float)
        Range of the colour scale.
    """
    spectrum.panel(ax, source, LogNorm(*limits, clip=True), ticks=False)
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach))


def power_bar(axes: Sequence[Axes], limits: tuple[float, float] = POWER, **where: Any) -> None:
    """Draw the colour bar of ``power_map`` beside axes.

    Parameters
    ----------
    axes : sequence of Axes
        Axes that the bar belongs to.
    limits : (float, float)
        Range of the colour scale.
    **where : any
        Further arguments of ``Figure.colorbar``, such as ``location``.
    """
    figure = axes[0].figure
    low, high = (round(math.log10(limit)) for limit in limits)
    step = max(1, -(-(high - low) // 5))
    bar = figure.colorbar(
        ScalarMappable(LogNorm(*limits), spectrum.palette()), ax=list(axes), aspect=24, pad=0.02,
        ticks=[10.0**k for k in range(0, low - 1, -step)], **where,
    )  # fmt: skip
    bar.outline.set_linewidth(0.4)
    bar.ax.tick_params(labelsize=6.5, length=2, pad=1.5)
    bar.minorticks_off()


def curve(ax: Axes, radial: RadialPower, line: style.Stroke, label: str | None = None, **more: Any) -> None:
    """Draw radial power on its shells; in log scale a power of 0 leaves a gap.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    radial : RadialPower
        Radial power to draw.
    line : Stroke
        Colour and dash.
    label : str, optional
        Name in the legend.
    **more : any
        Further arguments of ``Axes.plot``.
    """
    settings = {"linewidth": 0.9, "rasterized": len(radial.nu) > 6000} | more
    ax.plot(radial.nu, radial.power, color=line.colour, linestyle=line.dash, label=label, **settings)


def white(ax: Axes) -> None:
    """Draw the line at 1, the power of white noise."""
    ax.axhline(1, color="#a3acb9", linewidth=0.8, zorder=1)


def log_nu(ax: Axes, low: float, high: float = 2.0, marks: Sequence[float] = MARKS) -> None:
    """Make the x axis a log axis of nu with few ticks.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    low, high : float
        Range of nu.
    marks : sequence of float
        Values that get a tick where they lie in the range.
    """
    ax.set_xscale("log")
    ax.set_xlim(low, high)
    ax.xaxis.set_major_locator(FixedLocator([mark for mark in marks if low <= mark <= high]))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.xaxis.set_minor_locator(NullLocator())
    ax.set_xlabel(NU)


def log_power(ax: Axes, low: float, high: float, ticks: int = 7) -> None:
    """Make the y axis a log axis of power with few ticks and a faint grid.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    low, high : float
        Range of power.
    ticks : int
        Approximate number of ticks.
    """
    ax.set_yscale("log")
    ax.set_ylim(low, high)
    first, last = math.ceil(math.log10(low) - 1e-9), math.floor(math.log10(high) + 1e-9)
    step = next(step for step in (1, 2, 4, 8, 16, 32) if last - first <= step * ticks)
    marks = range(step * math.ceil(first / step), last + 1, step)  # 1 is always among them
    ax.yaxis.set_major_locator(FixedLocator([10.0**k for k in marks]))
    ax.yaxis.set_minor_locator(NullLocator())
    ax.grid(True, which="major", axis="y")


def lowest(radials: Iterable[RadialPower], floor: float = 1e-32) -> float:
    """Return a power of ten below all radial powers.

    Parameters
    ----------
    radials : iterable of RadialPower
        Curves of a plot.
    floor : float
        Smallest value to return; powers below it are taken for rounding.

    Returns
    -------
    float
        Lower end for the power axis.
    """
    least = min(float(r.power[r.power > floor].min(initial=1.0)) for r in radials)
    return max(floor, 10.0 ** math.floor(math.log10(least)))
