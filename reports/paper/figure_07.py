"""Figure 7: how radial power evolves while the points move, raw and filtered by the kernel."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import SubFigure

from gbnbench.analysis.radial.profile_measures import exponential_fit, noise_floor
from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.core.errors import RefusalError
from gbnbench.core.number_text import number
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.generator import GaussianBlueNoise
from gbnbench.generators.monitor import Monitor, Trace
from gbnbench.generators.protocol import realization_rng
from gbnbench.reports.paper import panels, radial_axes
from gbnbench.reports.paper.data import DataRequest, TableRequest
from gbnbench.reports.paper.evolution_panels import METHODS, filtered_spectra, progress, raw_spectra
from gbnbench.reports.paper.figure import PAGE, Drawing, FigureOptions, PaperFigure

COUNTS = (1, 3, 10, 30, 100, 300, 1000, 3000, 10_000, 30_000, 100_000)
KERNEL, VARIANCE = 1.0, math.sqrt(0.5)  # filters, in spacings: the energy's kernel, and Eq. 14's
UNITS = {"descent": "steps", "nesterov": "gradients"}


def gradients(steps: int) -> int:
    """Return how many gradients of Nesterov's method do the work of these steps of descent."""
    return max(1, round(3 * math.sqrt(steps)))


def evolution(
    method: str, counts: Sequence[int], n: int, seed: int, first: int, sets: int
) -> dict[str, FloatArray]:
    """Compute mean spectra in 2D after several numbers of evaluations of the energy, and their depth.

    Parameters
    ----------
    method : {"descent", "nesterov"}
        The paper's gradient descent, or Nesterov's method.
    counts : sequence of int
        Evaluations after which spectra are taken.
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
        nu of the shells; power, and the same filtered by the kernel and by Eq. 14's width, (counts,
        shells); floor and c of the mean spectra, (counts,); excess, (evaluations,), mean energy a point
        above that of a uniform density.
    """
    trace, most = Trace(keep_at=counts), max(counts)
    descent = GaussianBlueNoise(iterations=most)
    generator = descent if method == "descent" else GaussianBlueNoise(gradients=most)
    generator.draw(n, 2, [realization_rng(seed, first + k) for k in range(sets)], Monitor(trace=trace))
    found = [shells(trace.points(count)).radial() for count in counts]
    return {
        "nu": found[0].nu,
        "power": np.stack([radial.power for radial in found]),
        "kernel": np.stack([radial.filtered(KERNEL).power for radial in found]),
        "variance": np.stack([radial.filtered(VARIANCE).power for radial in found]),
        "floor": np.array([noise_floor(radial) for radial in found]),
        "c": np.array([_steepness(radial) for radial in found]),
        "excess": trace.to_frame().groupby("gradient").excess.mean().to_numpy(),
    }


def _steepness(radial: RadialPower) -> float:
    try:
        return exponential_fit(radial).slope
    except RefusalError:
        return math.nan


def needs(options: FigureOptions) -> Mapping[str, DataRequest]:
    """Ask for both methods from the same starts, at counts that do the same work."""
    n, block, blocks = _sizes(options)
    calls = {
        f"{method}_{k:03d}": (method, counts, n, options.seed, k * block, block)
        for method, counts in _counts(options).items() for k in range(blocks)
    }  # fmt: skip
    return {"evolution": TableRequest(evolution, calls)}


