"""Axes of figures that show a family of spectra: log-log axes, ordered colours and the ideal profile."""

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
    """Return colours of an ordered family from dark to light, all dark enough for a white page."""
    return [to_hex(c) for c in mpl.colormaps["viridis"](np.linspace(0.0, 0.9, max(count, 1)))]


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
    shared.white(ax)
    shared.log_nu(ax, *nu)
    shared.log_power(ax, low, high)
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
