"""Requests for sets that several figures make alike, so that they share them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from gbnbench.reports.paper.data import ComparisonRequest
from gbnbench.reports.paper.figure import FigureOptions
from gbnbench.reports.paper.method_styles import NAMES


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


def methods_with_sets(options: FigureOptions, paper: Sequence[str]) -> tuple[str, ...]:
    """List the methods without a generator whose sets the user gave for a figure.

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
        *(name for name in paper if name in options.sets),
        *(name for name in options.sets if name not in NAMES),
    )


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
