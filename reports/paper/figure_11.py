"""Figure 11: how an adaptive set converges from random points, at doubled numbers of gradients."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import SubFigure

from gbnbench.analysis.reconstruction.difference_spectrum import annular_power, difference_power
from gbnbench.core.number_text import number
from gbnbench.core.torus import FloatArray
from gbnbench.generators.adaptive.density import Density, as_density
from gbnbench.generators.adaptive.gbn.descent import descend
from gbnbench.generators.adaptive.gbn.energy import AdaptiveEnergy
from gbnbench.generators.adaptive.registry import adaptive_generator, adaptive_points
from gbnbench.opencl import runtime
from gbnbench.reports import layout, style
from gbnbench.reports.paper import panels, radial_axes
from gbnbench.reports.paper.data import DataRequest, TableRequest
from gbnbench.reports.paper.figure import PAGE, Drawing, FigureOptions, PaperFigure
from gbnbench.reports.paper.stippling_requests import TITLES, methods_shown, title_of

SIDE = 128  # pixels
HILL = 1.0  # the density is exp(HILL (cos 2 pi x + cos 2 pi y)), a hill on the torus
PAPER = ("bnot",)


def hill() -> Density:
    """Make the density: a smooth hill on the torus, 55 times as dense in the middle as in the corners."""
    line = np.exp(-HILL * np.cos(2 * np.pi * (np.arange(SIDE) + 0.5) / SIDE))
    return as_density(np.outer(line, line), toroidal=True)


def adaptive_evolution(n: int, seed: int, counts: Sequence[int], sets: int) -> dict[str, FloatArray]:
    """Follow sets of adaptive Gaussian blue noise from independent points.

    Parameters
    ----------
    n : int
        Points.
    seed : int
        Of all sets.
    counts : sequence of int
        Gradients after which sets are kept, ascending; 0 is the start.
    sets : int
        Realizations 0, 1, ... of the seed.

    Returns
    -------
    dict
        points, (counts, n, 2), and paths, (gradients + 1, n, 2), of the first set, in pixels; nu and power,
        (annuli,) and (counts, annuli), of the sets less the density, mean over sets.
    """
    density = hill()
    energy = AdaptiveEnergy(runtime(), density, n, sigma=1.0, smoothing=1.0, spread=1.0, precision="double")
    paths: list[FloatArray] = []
    found = []
    for k in range(sets):
        path = _path(energy, adaptive_points("rejection", density, n, seed=seed, realization=k), max(counts))
        found.append([_spectrum(path[count], density) for count in counts])
        paths = paths or path
    return {
        "points": np.stack([paths[count] for count in counts]),
        "paths": np.stack(paths),
        "nu": found[0][0][0],
        "power": np.mean([[power for _, power in one] for one in found], axis=0),
    }


def _path(energy: AdaptiveEnergy, start: FloatArray, gradients: int) -> list[FloatArray]:
    """Return the start and the set after each gradient."""
    path = [start]
    descend(energy, start, gradients, lambda _, __, x: path.append(x.copy()))
    return path


def adaptive_rival(name: str, n: int, seed: int, sets: int) -> dict[str, FloatArray]:
    """Draw sets of another method for the same density.

    Parameters
    ----------
    name : str
        An adaptive generator.
    n, seed, sets : int
        Points, seed, realizations.

    Returns
    -------
    dict
        points, (1, n, 2), of the first set; nu and power, (annuli,) and (1, annuli), mean over sets.
    """
    density = hill()
    drawn = [adaptive_points(name, density, n, seed=seed, realization=k) for k in range(sets)]
    found = [_spectrum(x, density) for x in drawn]
    return {
        "points": drawn[0][None],
        "nu": found[0][0],
        "power": np.mean([p for _, p in found], axis=0)[None],
    }


def _spectrum(x: FloatArray, density: Density) -> tuple[FloatArray, FloatArray]:
    n = len(x)
    radial = annular_power(*difference_power(x, density.of_points(n)), 1 / math.sqrt(n))
    return radial.nu, radial.power


def _counts(options: FigureOptions) -> list[int]:
    return [0, *(2**k for k in range(options.pick(6, 9, 11)))]


def _sizes(options: FigureOptions) -> tuple[int, int]:
    """Return the number of points and of sets."""
    sizes: tuple[int, int] = options.pick((100, 1), (512, 3), (512, 16))
    return sizes


def _rival() -> str | None:
    """Choose a method, one of the paper's if it serves this density."""
    names = [name for name in methods_shown(PAPER) if not adaptive_generator(name).refusal(hill(), 512)]
    return names[0] if names else None


def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
    """Ask for sets at doubled numbers of gradients, and for those of a cellular method."""
    n, sets = _sizes(options)
    requests: dict[str, DataRequest] = {
        "gbn": TableRequest(adaptive_evolution, {"gbn": (n, options.seed, _counts(options), sets)})
    }
    if (rival := _rival()) is not None:
        requests["rival"] = TableRequest(adaptive_rival, {rival: (rival, n, options.seed, sets)})
    return requests


