"""Axes that figures of spectra share: log-log radial power, colours of a family, the ideal profile."""

from __future__ import annotations

import math
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.lines import Line2D
from matplotlib.ticker import FixedLocator, FuncFormatter, LogLocator, NullLocator
from numpy.typing import ArrayLike

from gbnbench.reports import style
from gbnbench.torus import FloatArray

NU_TICKS = (0.03, 0.1, 0.3, 1.0)
DOTTED: dict[str, Any] = {"color": style.FAINT, "linestyle": (0, (1, 1.6)), "linewidth": 0.9, "zorder": 1.5}


def family(count: int) -> list[str]:
    """Colours of an ordered family from dark to light, none too light for a white page."""
    return [mpl.colors.to_hex(c) for c in mpl.colormaps["viridis"](np.linspace(0.0, 0.9, max(count, 1)))]


def loglog(ax: Axes, low: float, high: float = 30.0, nu: tuple[float, float] = (0.03, 2.05)) -> None:
    """Set log-log axes of radial power, with the line of white noise at 1 and ticks a few decades apart."""
    ax.axhline(1, color=style.RULE, linewidth=0.9, zorder=0)
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_ylim(low, high)
    ax.set_xlim(*nu)
    ax.xaxis.set_major_locator(FixedLocator([tick for tick in NU_TICKS if nu[0] <= tick <= nu[1]]))
    ax.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    ax.xaxis.set_minor_locator(LogLocator(subs=range(2, 10)))
    ax.xaxis.set_minor_formatter(FuncFormatter(lambda *_: ""))
    ax.yaxis.set_major_locator(LogLocator(numticks=7))
    ax.yaxis.set_minor_locator(NullLocator())
    ax.set_xlabel(r"$\nu = |f|\,n^{-1/d}$")


def profile(ax: Axes, epsilon: float, c: float, nu: ArrayLike) -> Line2D:
    """Dot epsilon exp(c nu^2) up to where it reaches 1, over the range of nu."""
    low, high = float(np.min(nu)), float(np.max(nu))
    end = min(high, math.sqrt(max(-math.log(epsilon), 0.0) / c))
    grid: FloatArray = np.geomspace(low, max(end, low), 200)
    (line,) = ax.plot(grid, epsilon * np.exp(c * grid**2), **DOTTED)
    return line
