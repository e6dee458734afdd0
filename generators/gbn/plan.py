"""The choice between evaluations of the energy: the cheapest of those that are exact to the precision."""

from __future__ import annotations

import math
from dataclasses import dataclass

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.memory import PROCESS_BYTES
from gbnbench.generators.gbn import kernel
from gbnbench.generators.gbn.energy_cost import EnergyCost
from gbnbench.generators.gbn.methods import METHODS

TOLERATED = 5.0  # times the least error: image sums lose digits where images overlap
STRIPS_BYTES = (270, 660, 1700)  # a point at the peak in 1D, 2D, 3D; 10^5 to 2 10^6 points took less
TRUNCATED = {"cutoff": "the only one that cuts the kernel off", "edge": "the only one with an edge"}


@dataclass(frozen=True)
class EnergyPlan:
    """A choice between evaluations, with what the others would have cost.

    Attributes
    ----------
    n, d, sets : int
        Size.
    sigma : float
        In spacings.
    precision : {"double", "float"}
        Of the arithmetic.
    cutoff, edge : float or None
        Kernel truncated in space (sigmas) or in frequency (nu).
    chosen : EnergyCost
        The evaluation.
    why : str
        In words.
    others : tuple of EnergyCost
        What would do as well, cheapest first, then what would lose digits.
    refused : tuple of (str, str)
        Methods that cannot, and why.
    """

    n: int
    d: int
    sets: int
    sigma: float
    precision: str
    cutoff: float | None
    edge: float | None
    chosen: EnergyCost
    why: str
    others: tuple[EnergyCost, ...]
    refused: tuple[tuple[str, str], ...]

    @property
    def method(self) -> str:
        """Name of the evaluation."""
        return self.chosen.method

    @property
    def error(self) -> float:
        """Bound on a component's error, as ``EnergyEvaluation.error``."""
        return self.chosen.error

    @property
    def flops(self) -> float:
        """Floating-point operations of all sets, two an instruction."""
        return 2 * self.sets * self.chosen.instructions

    def seconds(self, which: EnergyCost | None = None) -> float:
        """Estimate the CPU seconds of one gradient of all sets on the chosen device, by its measured peak.

        Raises
        ------
        DeviceError
            If there is no device.
        """
        from gbnbench.opencl.peak_rate import peak

        found = which or self.chosen
        each = found.effort - found.launches
        return (self.sets * each + found.launches) * 2 / peak(self.precision)

    def memory(self, moved: int) -> float | None:
        """Bytes of the process at its peak, the sets included, moved points being optimised at once.

        Parameters
        ----------
        moved : int
            Points of a batch.

        Returns
        -------
        float or None
            None where only small sets are served and it has not been measured.
        """
        if self.method != "strips":
            return None
        return PROCESS_BYTES + STRIPS_BYTES[self.d - 1] * moved + 2 * 8 * self.n * self.d * self.sets

    def __str__(self) -> str:
        """Explain the choice, a line for each method."""
        head = f"{self.method}: {self.chosen.detail}; {self.why}"
        lines = [f"{self.n} points, {self.d}D, sigma {self.sigma:g}, {self.precision}: {head}"]
        lines.extend(
            f"  {c.method:<10} {c.detail:<34} {1e3 * self.seconds(c):10.4g} ms  error {c.error:.1e}"
            for c in (self.chosen, *self.others)
        )
        lines.extend(f"  {name:<10} not here: {reason}" for name, reason in self.refused)
        return "\n".join(lines)


def plan_energy(
    n: int,
    d: int,
    sigma: float,
    precision: str,
    *,
    sets: int = 1,
    cutoff: float | None = None,
    edge: float | None = None,
    method: str | None = None,
) -> EnergyPlan:
    """Choose how the energy of sets of n points is evaluated.

    Parameters
    ----------
    n, d : int
        Size of a set.
    sigma : float
        Kernel width in spacings n**(-1/d).
    precision : {"double", "float"}
        Of the arithmetic.
    sets : int
        Sets a call; changes what is expected, never the choice, so that a set's points do not depend on it.
    cutoff : float, optional
        Truncate the kernel: only pairs with r <= cutoff * sigma (Fig. 4 and 5). Strips only.
    edge : float, optional
        Truncate the energy in frequency: only 0 < nu <= edge, a ball. Harmonics only.
    method : {"strips", "images", "theta", "harmonics"}, optional
        Instead of the cheapest.

    Returns
    -------
    EnergyPlan

    Raises
    ------
    InputError
        If a value makes no sense, or cutoff or edge is asked of a method that has none.
    RefusalError
        If the method asked for cannot serve this size.
    """
    _check(n, d, sigma, precision, sets, cutoff, edge, method)
    truncations = {"cutoff": cutoff, "edge": edge}
    for entry in METHODS.values():
        if entry.truncation and (value := truncations[entry.truncation]) is not None:
            chosen, why = entry.cost(n, d, sigma, precision, value), TRUNCATED[entry.truncation]
            return EnergyPlan(n, d, sets, sigma, precision, cutoff, edge, chosen, why, (), ())
    found, refused = [], []
    for name, entry in METHODS.items():
        try:
            found.append(entry.cost(n, d, sigma, precision))
        except RefusalError as refusal:
            if name == method:
                raise
            refused.append((name, str(refusal)))
    if not found:
        raise RefusalError("; ".join(f"{name}: {reason}" for name, reason in refused))
    exact = TOLERATED * min(c.error for c in found)
    found.sort(key=lambda c: (c.error > exact, c.effort))
    chosen = next((c for c in found if c.method == method), found[0])
    why = "asked for" if method else "the cheapest that is exact to the precision"
    others = tuple(c for c in found if c is not chosen)
    return EnergyPlan(n, d, sets, sigma, precision, None, None, chosen, why, others, tuple(refused))


def _check(
    n: int,
    d: int,
    sigma: float,
    precision: str,
    sets: int,
    cutoff: float | None,
    edge: float | None,
    method: str | None,
) -> None:
    if min(n, d, sets) < 1:
        raise InputError(f"n, d and sets must be at least 1; got n={n}, d={d}, sets={sets}")
    if not (math.isfinite(sigma) and sigma > 0):
        raise InputError(f"sigma must be positive, in spacings; got {sigma}")
    if precision not in kernel.EPS:
        raise InputError(f'precision must be "double" or "float"; got {precision!r}')
    if method is not None and method not in METHODS:
        raise InputError(f"method must be one of {', '.join(METHODS)}; got {method!r}")
    if cutoff is not None and edge is not None:
        raise InputError(
            "cutoff truncates the kernel in space, edge in frequency, and a sharp cut in one has no end in "
            "the other: give one of them"
        )
    for name, value in (("cutoff", cutoff), ("edge", edge)):
        owner = next(owner for owner, entry in METHODS.items() if entry.truncation == name)
        if value is not None and method not in (None, owner):
            raise InputError(f"{name} is a setting of method {owner}; got method={method!r}")