def draw(data: Mapping[str, Any], options: FigureOptions) -> Drawing:
    """Draw raw and filtered spectra of descent above those of Nesterov's method, and their progress beside.

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
    counts = _counts(options)
    found = {method: _mean(data["evolution"], method) for method in METHODS}
    colours = radial_axes.family(len(counts["descent"]))[::-1]

    def paint(panel: SubFigure) -> None:
        grid = panel.subplots(2, 3, width_ratios=(1, 1, 0.9))
        for row, (method, letters) in enumerate(zip(METHODS, ("ab", "cd"), strict=True)):
            raw, filtered, _ = grid[row]
            raw_spectra(raw, found[method], counts[method], UNITS[method], colours)
            filtered_spectra(filtered, found[method], colours)
            panels.heading(raw, letters[0], METHODS[method])
            panels.heading(filtered, letters[1], "the same, filtered")
        progress(grid[0, 2], found, counts, colours, "excess")
        progress(grid[1, 2], found, counts, colours, "floor")
        panels.heading(grid[0, 2], "e", "excess energy a point")
        panels.heading(grid[1, 2], "f", "noise floor")

    return Drawing(PAGE, 4.0, paint, _caption(found, counts, options))


def _sizes(options: FigureOptions) -> tuple[int, int, int]:
    """Return the number of points, of sets in a block, and of blocks."""
    sizes: tuple[int, int, int] = options.pick((64, 2, 1), (1024, 3, 2), (1024, 4, 8))
    return sizes


def _counts(options: FigureOptions) -> dict[str, list[int]]:
    most = options.pick(300, 10_000, 100_000)
    steps = [count for count in COUNTS if count <= most]
    return {"descent": steps, "nesterov": [gradients(count) for count in steps]}


def _mean(pieces: Mapping[str, Mapping[str, FloatArray]], method: str) -> dict[str, FloatArray]:
    """Mean over blocks of equally many sets."""
    blocks = [piece for key, piece in pieces.items() if key.startswith(method)]
    return {what: np.mean([block[what] for block in blocks], axis=0) for what in blocks[0]}


def _caption(
    found: Mapping[str, Mapping[str, FloatArray]], counts: Mapping[str, Sequence[int]], options: FigureOptions
) -> str:
    n, block, blocks = _sizes(options)
    descent, ours = found["descent"], found["nesterov"]
    row = counts["descent"].index(30)
    nu, power = descent["nu"], descent["power"][row]
    deepest = int(np.argmin(power))
    ridge = int(np.argmax(descent["variance"][-1]))
    at, same = counts["descent"], counts["nesterov"]
    first = (
        f"Energy is dug out of the middle first (after {at[row]} steps power is least, "
        f"{number(float(power[deepest]))}, at nu = {nu[deepest]:.2f}, beside {number(float(power[0]))} at "
        f"|f| = 1; the kernel's transform is {1 / (2 * math.pi):.2f} wide), then from both sides. "
        if deepest > 0
        else ""
    )
    fitted = [float(one["c"][-1]) / (4 * math.pi**2) for one in (descent, ours)]
    return (
        f"Radial power over exact shells while the energy is lowered, mean of {block * blocks} sets, n = "
        f"{n}, d = 2, sigma = 1, from random points; grey line: white noise. (a, b) The paper's descent; "
        "(c, d) Nesterov's method with restart from the same points, at three times the square root of as "
        "many gradients, in the same colours. (b, d) Times exp(-4 pi^2 nu^2), the square of the transform "
        f"of the energy's kernel. {first}The last spectra "
        f"have a fitted c of {fitted[0]:.2f} and {fitted[1]:.2f} times 4 pi^2: filtered by the "
        "kernel they are flat. By Eq. 14 the filter whose variance falls is narrower in space, sigma / "
        "sqrt 2 (orange: the last spectrum so filtered), and leaves a ridge of "
        f"{number(float(descent['variance'][-1][ridge]))} at nu = {nu[ridge]:.2f}: what stays is inverse to "
        "the square of the energy's weight, not to the weight. (e) Energy above a uniform density's. (f) "
        f"Mean power up to nu = 0.25: {number(float(descent['floor'][-1]))} after {at[-1]:,} steps and "
        f"{number(float(ours['floor'][-1]))} after {same[-1]:,} gradients."
    )


FIGURE = PaperFigure(
    "7",
    "Evolution of radial power",
    "Radial power at several iteration counts of the paper's descent, (a) of the points and (b) of the "
    "points filtered by the Gaussian. Energy is excavated first somewhere in the middle, then towards both "
    "ends; the profile has its shape around 500 iterations, where progress slows, and the filtered "
    "spectrum becomes nearly flat.",
    needs,
    draw,
)
