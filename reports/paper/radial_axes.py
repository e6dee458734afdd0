"""Axes of radial power: log scales, curves, the colours of a family of spectra, the ideal profile."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator
from numpy.typing import ArrayLike

from gbnbench.core.results.radial import RadialPower
from gbnbench.core.torus import FloatArray
from gbnbench.reports import style

MARKS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0)  # of nu in log scale
NU = r"$\nu=|f|\,n^{-1/2}$"
DOTTED: dict[str, Any] = {"color": style.FAINT, "linestyle": (0, (1, 1.6)), "linewidth": 0.9, "zorder": 1.5}


def family(count: int) -> list[str]:
    """Return colours of an ordered family from dark to light, all dark enough for a white page."""
    return [to_hex(c) for c in mpl.colormaps["viridis"](np.linspace(0.0, 0.9, max(count, 1)))]


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


def loglog(ax: Axes, low: float, nu: tuple[float, float], high: float = 30.0) -> None:
    """Make log-log axes of radial power against nu, with the line of white noise.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    low : float
        Lower end of the power axis.
    nu : (float, float)
        Range of the nu axis.
    high : float
        Upper end of the power axis.
    """
    white(ax)
    log_nu(ax, *nu)
    log_power(ax, low, high)
    ax.set_xlabel(r"$\nu=|f|\,n^{-1/d}$")


def profile(ax: Axes, epsilon: float, c: float, nu: ArrayLike) -> None:
    """Draw the profile epsilon exp(c nu^2) as a dotted curve, up to where it reaches 1.

    Parameters
    ----------
    ax : Axes
        Axes to draw in.
    epsilon : float
        Power at nu = 0.
    c : float
        Steepness, 4 pi^2 sigma^2 for Gaussian Blue Noise.
    nu : array_like
        Values of nu whose range the curve covers.
    """
    low, high = float(np.min(nu)), float(np.max(nu))
    end = min(high, math.sqrt(max(-math.log(epsilon), 0.0) / c))
    grid: FloatArray = np.geomspace(low, max(end, low), 200)
    ax.plot(grid, epsilon * np.exp(c * grid**2), **DOTTED)