def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:
    """Draw points after each number of gradients, a cellular method's, the paths, and the spectra.

    Parameters
    ----------
    data : mapping
        Data under the names that ``needs`` gives them.
    options : FigureOptions
        Scale and seed.

    Returns
    -------
    Drawing
        The figure, as wide as the page, with its caption.
    """
    counts, found = _counts(options), data["gbn"]["gbn"]
    rivals = data.get("rival", {})
    names = [title_of(str(name)) for name in rivals]
    shown = len(counts) + len(rivals) + 1
    columns = 6
    rows = -(-shown // columns)
    wide = PAGE / columns
    colours = radial_axes.family(len(counts))[::-1]

    def paint(panel: SubFigure) -> None:
        above, below = panel.subfigures(2, 1, squeeze=False, height_ratios=[rows * (wide + 0.2), 2.3])[:, 0]
        axes = iter(above.subplots(rows, columns, squeeze=False).ravel())
        for count, points in zip(counts, found["points"], strict=True):
            _points(ax := next(axes), points, wide)
            ax.set_title(f"{count:,}", size=7.5, pad=2.5)
        for name, one in zip(names, rivals.values(), strict=True):
            _points(ax := next(axes), one["points"][0], wide)
            ax.set_title(name, size=7.5, pad=2.5)
        _paths(ax := next(axes), found["paths"])
        ax.set_title("paths", size=7.5, pad=2.5)
        for ax in axes:
            ax.set_axis_off()
        spectra = below.subplots()
        for count, power, colour in zip(counts, found["power"], colours, strict=True):
            spectra.plot(found["nu"], power, color=colour, linewidth=0.8, label=f"{count:,}")
        for name, one in zip(names, rivals.values(), strict=True):
            spectra.plot(
                one["nu"], one["power"][0], color=style.COLOURS[1], linewidth=0.9, linestyle="--", label=name
            )
        low = float(found["power"].min())
        radial_axes.loglog(spectra, low / 4, (float(found["nu"][0]) * 0.95, float(found["nu"][-1])))
        spectra.set_ylabel("power")
        spectra.legend(fontsize=6, loc="upper left", bbox_to_anchor=(1.01, 1.0), title="gradients",
                       title_fontsize=6.5)  # fmt: skip
        panels.heading(spectra, "b", "power of the points less the density")

    n, power = found["points"].shape[1], found["power"]
    rival = f", {names[0]} beside" if names else ""
    missing = [TITLES[name] for name in PAPER if name not in rivals]
    caption = (
        f"Convergence of adaptive GBN from independent points: (a) {n} points after doubled numbers of "
        "gradients of Nesterov's method, k of which do the work of about k^2/9 steps of descent"
        f"{rival}, and the paths of the points. (b) Power of the points less the density in annuli against "
        f"nu of the mean spacing, mean over sets ({_sizes(options)[1]}); in the lowest annulus it falls from "
        f"{number(float(power[0, 0]))} to {number(float(power[-1, 0]))}. The density is exp(cos 2 pi x + "
        "cos 2 pi y) on the torus, from the middle; sigma = c = t = 1, the settings that are faithful to it."
        + (f" {missing[0]} has no generator here that serves it." if missing else "")
    )
    return Drawing(PAGE, rows * (wide + 0.2) + 2.3, paint, caption)


def _points(ax: Axes, points: FloatArray, inches: float) -> None:
    size = min(3.0, 0.3 * 72 * inches / math.sqrt(len(points)))
    ax.plot(points[:, 1], points[:, 0], "o", markersize=size, markeredgewidth=0, color=style.INK)
    ax.set(xlim=(0, SIDE), ylim=(SIDE, 0), aspect="equal")
    layout.frame(ax)


def _paths(ax: Axes, paths: FloatArray) -> None:
    """Draw where the points went; a step across the torus's border is not drawn."""
    jumps = np.abs(np.diff(paths, axis=0)).max(axis=2) > SIDE / 2
    drawn = paths.copy()
    drawn[1:][jumps] = np.nan
    ax.plot(drawn[:, :, 1], drawn[:, :, 0], color=style.COLOURS[0], linewidth=0.35)
    ax.set(xlim=(0, SIDE), ylim=(SIDE, 0), aspect="equal")
    layout.frame(ax)


FIGURE = PaperFigure(
    "11",
    "Convergence of adaptive sampling",
    "Point distributions at doubled iterations from a weighted random start, BNOT for comparison: "
    "convergence behaves as in the uniform case of figure 7, starting in the middle frequencies, and the "
    "favourable spectrum is there from about 512 iterations, which take the time of BNOT. The last plot "
    "traces the paths of the points.",
    needs,
    draw,
)
