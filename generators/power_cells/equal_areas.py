"""Weights that give power cells equal areas, by damped Newton steps (Kitagawa, Mérigot & Thibert 2019)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.power_cells.diagram import PowerDiagram, power_diagram
from gbnbench.generators.power_cells.measured_cells import MeasuredCells

Cells = TypeVar("Cells", bound=MeasuredCells)

STEPS = 100  # Newton's; a dozen are enough from uniform points
HALVINGS = 40  # of one step, before it is given up


def equal_areas(
    x: FloatArray, weight: FloatArray, tolerance: float, diagram: PowerDiagram | None = None
) -> tuple[FloatArray, PowerDiagram]:
    """Find the weights for which every power cell has the area 1/n.

    Parameters
    ----------
    x : (n, 2) float64
        Distinct points in [0, 1)^2.
    weight : (n,) float64
        Weights to start from, in units of squared length; where they hide a point, zero weights instead.
    tolerance : float
        Largest |n area - 1| of a cell that is good enough, > 0.
    diagram : PowerDiagram, optional
        The cells of x by that weight, where they are known.

    Returns
    -------
    weight : (n,) float64
        The weights; their mean is that of the start.
    diagram : PowerDiagram
        Its cells.

    Raises
    ------
    RefusalError
        If the steps come to a halt above the tolerance.

    Notes
    -----
    The areas are the gradient of a concave function of the weights, the dual of the optimal transport from
    the uniform density to the points (Aurenhammer, Hoffmann & Aronov 1998), and the diagram's Laplacian is
    its Hessian. A step solves that sparse system with the first weight held, and is halved until every cell
    has at least half the area of the smallest at the start, or half of 1/n if that is less, and the residual
    has fallen by half of what the step promises; then Newton's method converges from any start without
    hidden points.

    References
    ----------
    Kitagawa, Mérigot & Thibert, "Convergence of a Newton algorithm for semi-discrete optimal transport",
    J. European Mathematical Society 21(9), 2019. de Goes, Breeden, Ostromoukhov & Desbrun, "Blue noise
    through optimal transport", ACM Trans. Graphics 31(6), 2012, Section 4.
    """
    n = len(x)
    diagram = power_diagram(x, weight) if diagram is None else diagram
    if diagram.mass.min() < 0.02 / n:
        weight = np.zeros(n)
        diagram = power_diagram(x)
    weight, diagram = equal_masses(
        lambda trial, before: power_diagram(x, trial, before.reach), weight, diagram, tolerance, STEPS
    )
    error = n * np.abs(1 / n - diagram.mass).max()
    if error > tolerance:
        raise RefusalError(
            f"cells of equal area were not found for n={n} points: the areas still differ from 1/n by "
            f"{error:.1e} of it; raise the tolerance"
        )
    return weight, diagram


def equal_masses(
    cells: Callable[[FloatArray, Cells], Cells], weight: FloatArray, now: Cells, tolerance: float, steps: int
) -> tuple[FloatArray, Cells]:
    """Take Newton's steps towards weights for which every cell has the mass 1/n, as ``equal_areas`` says.

    Parameters
    ----------
    cells : callable
        Gives the cells by other weights; takes these, and cells that are near.
    weight : (n,) float64
        The start.
    now : MeasuredCells
        Its cells.
    tolerance : float
        Largest |n mass - 1| of a cell that is good enough, > 0.
    steps : int
        How many, at most.

    Returns
    -------
    weight : (n,) float64
        The weights; their mean is that of the start.
    now : MeasuredCells
        Their cells, equal to the tolerance unless the steps came to a halt or were too few.
    """
    n = len(weight)
    least = 0.5 * min(now.mass.min(), 1 / n)
    for _ in range(steps):
        lack = 1 / n - now.mass
        if n * np.abs(lack).max() <= tolerance or now.mass.min() <= 0:  # a hidden point's mass has no slope
            break
        step, norm, share = _newton_step(now, lack), np.linalg.norm(lack), 1.0
        for _ in range(HALVINGS):
            trial = cells(weight + share * step, now)
            if trial.mass.min() >= least and np.linalg.norm(1 / n - trial.mass) <= (1 - share / 2) * norm:
                break
            share /= 2
        else:
            break
        weight, now = weight + share * step, trial
    return weight, now


def _newton_step(cells: MeasuredCells, lack: FloatArray) -> FloatArray:
    """Change of the weights that makes up for what the cells lack in mass, to first order."""
    from scipy.sparse.linalg import splu

    step = np.zeros(len(lack))
    held = cells.laplacian()[1:, 1:]
    step[1:] = splu(held, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}).solve(lack[1:])
    return np.asarray(step - step.mean())
