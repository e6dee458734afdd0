"""Panels of figure 7: spectra raw and filtered by the kernel, and how their depth progresses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.ticker import LogLocator, NullLocator

from gbnbench.core.torus import FloatArray
from gbnbench.reports import style
from gbnbench.reports.paper import radial_axes

METHODS = {"descent": "descent", "nesterov": "Nesterov's method"}
LOOKS: dict[str, dict[str, Any]] = {
    "descent": {"linestyle": style.DASHES[1], "marker": "s"},
    "nesterov": {"linestyle": "-", "marker": "o"},
}


def raw_spectra(
    ax: Axes, found: Mapping[str, FloatArray], counts: Sequence[int], unit: str, colours: Sequence[str]
) -> None:
    """Draw a curve of radial power for each count of evaluations.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    found : mapping
        Spectra of one method, as ``figure_07.evolution`` returns them.
    counts : sequence of int
        Evaluations after which they were taken.
    unit : str
        What the counts are called in the legend.
    colours : sequence of str
        One for each count.
    """
    for count, power, colour in zip(counts, found["power"], colours, strict=True):
        ax.plot(found["nu"], power, color=colour, linewidth=0.7, label=f"{count:,}")
    radial_axes.loglog(ax, float(found["power"].min()) / 4, _span(found))
    ax.set_ylabel("radial power")
    ax.legend(title=unit, fontsize=5.8, title_fontsize=6.5, loc="lower right", handlelength=1.2,
              labelspacing=0.12, borderaxespad=0.1)  # fmt: skip


def filtered_spectra(ax: Axes, found: Mapping[str, FloatArray], colours: Sequence[str]) -> None:
    """Draw the same filtered by the energy's kernel, and the last by the narrower filter of Eq. (14).

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    found : mapping
        Spectra of one method, as ``figure_07.evolution`` returns them.
    colours : sequence of str
        One for each count of evaluations.
    """
    for power, colour in zip(found["kernel"], colours, strict=True):
        ax.plot(found["nu"], power, color=colour, linewidth=0.7)
    narrow = found["variance"][-1]
    ax.plot(found["nu"], narrow, color=style.COLOURS[1], linewidth=0.6)
    ridge = int(np.argmax(narrow))
    ax.annotate(
        r"$\sigma/\sqrt{2}$", (found["nu"][ridge], narrow[ridge]), xytext=(3, 2), textcoords="offset points",
        size=6.5, color=style.COLOURS[1],
    )  # fmt: skip
    radial_axes.loglog(ax, float(found["power"].min()) / 4, _span(found))


def progress(
    ax: Axes,
    found: Mapping[str, Mapping[str, FloatArray]],
    counts: Mapping[str, Sequence[int]],
    colours: Sequence[str],
    what: str,
) -> None:
    """Draw a line for each method, with a dot in the colour of its spectrum at each count of evaluations.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    found : mapping
        Method -> its spectra, as ``figure_07.evolution`` returns them.
    counts : mapping
        Method -> evaluations after which spectra were taken.
    colours : sequence of str
        One for each count.
    what : {"excess", "floor"}
        Quantity to draw: the energy above a uniform density's, or the noise floor.
    """
    for method, look in LOOKS.items():
        at, values = np.array(counts[method]), found[method][what]
        if what == "excess":
            ax.plot(np.arange(1, len(values) + 1), values, color=style.INK, linewidth=0.8,
                    linestyle=look["linestyle"])  # fmt: skip
            values = values[at - 1]
        else:
            ax.plot(at, values, color=style.INK, linewidth=0.8, linestyle=look["linestyle"])
        ax.scatter(at, values, c=colours, s=11, marker=look["marker"], linewidths=0, zorder=3)
        ax.plot([], [], color=style.INK, linewidth=0.8, linestyle=look["linestyle"], marker=look["marker"],
                markersize=3, label=METHODS[method])  # fmt: skip
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.xaxis.set_major_locator(LogLocator(numticks=6))
    ax.yaxis.set_major_locator(LogLocator(numticks=6))
    for axis in (ax.xaxis, ax.yaxis):
        axis.set_minor_locator(NullLocator())
    ax.set_xlabel("evaluations of the energy")
    if what == "excess":
        ax.legend(fontsize=6.3, loc="upper right", handlelength=2.4, borderaxespad=0.1)


def _span(found: Mapping[str, FloatArray]) -> tuple[float, float]:
    return float(found["nu"][0]) * 0.93, float(found["nu"][-1]) * 1.04
