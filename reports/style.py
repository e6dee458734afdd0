"""Style of every figure: matplotlib settings, the stroke of each source, and sheets laid out in inches."""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache, wraps
from typing import Any, ParamSpec, TypeVar

import matplotlib as mpl
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.font_manager import findfont, get_font

from gbnbench.runs.comparison_result import Run, SourceResult

# Okabe & Ito (2008), told apart with any colour vision; their yellow is darkened to be read on white.
COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#222222", "#9A8B00")
DASHES: tuple[Any, ...] = ("-", (0, (4, 1.5)), (0, (1, 1.2)), (0, (5, 1.5, 1, 1.5)))
DPI = 130  # of every PNG
NBSP = "\N{NO-BREAK SPACE}"
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
    "axes.labelpad": 2.5,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.formatter.use_mathtext": True,
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


def styled(draw: Callable[P, T]) -> Callable[P, T]:
    """Make a function draw with gbnbench's style over matplotlib's defaults, whatever the user's settings."""

    @wraps(draw)
    def inside(*args: P.args, **kwargs: P.kwargs) -> T:
        with mpl.rc_context():
            mpl.rcdefaults()
            mpl.rcParams.update(STYLE)  # type: ignore[arg-type]
            return draw(*args, **kwargs)

    return inside


@dataclass(frozen=True)
class Stroke:
    """Colour and dash of one source, the same in every figure of a run."""

    colour: str
    dash: Any


def strokes(run: Run) -> dict[str, Stroke]:
    """Assign each source key a stroke; sources of one label share it over all n and d of the run."""
    assigned: dict[tuple[str, int], Stroke] = {}
    seen: dict[tuple[str, int, int], int] = {}
    result: dict[str, Stroke] = {}
    for source in run.sources:
        place = (source.label, source.n, source.d)
        twin = seen.get(place, 0)
        seen[place] = twin + 1
        if (source.label, twin) not in assigned:
            turn, colour = divmod(len(assigned), len(COLOURS))
            assigned[source.label, twin] = Stroke(COLOURS[colour], DASHES[turn % len(DASHES)])
        result[source.key] = assigned[source.label, twin]
    return result


Group = tuple[int, int]


def groups(run: Run) -> list[Group]:
    """List each (n, d) of the run once, in the order of the sources; only sources of one are compared."""
    return list(dict.fromkeys((source.n, source.d) for source in run.sources))


def members(run: Run, group: Group | None) -> list[SourceResult]:
    """Return the sources of one size and dimension.

    Parameters
    ----------
    run : Run
        The comparison.
    group : (n, d) or None
        Size and dimension; None takes all sources.

    Returns
    -------
    list of SourceResult
        Sources in the run's order.
    """
    return [source for source in run.sources if group is None or (source.n, source.d) == group]


@lru_cache(maxsize=4096)
def _has_glyph(character: str) -> bool:
    return bool(get_font(findfont("DejaVu Sans")).get_char_index(ord(character)))


def shown(text: str, width: int = 26) -> str:
    """Shorten a text and make matplotlib draw it literally, without mathtext.

    Parameters
    ----------
    text : str
        Text from the user, such as a label.
    width : int
        Most characters; a longer text loses some of its middle.

    Returns
    -------
    str
        The text with ``$`` escaped, and a box for each sign that the font lacks.

    Examples
    --------
    >>> shown("gbn[iterations=1000]")
    'gbn[iterations=1000]'
    >>> shown("a" * 40, 9)
    'aaaaa…aaa'
    """
    if len(text) > width:
        tail = (width - 1) * 2 // 5
        text = f"{text[: width - 1 - tail]}…{text[len(text) - tail :]}"
    text = "".join(
        c if _has_glyph(c) and (c.isprintable() or c == NBSP) else "\N{WHITE SQUARE}" for c in text
    )
    text = text.replace("$", r"\$")
    return f" {text}" if text.startswith("_") else text  # a legend drops labels that start with _


def name(source: SourceResult, run: Run, width: int = 26) -> str:
    """Return the label of a source for a figure.

    Parameters
    ----------
    source : SourceResult
        Source to name.
    run : Run
        The comparison.
    width : int
        Most characters of the label.

    Returns
    -------
    str
        The label, followed by n and d where they vary in the run.
    """
    every = groups(run)
    marks = [f"n={source.n}"] if len({n for n, _ in every}) > 1 else []
    marks += [f"d={source.d}"] if len({d for _, d in every}) > 1 else []
    return shown(source.label, width) + (f" ({', '.join(marks)})" if marks else "")


def _span(values: Sequence[int]) -> str:
    low, high = min(values), max(values)
    return f"{low:,}" if low == high else f"{low:,} to {high:,}"


