"""Minimal energy of pairs under the kernels of the literature (Gräf, Potts & Steidl 2012)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.torus import FloatArray, wrap
from gbnbench.generators.kernel_based.ewald import EwaldEnergy
from gbnbench.generators.kernel_based.mesh_sums import MeshEnergy
from gbnbench.generators.kernel_based.smooth_kernels import smooth_energy
from gbnbench.generators.protocol import Family

SINGULAR = ("distance", "log", "riesz")
MOST = {1: 100_000, 2: 20_000, 3: 20_000}


@dataclass(frozen=True)
class KernelEnergy:
    """Random points moved to a local minimum of the sum over pairs of a kernel on the torus.

    Parameters
    ----------
    kernel : {"distance", "log", "riesz", "gaussian", "multiquadric", "inverse", "vonmises"}
        -r, -log r, r**-power; exp(-r**2 / 2 width**2), -sqrt(r**2 + width**2), 1 / sqrt(r**2 + width**2), the
        von Mises density of that width on each axis.
    width : float
        Of the last four, in spacings, 0.3 to 3.
    power : float
        Of "riesz": 0 < power < d.
    gradients : int
        Most evaluations of the energy and its gradient, >= 1.

    Raises
    ------
    InputError
        If a setting is out of range.

    Notes
    -----
    The energy is (1/2n) sum over f != 0 of w(f) |F(f)|**2, w the kernel's Fourier transform: a squared error
    of integration in its reproducing kernel Hilbert space, which Gräf, Potts & Steidl minimise as attraction
    by a density and repulsion of points, for -r as electrostatic halftoning does for -log r. As there, sums
    are by fast Fourier transforms at non-equispaced points, those of the singular kernels split by Ewald;
    the minimiser is L-BFGS, theirs nonlinear conjugate gradients. "gaussian" is the energy of ``gbn``. Long
    runs crystallise under the singular kernels, whose minimum is a lattice.

    References
    ----------
    Gräf, Potts & Steidl, "Quadrature errors, discrepancies, and their relations to halftoning on the torus
    and the sphere", SIAM J. Scientific Computing 34(5), 2012.

    Examples
    --------
    >>> KernelEnergy(kernel="log", gradients=5)(16, 2, np.random.default_rng(0)).shape
    (16, 2)
    """

    name: ClassVar[str] = "kernelenergy"
    summary: ClassVar[str] = "least energy of pairs under a kernel, d <= 3 (Gräf, Potts & Steidl 2012)"
    family: ClassVar[Family] = "kernel-based"
    dimensions: ClassVar[tuple[int, int | None]] = (1, 3)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Gräf, Potts & Steidl, Quadrature errors, discrepancies, and halftoning, 2012"
    kernel: Literal["distance", "log", "riesz", "gaussian", "multiquadric", "inverse", "vonmises"] = (
        "distance"
    )
    width: float = 1.0
    power: float = 0.5
    gradients: int = 100

    def __post_init__(self) -> None:
        if not 0.3 <= self.width <= 3:
            raise InputError(f"width must be 0.3 to 3 spacings; got {self.width}")
        if not 0 < self.power < 3:
            raise InputError(f"power must be above 0 and below the dimension; got {self.power}")
        if self.gradients < 1:
            raise InputError(f"gradients must be >= 1; got {self.gradients}")

    def refusal(self, n: int, d: int) -> str | None:
        """Say why the energy cannot be had.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        str or None
            The reason.
        """
        if d > 3:
            return f"d must be 1, 2 or 3 for sums over a mesh; got d={d}, nearest is 3"
        if self.kernel == "riesz" and self.power >= d:
            return f"power must be below the dimension for riesz energies; got power={self.power:g} in d={d}"
        if n > MOST[d]:
            return f"n must be at most {MOST[d]} in {d}D, minutes of sums; got n={n}, nearest is {MOST[d]}"
        return None

    def energy(self, n: int, d: int) -> MeshEnergy | EwaldEnergy:
        """Open the energy of n points in d dimensions.

        Parameters
        ----------
        n, d : int
            Points and dimension.

        Returns
        -------
        MeshEnergy or EwaldEnergy
            Called with (n, d) points of [0, 1), it gives the energy and the gradient in spacings.
        """
        if self.kernel not in SINGULAR:
            return smooth_energy(self.kernel, n, d, self.width)
        return EwaldEnergy(n, d, {"distance": 1.0, "log": 0.0, "riesz": -self.power}[self.kernel])

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        """Draw one realization, (n, d) float64; RefusalError where ``refusal`` has a reason."""
        if reason := self.refusal(n, d):
            raise RefusalError(reason)
        x = rng.random((n, d))
        return minimise(self.energy(n, d), x, self.gradients) if n > 1 else x


def minimise(energy: MeshEnergy | EwaldEnergy, x: FloatArray, gradients: int) -> FloatArray:
    """Move points down an energy by L-BFGS.

    Parameters
    ----------
    energy : callable
        Gives the energy of (n, d) points of [0, 1) and its gradient in spacings.
    x : (n, d) float64
        Start.
    gradients : int
        Most evaluations.

    Returns
    -------
    (n, d) float64
        In [0, 1).
    """
    from scipy.optimize import minimize

    side = len(x) ** (1 / x.shape[1])

    def flat(u: FloatArray) -> tuple[float, FloatArray]:
        value, gradient = energy(wrap(u.reshape(x.shape) / side))
        return value, gradient.ravel()

    options = {"maxfun": gradients, "maxiter": gradients, "maxcor": 20, "ftol": 0.0, "gtol": 1e-12}
    start = (x * side).ravel()
    found = minimize(flat, start, jac=True, method="L-BFGS-B", options=options)  # type: ignore[call-overload]
    return wrap(found.x.reshape(x.shape) / side)
