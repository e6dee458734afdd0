"""Figures laid out in inches: sheets of equal cells, legends beside axes, frames of pictures."""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from gbnbench.core.readable_text import display_width
from gbnbench.reports.captions import shown
from gbnbench.reports.plot_axes import PlotAxes
from gbnbench.reports.style import FAINT, RULE


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
    rows = -(-count // max(1, min(columns, count)))
    columns = -(-count // rows)  # rows of like length
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
                    (x / total_width, y / total_height, width / total_width, height / total_height),
                    axes_class=PlotAxes,
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
    return 0.75 + 0.078 * max(map(display_width, labels), default=0)


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