def settings(run: Run, group: Group | None = None) -> str:
    """Describe the settings of a run in one line for a caption.

    Parameters
    ----------
    run : Run
        The comparison.
    group : (n, d), optional
        Describe only the sources of this size and dimension.

    Returns
    -------
    str
        n, d, realizations, seed, device and version, as far as they are known.
    """
    sources = members(run, group)
    parts = []
    if sources:
        sets = _span([s.realizations for s in sources])
        parts = [f"n = {_span([s.n for s in sources])}", f"d = {_span([s.d for s in sources])}"]
        parts.append(f"{sets} realization{'' if sets == '1' else 's'}")
    if run.manifest.get("seed") is not None:
        parts.append(f"seed {run.manifest['seed']}")
    device = run.manifest.get("device")
    label = device.get("name") if isinstance(device, Mapping) else device
    if label:
        parts.append(str(label).strip())
    if run.manifest.get("version"):
        parts.append(f"gbnbench {run.manifest['version']}")
    return " · ".join(part.replace(" ", NBSP) for part in parts)


@dataclass(frozen=True)
class Sheet:
    """A figure of equal cells, each of them a stack of axes.

    Attributes
    ----------
    figure : Figure
        Figure with its title and caption drawn.
    cells : list of list of Axes
        One stack of axes for each source, the top axes first.
    first : list of bool
        Whether each cell stands at the left edge, where axis labels go.
    foot : float
        Height in inches of the upper edge of the caption. Colour bars and keys go above it.
    """

    figure: Figure
    cells: list[list[Axes]]
    first: list[bool]
    foot: float


def sheet(
    title: str,
    caption: str,
    count: int,
    width: float,
    heights: Sequence[float],
    *,
    columns: int = 4,
    gaps: Sequence[float] = (),
    left: float = 0.5,
    between: float = 0.22,
    under: float = 0.12,
    right: float = 0.2,
    titles: bool = True,
    key: float = 0.0,
) -> Sheet:
    """Lay out a figure of equal cells, each of them a stack of axes.

    Parameters
    ----------
    title, caption : str
        Texts above and below the cells; the caption is folded to the figure's width.
    count : int
        Number of cells, at least 1.
    width : float
        Width of all axes in inches.
    heights : sequence of float
        Heights in inches of the axes in a cell, top first.
    columns : int
        Most cells in a row.
    gaps : sequence of float
        Gaps in inches between the axes of a cell.
    left, between, under, right : float
        Room in inches left of the first cell, between cells, under each cell and right of the last.
    titles : bool
        Whether the cells have titles of their own.
    key : float
        Room in inches between the cells and the caption for a colour bar or legend.

    Returns
    -------
    Sheet
        The figure with empty axes.
    """
    columns = max(1, min(columns, count))
    rows = -(-count // columns)
    head, title_strip = 0.42, 0.26 if titles else 0.06
    total_width = max(left + columns * width + (columns - 1) * between + right, 3.6)
    lines = textwrap.wrap(shown(caption, len(caption)), max(30, int((min(total_width, 13.0) - 0.3) / 0.0545)))
    foot = 0.16 + 0.135 * len(lines)
    cell = title_strip + sum(heights) + sum(gaps) + under
    total_height = head + rows * cell + key + foot
    figure = Figure(figsize=(total_width, total_height))
    figure.text(0.15 / total_width, 1 - 0.14 / total_height, title, size=11, weight="bold", va="top")
    figure.text(
        0.15 / total_width,
        0.1 / total_height,
        "\n".join(lines),
        size=6.8,
        color=FAINT,
        va="bottom",
        linespacing=1.25,
    )
    cells, first = [], []
    for index in range(count):
        row, column = divmod(index, columns)
        x = left + column * (width + between)
        y = total_height - head - row * cell - title_strip
        stack = []
        for position, height in enumerate(heights):
            y -= height
            stack.append(
                figure.add_axes(
                    (x / total_width, y / total_height, width / total_width, height / total_height)
                )
            )
            y -= gaps[position] if position < len(gaps) else 0.0
        cells.append(stack)
        first.append(column == 0)
    return Sheet(figure, cells, first, foot)


def beside(ax: Axes, handles: Sequence[Artist], labels: Sequence[str]) -> None:
    """Put a legend to the right of axes, where ``sheet`` kept the ``legend_room``.

    Parameters
    ----------
    ax : Axes
        Axes that the legend belongs to.
    handles : sequence of Artist
        Curves or markers.
    labels : sequence of str
        Names, as many as handles.
    """
    ax.legend(
        handles, labels, loc="upper left", bbox_to_anchor=(1.01, 1.0), handlelength=2.6, borderaxespad=0.2
    )


def legend_room(labels: Sequence[str]) -> float:
    """Return the width in inches that a legend of these labels takes beside axes."""
    return 0.75 + 0.078 * max((len(label) for label in labels), default=0)


def empty(ax: Axes, reason: str) -> None:
    """Write into axes why they hold no picture.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    reason : str
        Sentence to write.
    """
    frame(ax)
    ax.text(
        0.5,
        0.5,
        textwrap.fill(reason, 24),
        ha="center",
        va="center",
        color=FAINT,
        size=8,
        transform=ax.transAxes,
    )


def frame(ax: Axes) -> None:
    """Draw a closed box without ticks, for pictures."""
    ax.set_xticks([])
    ax.set_yticks([])
    for spine in ax.spines.values():
        spine.set_visible(True)
        spine.set_color(RULE)
