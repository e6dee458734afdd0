"""The energy of Gaussian Blue Noise, evaluated as the plan says (Ahmed, Ren & Wonka 2022, Eq. 15-23).

E = sum over pairs of prod over dimensions of theta, theta being exp(-u^2 / 2 sigma^2) summed over all
periods, and u = x n^(1/d) counted in spacings.
"""

from __future__ import annotations

from gbnbench.generators.gbn.methods import METHODS
from gbnbench.generators.gbn.plan import plan_energy
from gbnbench.generators.gbn.protocol import EnergyEvaluation
from gbnbench.opencl import runtime


def default_precision() -> str:
    """Double where the chosen device has it, else float."""
    return "double" if runtime().device.has_double else "float"


def energy_evaluation(
    n: int,
    d: int,
    sigma: float,
    precision: str | None = None,
    *,
    method: str | None = None,
    cutoff: float | None = None,
    edge: float | None = None,
) -> EnergyEvaluation:
    """Open the evaluation that the plan chooses, on the chosen device.

    Parameters
    ----------
    n, d, sigma, method, cutoff, edge
        As for ``plan_energy``.
    precision : {"double", "float"}, optional
        Double where the device has it.

    Returns
    -------
    EnergyEvaluation

    Raises
    ------
    InputError, RefusalError
        As ``plan_energy``.
    DeviceError
        If there is no device, or it has no such precision.
    """
    chosen = runtime()
    name = precision or default_precision()
    found = plan_energy(n, d, sigma, name, method=method, cutoff=cutoff, edge=edge)
    truncation = [value for value in (cutoff, edge) if value is not None]
    return METHODS[found.method].evaluation(chosen, n, d, sigma, name, *truncation)
