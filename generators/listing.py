"""The list of all generators: family, dimensions, domain, measured cost and reference of each."""

from __future__ import annotations

import csv
import math
import warnings
from collections.abc import Collection
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Literal

from gbnbench.core.errors import InputError
from gbnbench.core.settings import nearest
from gbnbench.generators.protocol import FAMILIES, Generator
from gbnbench.generators.registry import GENERATORS
from gbnbench.generators.third_parties.discovery import third_parties, third_party_origin

if TYPE_CHECKING:
    import pandas as pd

COSTS = "measured_costs.csv"
OWN = "gbnbench"  # origin of gbnbench's own


@dataclass(frozen=True)
class MeasuredCost:
    """What one set of a generator costs in 2D.

    Attributes
    ----------
    cpu_seconds : float
        CPU seconds, one thread; nan where it was not measured.
    n : int
        Points of that set: 1,024, or the nearest number that the generator serves.
    """

    cpu_seconds: float = math.nan
    n: int = 1024


@dataclass(frozen=True)
class GeneratorEntry:
    """A row of the list.

    Attributes
    ----------
    name, summary, reference : str
        As of every generator; the reference is empty where there is none to name.
    family : str
        One of ``FAMILIES``; empty where a generator from elsewhere says none.
    dimensions : (int, int or None) or None
        Least and largest d, None where there is no end; None where nothing is said.
    domain : {"torus", "cube", ""}
        Whether opposite sides of the unit cube meet by its design; empty where nothing is said.
    cost : MeasuredCost
        Of a set of 1,024 points in 2D.
    origin : str
        ``"gbnbench"``, a package with its version, or the file of programs.
    """

    name: str
    summary: str
    family: str
    dimensions: tuple[int, int | None] | None
    domain: Literal["torus", "cube", ""]
    cost: MeasuredCost
    reference: str
    origin: str

    @property
    def dimensions_text(self) -> str:
        """The dimensions as lists show them: ``2``, ``1-3``, ``any``, ``2 up``."""
        if self.dimensions is None:
            return "–"
        least, most = self.dimensions
        if most is None:
            return "any" if least == 1 else f"{least} up"
        return str(least) if most == least else f"{least}-{most}"


def entry(kind: type[Generator], origin: str = OWN) -> GeneratorEntry:
    """Return the row of a generator.

    Parameters
    ----------
    kind : type
        Its class.
    origin : str
        Where it is from.

    Returns
    -------
    GeneratorEntry
    """
    toroidal = getattr(kind, "toroidal", None)
    return GeneratorEntry(
        name=kind.name,
        summary=kind.summary,
        family=getattr(kind, "family", None) or "",
        dimensions=getattr(kind, "dimensions", None),
        domain="" if toroidal is None else "torus" if toroidal else "cube",
        cost=measured_costs().get(kind.name, MeasuredCost()) if origin == OWN else MeasuredCost(),
        reference=getattr(kind, "reference", ""),
        origin=origin,
    )


def origin_of(kind: type[Generator]) -> str:
    """Name where a generator is from: gbnbench, a package with its version, or the file of programs."""
    return OWN if GENERATORS.get(kind.name) is kind else third_party_origin(kind)


def generator_entries(family: str | None = None) -> tuple[tuple[GeneratorEntry, ...], tuple[str, ...]]:
    """List every generator, those of installed packages and of the user's file too.

    Parameters
    ----------
    family : str, optional
        Only those of this family.

    Returns
    -------
    entries : tuple of GeneratorEntry
        In the order of the registry, those from elsewhere last.
    faults : tuple of str
        A sentence for each from elsewhere that cannot be used.

    Raises
    ------
    InputError
        If there is no such family.
    """
    elsewhere, faults = third_parties(GENERATORS)
    entries = [
        *(entry(kind) for kind in GENERATORS.values()),
        *(entry(one.kind, one.origin) for one in elsewhere.values()),
    ]
    if family is None:
        return tuple(entries), faults
    check_family(family, {one.family for one in entries if one.family})
    return tuple(one for one in entries if one.family == family), faults


def check_family(family: str, others: Collection[str] = ()) -> None:
    """Refuse a family that there is not.

    Parameters
    ----------
    family : str
        Its name.
    others : collection of str
        Families of generators from elsewhere.

    Raises
    ------
    InputError
        If it is none of ``FAMILIES`` or the others.
    """
    known = list(dict.fromkeys([*FAMILIES, *sorted(others)]))
    if family not in known:
        raise InputError(
            f"no family of generators is named {family!r}{nearest(family, known)}; the families are "
            f"{', '.join(known)}"
        )


def generator_table(family: str | None = None) -> pd.DataFrame:
    """Return every generator with its family, dimensions, domain, cost and reference.

    Parameters
    ----------
    family : str, optional
        Only those of this family: direct, lattice, low-discrepancy, cellular, kernel-based or spectral.

    Returns
    -------
    pandas.DataFrame
        A row a generator, also of installed packages and of the user's file of programs. Columns: name;
        family; least_d and most_d, the latter missing where there is no end; domain, torus or cube;
        cpu_seconds of a set of cost_n points in 2D, measured once on a machine that ``gbnbench generators``
        names, nan where it was not; reference; summary; origin, "gbnbench" or a package or file.

    Raises
    ------
    InputError
        If there is no such family.

    Warns
    -----
    UserWarning
        For each generator from elsewhere that cannot be used.

    Examples
    --------
    >>> import gbnbench
    >>> table = gbnbench.generator_table("lattice")
    >>> table[["name", "least_d", "domain"]].values.tolist()[:2]
    [['grid', 1, 'torus'], ['hexagonal', 2, 'torus']]
    """
    import pandas as pd

    entries, faults = generator_entries(family)
    for fault in faults:
        warnings.warn(fault, stacklevel=2)
    rows = [record(one) for one in entries]
    table = pd.DataFrame(rows, columns=list(record(entry(GENERATORS["random"]))))
    return table.astype({"least_d": "Int64", "most_d": "Int64"})


def record(one: GeneratorEntry) -> dict[str, object]:
    """Return a row as plain values by column."""
    least, most = one.dimensions or (None, None)
    return {
        "name": one.name, "family": one.family, "least_d": least, "most_d": most, "domain": one.domain,
        "cpu_seconds": one.cost.cpu_seconds, "cost_n": one.cost.n, "reference": one.reference,
        "summary": one.summary, "origin": one.origin,
    }  # fmt: skip


@cache
def measured_costs() -> dict[str, MeasuredCost]:
    """Return the measured cost of each generator by name."""
    rows = csv.DictReader(line for line in _cost_lines() if not line.startswith("#"))
    return {row["name"]: MeasuredCost(float(row["cpu_seconds"]), int(row["n"])) for row in rows}


def cost_machine() -> str:
    """Return the machine on which costs were measured."""
    return next((line[1:].strip() for line in _cost_lines() if line.startswith("#")), "")


def _cost_lines() -> list[str]:
    return files("gbnbench.generators").joinpath(COSTS).read_text(encoding="utf-8").splitlines()
