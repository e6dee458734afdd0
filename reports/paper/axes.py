"""Axes that figures of whole families of spectra share: log-log, ordered colours, the ideal profile."""

from __future__ import annotations

import math
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import to_hex
from numpy.typing import ArrayLike

from gbnbench.core.torus import FloatArray
from gbnbench.reports import style
from gbnbench.reports.paper import shared

DOTTED: dict[str, Any] = {"color": style.FAINT, "linestyle": (0, (1, 1.6)), "linewidth": 0.9, "zorder": 1.5}


def family(count: int) -> list[str]:
    """Colours of an ordered family from dark to light, none too light for a white page."""
    return [to_hex(c) for c in mpl.colormaps["viridis"](np.linspace(0.0, 0.9, max(count, 1)))]


def loglog(ax: Axes, low: float, nu: tuple[float, float], high: float = 30.0) -> None:
    """Make log-log axes of radial power against nu, with white noise's line."""
    shared.white(ax)
    shared.log_nu(ax, *nu)
    shared.log_power(ax, low, high)
    ax.set_xlabel(r"$\nu=|f|\,n^{-1/d}$")


def profile(ax: Axes, epsilon: float, c: float, nu: ArrayLike) -> None:
    """Dot epsilon exp(c nu^2) over the range of nu, up to where it reaches 1."""
    low, high = float(np.min(nu)), float(np.max(nu))
    end = min(high, math.sqrt(max(-math.log(epsilon), 0.0) / c))
    grid: FloatArray = np.geomspace(low, max(end, low), 200)
    ax.plot(grid, epsilon * np.exp(c * grid**2), **DOTTED)
