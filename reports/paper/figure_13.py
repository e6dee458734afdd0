"""Figure 13: blue noise in one dimension."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import SubFigure
from matplotlib.patches import Circle
from matplotlib.ticker import LogLocator, NullLocator

from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.core.number_text import number
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.generator import GaussianBlueNoise
from gbnbench.generators.monitor import Monitor
from gbnbench.generators.protocol import realization_rng
from gbnbench.reports import style
from gbnbench.reports.paper import panels, radial_axes
from gbnbench.reports.paper.data import DataRequest, TableRequest
from gbnbench.reports.paper.figure import PAGE, Drawing, FigureOptions, PaperFigure
from gbnbench.reports.paper.method_styles import stroke

EDGE = 0.3  # nu up to which the energy is summed
N, NU = 64, 2.0


def line_sets(gradients: int, n: int, seed: int, first: int, sets: int) -> dict[str, FloatArray]:
    """Draw sets on the line in one call, which is ten times faster than one by one, with their mean power.

    Parameters
    ----------
    gradients : int
        Gradients of Nesterov's method.
    n : int
        Number of points.
    seed : int
        Seed of all realizations.
    first : int
        Number of the first realization.
    sets : int
        Number of realizations.

    Returns
    -------
    dict
        ``points``, (sets, n), and the arrays (shells,) ``nu`` and ``power``.
    """
    rngs = [realization_rng(seed, first + k) for k in range(sets)]
    points = GaussianBlueNoise(edge=EDGE, gradients=gradients).draw(n, 1, rngs, Monitor())
    found = shells(points)
    return {"points": points[:, :, 0], "nu": found.nu, "power": found.power}


def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
    """Ask for sets of the truncated energy in 1D."""
    block, blocks = options.pick((4, 1), (64, 6), (64, 16))
    calls = {f"{k:03d}": (_gradients(options), N, options.seed, k * block, block) for k in range(blocks)}
    return {"line": TableRequest(line_sets, calls)}


def _gradients(options: FigureOptions) -> int:
    count: int = options.pick(300, 1500, 1500)
    return count


def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:
    """Draw two sets as beads on circles, and their mean periodogram in linear and in log scale.

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
    pieces: Mapping[str, Mapping[str, FloatArray]] = data["line"]
    blocks = [pieces[key] for key in sorted(pieces)]
    nu, power = blocks[0]["nu"], np.mean([block["power"] for block in blocks], axis=0)

    def paint(panel: SubFigure) -> None:
        grid = panel.subplots(1, 4, width_ratios=(1, 1, 1.32, 1.32))
        for ax, points, letter in zip(grid, blocks[0]["points"], "ab", strict=False):
            _beads(ax, points)
            panels.heading(ax, letter, "a set")
        for ax, letter, title in zip(grid[2:], "cd", ("mean power", "logarithmic"), strict=True):
            _power(ax, nu, power)
            panels.heading(ax, letter, title)
        grid[3].set_yscale("log")
        grid[3].set_ylim(float(power.min()) / 30, 100)
        grid[3].yaxis.set_major_locator(LogLocator(numticks=5))
        grid[3].yaxis.set_minor_locator(NullLocator())
        grid[2].set_ylim(0, None)

    sets = sum(len(block["points"]) for block in blocks)
    inside, outside = nu <= EDGE, (nu > EDGE) & (nu < 0.95)
    top = int(np.argmax(power))
    caption = (
        f"One-dimensional blue noise: n = {N} points on a torus of one dimension by the energy truncated at "
        f"nu = {EDGE:g} (supplement B), gbn[edge={EDGE:g},gradients={_gradients(options)}]. (a, b) Two sets, "
        "as beads on a string around a circle: the power at |f| = 1 is the squared length of the sum of the "
        "unit vectors to the beads, over n; for |f| = 2 the string goes round twice. (c, d) Power at every "
        f"frequency, mean of {sets} sets; grey line: white noise, dotted: the edge. Below the edge at most "
        f"{number(float(power[inside].max()))} is left, which is rounding; between it and nu = 0.95 the "
        f"mean is {number(float(power[outside].mean()))}; the peak is {number(float(power[top]))} at nu = "
        f"{nu[top]:.2f}, beside a ridge that ends at 1 - {EDGE:g}. Without the truncation the points end as "
        "a regular grid. The paper says that its band is very narrow, but neither its width nor its n."
    )
    return Drawing(PAGE, 1.85, paint, caption)


def _beads(ax: Axes, x: FloatArray) -> None:
    """Draw points on the line as beads on a circle, 0 at the right, counter-clockwise."""
    ax.add_patch(Circle((0, 0), 1, fill=False, edgecolor=style.RULE, linewidth=0.9))
    ax.plot(np.cos(2 * np.pi * x), np.sin(2 * np.pi * x), "o", color=style.INK, markersize=2.3,
            markeredgewidth=0)  # fmt: skip
    ax.set_xlim(-1.06, 1.06)
    ax.set_ylim(-1.06, 1.06)
    ax.set_aspect("equal")
    ax.set_axis_off()


def _power(ax: Axes, nu: FloatArray, power: FloatArray) -> None:
    radial_axes.white(ax)
    ax.axvline(EDGE, **radial_axes.DOTTED)
    ax.plot(nu, power, color=stroke("gbn").colour, linewidth=0.9)
    ax.set_xlim(0, NU)
    ax.set_xticks([0, 0.5, 1, 1.5, 2])
    ax.set_xlabel(r"$\nu = |f|/n$")


FIGURE = PaperFigure(
    "13",
    "One dimension",
    "Blue noise on a one-dimensional torus, which the paper believes to be the first: two sets, and their "
    "average periodogram. The whole energy would end in the regular grid; truncating it to a very narrow "
    "band of frequencies does not.",
    needs,
    draw,
)
