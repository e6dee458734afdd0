"""The energy of Gaussian Blue Noise, evaluated as the plan says (Ahmed, Ren & Wonka 2022, Eq. 15-23).

E = sum over pairs of prod over dimensions of theta, theta being exp(-u^2 / 2 sigma^2) summed over all
periods, and u = x n^(1/d) counted in spacings.
"""

from __future__ import annotations

from gbnbench.generators.gbn.harmonics import Harmonics
from gbnbench.generators.gbn.images import Images
from gbnbench.generators.gbn.plan import plan_energy
from gbnbench.generators.gbn.protocol import EnergyEvaluation
from gbnbench.generators.gbn.strips import Strips
from gbnbench.generators.gbn.theta import Theta
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
    if found.method == "strips":
        return Strips(chosen, n, d, sigma, name, cutoff)
    if found.method == "harmonics":
        return Harmonics(chosen, n, d, sigma, name, edge)
    return (Images if found.method == "images" else Theta)(chosen, n, d, sigma, name)
