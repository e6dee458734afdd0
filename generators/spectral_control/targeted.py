"""Points with a radial spectrum of your own (Zhou, Huang, Wei & Wang 2012; Heck, Schlömer & Deussen 2013)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar, cast

from gbnbench.core.errors import InputError
from gbnbench.generators.gauss_newton.targets import TargetPower
from gbnbench.generators.protocol import Family
from gbnbench.generators.spectral_control.ring_means import RingMeans
from gbnbench.generators.spectral_control.single_peak import SinglePeak
from gbnbench.generators.spectral_control.staircase import Staircase
from gbnbench.generators.spectral_control.step import Step
from gbnbench.generators.spectral_control.target_profiles import Table, TargetSetting, as_target

NAMED: dict[str, RingMeans] = {"step": Step(), "peak": SinglePeak(), "staircase": Staircase()}


def _as_target(value: object) -> TargetSetting:
    """Accept a name, a file's name, a callable, a table or (k, 2) numbers."""
    target = as_target(value)
    if target is None:
        named = ", ".join(NAMED)
        raise InputError(f"target must be one of {named}, a file, a table or a function; got {value!r}")
    return target


@dataclass(frozen=True)
class Targeted(RingMeans):
    """Random points moved until the ring means of their power are those of a target.

    Parameters
    ----------
    target : str, callable or (k, 2) array_like
        ``step``, ``peak`` or ``staircase``, as the generators of these names have them by default; a CSV of
        nu and power; a function of nu; or a table of both. A power of 1e-12 or less is none.
    highest : float or None
        nu up to which the target is met; by default the last nu of a table, else 2 in the plane and elsewhere
        what scales as the widest step. Beyond it nothing is asked.
    core : float or None
        Distance, in spacings, below which pairs repel; by default that up to which the pair correlation of
        the target, taken as 1 beyond ``highest``, is below a tenth. 0 for none.
    iterations : int
        Most steps; of method=correlation ten times as many.
    method : {"power", "correlation"}
        Bring ring means of the power to the target, or in the plane the pair correlation function to that of
        the target, by the descent of Heck, Schlömer & Deussen (2013), n up to 4,096.

    Raises
    ------
    InputError
        If a setting is out of range, or the target is none.
    FormatError
        If a file cannot be read as a target.

    Notes
    -----
    Rings are one unit of |f| wide, sqrt(n) units in one dimension. The cost is the squared distance of the
    roots of ring mean and target (``RingCost`` has the formula), minimised by limited-memory BFGS with the
    analytic gradient; the publications descend along the gradient, by ring means or by the pair correlation
    function. Only means are met: around a ring the power stays as scattered as noise. A target that no
    process can have is met as nearly as the points can: ``gbnbench.generators.spectral_control.target_fit``
    measures it. The time grows as n**2.

    Powers far below 1e-4 are met with a small relative error only by ``deep``, which weighs every frequency
    by its own target.

    References
    ----------
    Zhou, Huang, Wei & Wang, "Point sampling with general noise spectrum", ACM Trans. Graph. 31(4), 2012.
    Heck, Schlömer & Deussen, "Blue noise sampling with controlled aliasing", ACM Trans. Graph. 32(3), 2013.

    Examples
    --------
    >>> import numpy as np
    >>> green = Targeted(target=lambda nu: 1 - 0.9 * np.exp(-((nu - 0.3) ** 2) / 0.005))
    >>> green(64, 2, np.random.default_rng(0)).shape
    (64, 2)
    """

    name: ClassVar[str] = "targeted"
    summary: ClassVar[str] = "points with a radial spectrum of your own (Zhou et al. 2012)"
    family: ClassVar[Family] = "spectral"
    dimensions: ClassVar[tuple[int, int | None]] = (1, None)
    toroidal: ClassVar[bool] = True
    reference: ClassVar[str] = "Zhou, Huang, Wei & Wang, 2012; Heck, Schlömer & Deussen, 2013"

    target: TargetSetting = field(default="step", metadata={"read": _as_target, "file": True})

    def __post_init__(self) -> None:
        super().__post_init__()
        object.__setattr__(self, "target", _as_target(self.target))
        table = self._table()
        if table is not None and self.highest is not None and self.highest > table.edge:
            raise InputError(
                f"highest must be at most the last nu of the target, {table.edge}; got {self.highest}"
            )

    def _table(self) -> Table | None:
        if isinstance(self.target, str):
            return None if self.target in NAMED else Table.read(self.target)
        return self.target if isinstance(self.target, Table) else None

    def highest_nu(self, d: int) -> float:
        """Return the nu up to which the target is met in d dimensions."""
        table = self._table()
        return table.edge if table is not None and self.highest is None else super().highest_nu(d)

    def profile(self, d: int) -> TargetPower:
        """Target power as a function of nu in d dimensions."""
        if isinstance(self.target, str):
            named = NAMED.get(self.target)
            return Table.read(self.target) if named is None else named.profile(d)
        return cast("TargetPower", self.target)
