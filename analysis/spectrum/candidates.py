"""Evaluators that could serve a request, with their costs and errors, and what speaks against each."""

from __future__ import annotations

import difflib
from dataclasses import dataclass

from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.evaluation_cost import EvaluationCost
from gbnbench.analysis.spectrum.evaluators.protocol import Evaluator
from gbnbench.analysis.spectrum.evaluators.registry import EVALUATORS
from gbnbench.analysis.spectrum.request import SpectrumRequest
from gbnbench.core.errors import InputError

PRECISIONS = ("double", "float")


@dataclass(frozen=True)
class Candidate:
    """An evaluator with its cost and errors, and what speaks against it.

    Attributes
    ----------
    evaluator : Evaluator
        The evaluator, at its precision.
    cost : EvaluationCost
        Work, memory and time that the request takes with it.
    errors : Errors
        Errors of the square root of power: of one set as it is offered, of the mean over sets in a plan.
    against : str
        Reason why it is not chosen; empty for the one that is.
    """

    evaluator: Evaluator
    cost: EvaluationCost
    errors: Errors
    against: str = ""


def candidates(request: SpectrumRequest, floor: float | None, method: str | None = None) -> list[Candidate]:
    """Gather every evaluator that this machine has for a request, with its cost and errors.

    Parameters
    ----------
    request : SpectrumRequest
        The frequencies, points and sets.
    floor : float or None
        Smallest power that must be known to 1%.
    method : str, optional
        The evaluator that the user asked for, by its word.

    Returns
    -------
    list of Candidate
        The exact ones first, then the approximate ones.

    Raises
    ------
    InputError
        If none can serve the request.
    """
    offered = [
        kind.offer(request, precision, floor=floor, forced=kind.method == method)
        for approximate in (False, True)
        for precision in PRECISIONS
        for kind in EVALUATORS
        if kind.approximate == approximate and request.what in kind.serves
    ]
    found = [
        Candidate(evaluator, evaluator.cost(request), evaluator.expected_errors(request))
        for evaluator in offered
        if evaluator is not None
    ]
    if not found:
        raise InputError(no_room(request))
    return found


def check_precision(precision: object) -> None:
    """Refuse a precision other than "double" and "float" with an InputError."""
    if precision not in PRECISIONS:
        raise InputError(f'precision must be "double" or "float"; got {precision!r}')


def no_room(request: SpectrumRequest) -> str:
    """Say that nothing serves a request, since without a device shells need a whole cube in memory."""
    return (
        f"{request} do not fit in memory as a cube, and without an OpenCL device there is no streaming. "
        "Install one: gbnbench devices tells how"
    )


def unavailable(request: SpectrumRequest, method: str | None, precision: str) -> str:
    """Say why a method does not serve a request, and which methods do.

    Parameters
    ----------
    request : SpectrumRequest
        The frequencies, points and sets.
    method : str or None
        The evaluator that the user asked for, by its word.
    precision : {"double", "float"}
        Precision that was asked for.

    Returns
    -------
    str
        A sentence for an error message.
    """
    serving = {kind.method: kind for kind in EVALUATORS if request.what in kind.serves}
    if method not in serving:
        words = {kind.title: name for name, kind in serving.items()} | {name: name for name in serving}
        close = difflib.get_close_matches(str(method), words, n=1)
        hint = f"; did you mean {words[close[0]]!r}?" if close else ""
        return f"method must be one of {', '.join(serving)} for {request.what}; got {method!r}{hint}"
    return serving[method].why_not(request, precision)


def objection(candidate: Candidate, only: str | None, floor: float | None, method: str | None) -> str:
    """Say what speaks against a candidate: another precision, an error too large, or not being exact.

    Parameters
    ----------
    candidate : Candidate
        The evaluator, with the errors of the mean over sets.
    only : {"double", "float"} or None
        The one precision that is allowed; None for either.
    floor : float or None
        Smallest power that must be known to 1%.
    method : str or None
        The evaluator that the user asked for, by its word.

    Returns
    -------
    str
        Empty if nothing does.
    """
    evaluator = candidate.evaluator
    resolves = f"knows only P = {candidate.errors.resolvable:.1e} to 1%"
    if method is not None and evaluator.method != method:
        return f"{method} was asked for"
    if floor is None:
        if evaluator.tolerance and method is None:
            return f"{resolves}; give a floor to allow that"
        if evaluator.precision != only:
            return resolves if only == "double" else f"{only} was asked for"
        return ""
    if only is not None and evaluator.precision != only:
        return f"{only} was asked for"
    return resolves if candidate.errors.resolvable > floor * (1 + 1e-9) else ""
