"""Everything measured of a piece of a source's realizations, as arrays that ``Scalars`` puts together."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.analysis.measuring_plan import MeasuringPlan
from gbnbench.analysis.outcomes import outcome
from gbnbench.analysis.radial.psa import excess_density
from gbnbench.analysis.set_powers import PowersMerger, SetPowers, measured_powers, one_set
from gbnbench.analysis.spatial.bond_order import bond_order, psi6
from gbnbench.analysis.spatial.delaunay import Neighbours, neighbours
from gbnbench.analysis.spatial.discrepancy import DiscrepancyResult, measure_discrepancies
from gbnbench.analysis.spatial.discrepancy_kernels import Discrepancy
from gbnbench.analysis.spatial.distances import nearest_distances
from gbnbench.analysis.spatial.plane_order import PlaneOrder, plane_order, summed_shares
from gbnbench.analysis.spatial.rdf import RadialDistribution, curve_bins, rdf
from gbnbench.analysis.spatial.slabs import WHOLE
from gbnbench.analysis.spatial.valence import Valence, valence, valence6
from gbnbench.analysis.spatial.zone_plate import zone_plate
from gbnbench.analysis.spectral_scalars import spectral_scalars
from gbnbench.core.errors import RefusalError, ShortSpectrumError
from gbnbench.core.sides import Sides
from gbnbench.core.torus import FloatArray

DISCREPANCIES: dict[str, Discrepancy] = {"discrepancy_wd": "WD", "discrepancy_star": "L2-star"}


Progress = Callable[[str, float], None]


def measure_piece(
    points: FloatArray, plan: MeasuringPlan, first: int = 0, progress: Progress | None = None
) -> dict[str, NDArray[Any]]:
    """Measure the sets of a piece.

    Parameters
    ----------
    points : (sets, n, d) float64
        Checked points of consecutive realizations.
    plan : MeasuringPlan
        Of the whole source.
    first : int
        The number of the first of them.
    progress : callable, optional
        Called with the name of a stage of ``measuring_cost`` and the share of it that is done, of large sets.

    Returns
    -------
    dict of arrays
        By name: ``near/...`` and, where measures need them, ``far/...`` as ``measured_powers`` returns them;
        a value of each set for measures of single sets; sums over the sets for curves. What is undefined has
        its refusal in its place (``outcome``).
    """
    found = {f"near/{name}": array for name, array in measured_powers(points, plan.near, plan.group).items()}
    if plan.far is not None and needs_farther(_powers_of(found, plan)):
        farther = measured_powers(points, plan.far, plan.group)
        found |= {f"far/{name}": array for name, array in farther.items()}
    tell = progress or _say_nothing
    tell("spectrum", 1.0)
    found |= {name: outcome(compute) for name, compute in _of_sets(points, plan, tell).items()}
    if plan.curves:
        found |= _curves(points, plan)
        if first == 0:
            found["zone_plate"] = outcome(lambda: zone_plate(points[:1], sides=plan.sides))
    return found


def _say_nothing(stage: str, share: float) -> None:
    """Take progress that nobody asked for."""


def needs_farther(powers: SetPowers) -> bool:
    """Tell whether some measure needs frequencies beyond those of a spectrum: this is of the sizes alone."""
    for compute in spectral_scalars(one_set(powers)).values():
        try:
            compute()
        except ShortSpectrumError:
            return True
        except RefusalError:
            continue
    return False


def _powers_of(found: dict[str, NDArray[Any]], plan: MeasuringPlan) -> SetPowers:
    near = {name.removeprefix("near/"): array for name, array in found.items()}
    merger = PowersMerger(plan.near, plan.group, plan.n, len(near["rows"]))
    merger.add(near)
    return merger.merged()


def _of_sets(points: FloatArray, plan: MeasuringPlan, tell: Progress) -> dict[str, Callable[[], FloatArray]]:
    """Measures of each set, and what those of the mean are made of."""
    sides = plan.sides

    @cache
    def nearest() -> FloatArray:
        return nearest_distances(points, sides, progress=partial(tell, "distances"))

    @cache
    def beside() -> tuple[Neighbours, ...]:
        return neighbours(points, sides)

    @cache
    def discrepancies() -> dict[Discrepancy, DiscrepancyResult]:
        tell("discrepancies", 0.0)
        found = measure_discrepancies(points, tuple(DISCREPANCIES.values()))  # they share most of their cost
        tell("discrepancies", 1.0)
        return found

    def discrepancy(kind: Discrepancy) -> Callable[[], FloatArray]:
        def values() -> FloatArray:
            found = discrepancies()[kind]
            unknown = [reason for reason in found.reasons if reason]
            if unknown:
                raise RefusalError(unknown[0])
            return found.value

        return values

    def degrees() -> FloatArray:
        found: Valence = valence(beside())
        shares = found.share_by_set.sum(axis=0)
        return np.stack([found.degree.astype(np.float64), shares])

    d = plan.d
    of_neighbours: dict[str, Callable[[], FloatArray]] = {
        "bond_order": _in_plane("bond order", d, lambda: bond_order(beside())),
        "psi6": _in_plane("psi6", d, lambda: psi6(beside())),
        "valence6": _in_plane("the share of degree six", d, lambda: valence6(beside())),
        "valence": degrees,
    }
    return {
        "min_distance": lambda: np.asarray(nearest().min(axis=1)),
        "mean_distance": lambda: np.asarray(nearest().mean(axis=1)),
        **(_order_of_large(points, sides, tell) if plan.n > WHOLE else of_neighbours),
        "psa": lambda: excess_density(points, sides),
        **{name: discrepancy(kind) for name, kind in DISCREPANCIES.items()},
    }


def _in_plane(name: str, d: int, values: Callable[[], FloatArray]) -> Callable[[], FloatArray]:
    """Refuse a measure by its own name where it is not defined, before neighbours are looked for."""

    def checked() -> FloatArray:
        if d != 2:
            raise RefusalError(f"{name} is defined in the plane; got d={d}")
        return values()

    return checked


def _order_of_large(
    points: FloatArray, sides: Sides | None, tell: Progress
) -> dict[str, Callable[[], FloatArray]]:
    """Measures of the neighbours in sets that are too large to be triangulated whole, slab by slab."""
    n, d = points.shape[1:]

    @cache
    def orders() -> tuple[PlaneOrder, ...]:
        return tuple(plane_order(one, sides, partial(tell, "neighbours")) for one in points)

    def mean(name: str, value: Callable[[PlaneOrder], float]) -> Callable[[], FloatArray]:
        return _in_plane(name, d, lambda: np.array([value(order) for order in orders()]))

    def degrees() -> FloatArray:
        if d != 2:
            raise RefusalError(f"Delaunay neighbours in d={d} are made of at most {WHOLE} points; got n={n}")
        return summed_shares(orders())

    return {
        "bond_order": mean("bond order", lambda order: order.bond_order),
        "psi6": mean("psi6", lambda order: order.psi6),
        "valence6": mean("the share of degree six", lambda order: order.valence6),
        "valence": degrees,
    }


def _curves(points: FloatArray, plan: MeasuringPlan) -> dict[str, NDArray[Any]]:
    """Radial distribution function, summed over the sets."""

    def both() -> FloatArray:
        found: RadialDistribution = rdf(points, plan.sides, bins=curve_bins(points.shape[-2]))
        return np.stack([found.r, found.g_by_set.sum(axis=0)])

    return {"rdf": outcome(both)}
