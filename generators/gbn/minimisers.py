"""The minimiser of an energy from given starts, the paper's descent or Nesterov's, and its first step."""

from __future__ import annotations

import math

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.gbn.energy_settings import EnergySettings
from gbnbench.generators.gbn.kernel import energy_error, uniform_energy
from gbnbench.generators.gbn.operation_counts import theta_at_0
from gbnbench.generators.gbn.optimiser import PRECONDITION_ABOVE, Descent, Nesterov
from gbnbench.generators.gbn.pair_kernels import SINGULAR
from gbnbench.generators.gbn.step_sizes import authors_step


def first_step(asked: str, settings: EnergySettings, n: int, d: int) -> float:
    """Return the first step that the setting ``step`` of ``GaussianBlueNoise`` stands for.

    Parameters
    ----------
    asked : str
        "auto", "authors" or a number of squared spacings.
    settings : EnergySettings
        The energy.
    n, d : int
        Points and dimension.

    Returns
    -------
    float
        In squared spacings.

    Raises
    ------
    InputError
        If it is none of these, or the number is not above 0.
    """
    if asked == "auto":
        return settings.first_step(n, d)
    if asked == "authors":
        return authors_step(n, d)
    try:
        step = float(asked)
    except ValueError:
        step = math.nan
    if not (math.isfinite(step) and step > 0):
        raise InputError(f"step must be auto, authors or a number above 0; got {asked!r}")
    return step


def open_minimiser(
    settings: EnergySettings, starts: FloatArray, step: float, excess: float, descent: bool
) -> Descent:
    """Open the energy of settings, and what brings it down from starts.

    Parameters
    ----------
    settings : EnergySettings
        The energy.
    starts : (sets, n, d) float64
        Points, box sides.
    step : float
        The first, in squared spacings.
    excess : float
        A set is finished at this excess energy a point; 0 is never.
    descent : bool
        The paper's fixed steps, instead of Nesterov's method.

    Returns
    -------
    Descent

    Raises
    ------
    DeviceError
        If there is no device that the energy needs.
    """
    _, n, d = starts.shape
    energy, sigma = settings.open(n, d), settings.sigma
    # The transform of a kernel cut off in space is negative in places, and singular kernels leave out what
    # each point has with itself: such energies fall below 0, which is no end.
    enough = -math.inf if (settings.cutoff or settings.kernel in SINGULAR) and not excess else excess
    optimiser: Descent
    if descent:
        optimiser = Descent(energy, starts, step, enough)
    else:
        # The lowest band's preconditioner knows the torus's whole energy alone: in the box, and in one
        # dimension below an edge, it diverges.
        gaussian = settings.kernel == "gaussian"
        noise = energy_error(d, sigma, settings.chosen_precision) if gaussian else 0.0
        band = settings.curvature(d) if settings.plain else None
        wide = PRECONDITION_ABOVE if gaussian else 0.0
        optimiser = Nesterov(energy, starts, step, enough, noise=noise, curvature=band, wide=wide)
    if settings.plain and settings.kernel == "gaussian":
        alone = theta_at_0(n, d, sigma) ** d  # each point with its own images
        optimiser.constant = (uniform_energy(d, sigma) - alone) / 2
    return optimiser
