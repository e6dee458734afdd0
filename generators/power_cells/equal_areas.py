"""Weights that give power cells equal areas, by damped Newton steps (Kitagawa, Mérigot & Thibert 2019)."""

from __future__ import annotations

import numpy as np

from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.power_cells.diagram import PowerDiagram, power_diagram

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
    least = 0.5 * min(diagram.mass.min(), 1 / n)
    for _ in range(STEPS):
        lack = 1 / n - diagram.mass
        if n * np.abs(lack).max() <= tolerance:
            return weight, diagram
        step, norm, share = _newton_step(diagram, lack), np.linalg.norm(lack), 1.0
        for _ in range(HALVINGS):
            trial = power_diagram(x, weight + share * step, diagram.reach)
            if trial.mass.min() >= least and np.linalg.norm(1 / n - trial.mass) <= (1 - share / 2) * norm:
                break
            share /= 2
        else:
            break
        weight, diagram = weight + share * step, trial
    raise RefusalError(
        f"cells of equal area were not found for n={n} points: the areas still differ from 1/n by "
        f"{n * np.abs(1 / n - diagram.mass).max():.1e} of it; raise the tolerance"
    )


def _newton_step(diagram: PowerDiagram, lack: FloatArray) -> FloatArray:
    """Change of the weights that makes up for what the cells lack in area, to first order."""
    from scipy.sparse.linalg import splu

    step = np.zeros(len(lack))
    held = diagram.laplacian()[1:, 1:]
    step[1:] = splu(held, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True}).solve(lack[1:])
    return np.asarray(step - step.mean())
