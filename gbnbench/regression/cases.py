"""A case of the regression check: what is measured, what is expected of it, and how far it may be off."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal

from gbnbench.core.errors import InputError
from gbnbench.core.settings import nearest

Better = Literal["lower", "higher", "neither"]
Scale = Literal["ratio", "difference", "relative"]
Values = tuple[float, ...]


@dataclass(frozen=True)
class Spread:
    """How much a value differs between seeds.

    Attributes
    ----------
    seeds : int
        Over how many, from the case's own upwards.
    deviation : float
        Standard deviation, of the value's natural logarithm where the scale is a ratio.
    """

    seeds: int
    deviation: float


@dataclass(frozen=True)
class Expectation:
    """What a measure of a case should be.

    Attributes
    ----------
    better : {"lower", "higher", "neither"}
        The side on which a departure is welcome.
    scale : {"ratio", "difference", "relative"}
        A departure is a factor, a difference, or the largest difference over the largest expected value.
    reason : str
        Why this measure stands here and why the tolerance is what it is.
    expected : tuple of float
        One number, or several that are judged together; empty until ``gbnbench check --update`` measures it.
    tolerance : float
        Largest departure that is none; a factor above 1 for ratios.
    spread : Spread or None
        Where the tolerance comes from, for what is measured.
    reference : str
        Where the values come from and how exact they are, for what is known otherwise; such values are never
        updated.
    """

    better: Better
    scale: Scale
    reason: str
    expected: Values = ()
    tolerance: float = 0.0
    spread: Spread | None = None
    reference: str = ""


@dataclass(frozen=True)
class Case:
    """Something seeded that can be measured anywhere.

    Attributes
    ----------
    name : str
        Unique in its file.
    kind : {"sets", "field", "lattice"}
        Measures of generated sets; the energy's field at fixed points; the spectrum of a dyadic lattice.
    n, d : int
        Points and dimension.
    measures : mapping
        Name -> Expectation.
    full : bool
        Only with ``--full``.
    seed : int
        Of the sets, or of the fixed points.
    realizations : int
        Sets measured together.
    generator : str
        Of sets, such as ``gbn[gradients=300]``.
    sigma : float
        Of a field, in spacings.
    precision : str
        Of a field or a lattice, "double" or "float"; sets come in what the generator chooses.
    """

    name: str
    kind: str
    n: int
    d: int
    measures: Mapping[str, Expectation] = field(default_factory=dict)
    full: bool = False
    seed: int = 0
    realizations: int = 1
    generator: str = ""
    sigma: float = 1.0
    precision: str = "double"

    @property
    def exact(self) -> bool:
        """Whether all that is expected is known from elsewhere."""
        return all(expectation.reference for expectation in self.measures.values())


def select(cases: Sequence[Case], only: Sequence[str], full: bool) -> tuple[Case, ...]:
    """Choose cases: those named, or those of the default run, or with ``full`` all.

    Parameters
    ----------
    cases : sequence of Case
        To choose from.
    only : sequence of str
        Names; none leaves the choice to ``full``.
    full : bool
        Choose all, not only those of the default run.

    Returns
    -------
    tuple of Case

    Raises
    ------
    InputError
        If a name is none of theirs.
    """
    names = [case.name for case in cases]
    for name in only:
        if name not in names:
            raise InputError(f"no case is named {name!r}{nearest(name, names)}; there are {', '.join(names)}")
    if only:
        return tuple(case for case in cases if case.name in only)
    return tuple(case for case in cases if full or not case.full)
