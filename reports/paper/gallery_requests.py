"""Requests for sets that several figures make alike, so that they share them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from gbnbench.generators.listing import MeasuredCost, measured_costs
from gbnbench.generators.registry import GENERATORS, find
from gbnbench.reports.paper.data import ComparisonRequest
from gbnbench.reports.paper.figure import FigureOptions
from gbnbench.reports.paper.method_styles import GENERATOR_NAMES, NAMES

LONG = 10.0  # CPU seconds a set of 1,024 points


def size(options: FigureOptions) -> int:
    """Return the number of points of a set in the galleries."""
    n: int = options.pick(100, 1024, 1024)
    return n


def sets(options: FigureOptions) -> int:
    """Return the number of sets of each method in the galleries."""
    count: int = options.pick(2, 16, 1000)
    return count


def classic(options: FigureOptions) -> ComparisonRequest:
    """Return the request for FPO and GBN that figures 1 and 8 make."""
    return ComparisonRequest(("fpo", "gbn"), (size(options),), (2,), sets(options))


def relaxed(options: FigureOptions) -> ComparisonRequest:
    """Return the request for Lloyd's method that figures 5 and 8 make."""
    return ComparisonRequest(("lloyd",), (size(options),), (2,), sets(options))


def generator_of(options: FigureOptions, method: str) -> str | None:
    """Name the generator of a method of the paper, if there is one that makes the galleries' sets.

    Parameters
    ----------
    options : FigureOptions
        Scale, sets of the user and seed.
    method : str
        One of ``GIVEN``.

    Returns
    -------
    str or None
    """
    name = GENERATOR_NAMES.get(method, method)
    if name.partition("[")[0] not in GENERATORS or find(name).refusal(size(options), 2) is not None:
        return None
    return name


def methods_shown(options: FigureOptions, paper: Sequence[str]) -> tuple[str, ...]:
    """List the methods that a figure shows beside its own: by the sets that the user gave, or by a generator.

    Parameters
    ----------
    options : FigureOptions
        Scale, sets of the user and seed.
    paper : sequence of str
        Methods of the paper's figure, in its order.

    Returns
    -------
    tuple of str
        Those of the paper first, then methods that the paper does not name.
    """
    return (
        *(name for name in paper if name in options.sets or generator_of(options, name)),
        *(name for name in options.sets if name not in NAMES),
    )


def method_requests(options: FigureOptions, methods: Iterable[str]) -> dict[str, ComparisonRequest]:
    """Return requests for sets of these methods: the user's, else those of the method's generator.

    Parameters
    ----------
    options : FigureOptions
        Scale, sets of the user and seed.
    methods : iterable of str
        Names of methods.

    Returns
    -------
    dict
        Method -> request, for the methods that have either.
    """
    made = {
        method: ComparisonRequest((name,), (size(options),), (2,), _affordable_sets(options, name))
        for method in methods
        if method not in options.sets and (name := generator_of(options, method))
    }
    return {**made, **user_set_requests(options, methods)}


def _affordable_sets(options: FigureOptions, name: str) -> int:
    """Return the number of sets of a method of others: a tenth of the usual where one takes long."""
    cost = measured_costs().get(name.partition("[")[0], MeasuredCost()).cpu_seconds
    return max(2, sets(options) // 10) if cost > LONG else sets(options)


def user_set_requests(options: FigureOptions, methods: Iterable[str]) -> dict[str, ComparisonRequest]:
    """Return requests for the user's sets of these methods, equal in every figure so that they are shared.

    Parameters
    ----------
    options : FigureOptions
        Scale, sets of the user and seed.
    methods : iterable of str
        Names of methods.

    Returns
    -------
    dict
        Method -> request, for the methods that the user gave sets of.
    """
    return {
        name: ComparisonRequest((options.sets[name],), reading=options.reading)
        for name in methods
        if name in options.sets
    }
