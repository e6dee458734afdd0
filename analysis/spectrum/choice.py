"""Choice of an evaluator: the cheapest that is exact enough for a request."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import lru_cache

import numpy as np

from gbnbench.analysis.precision import precision_of
from gbnbench.analysis.spectrum.candidates import (
    candidates,
    check_precision,
    no_room,
    objection,
    unavailable,
)
from gbnbench.analysis.spectrum.evaluators.protocol import Evaluator
from gbnbench.analysis.spectrum.evaluators.registry import EVALUATORS
from gbnbench.analysis.spectrum.request import SpectrumRequest
from gbnbench.analysis.spectrum.spectrum_plan import SpectrumPlan
from gbnbench.core.errors import InputError
from gbnbench.opencl import devices_present, runtime
from gbnbench.opencl.device import Device


def choose(
    request: SpectrumRequest, precision: str, floor: float | None, method: str | None = None
) -> Evaluator:
    """Choose an evaluator; costs in seconds are weighed only where a floor leaves a choice.

    Parameters
    ----------
    request : SpectrumRequest
        The frequencies, points and sets.
    precision : {"double", "float"}
        Precision of the arithmetic; with a floor "double" stands for whichever resolves it.
    floor : float or None
        Smallest power that must be known to 1%.
    method : str, optional
        The evaluator that the user asked for, by its word.

    Returns
    -------
    Evaluator

    Raises
    ------
    InputError
        If precision is unknown, nothing resolves the floor, or there is no such method for the request.
    DeviceError
        If the device lacks the precision.
    """
    check_precision(precision)
    check_floor(floor)
    device = runtime().device if devices_present() else None
    if floor is None and method is None:
        return _cheapest(request, precision, EVALUATORS, device)
    return _weighed(request, precision, floor, method, EVALUATORS, device)


@lru_cache(maxsize=256)
def _weighed(
    request: SpectrumRequest,
    precision: str,
    floor: float | None,
    method: str | None,
    _kinds: tuple[type[Evaluator], ...],
    _device: Device | None,
) -> Evaluator:
    """Give the evaluator of a plan; with other kinds, or on another device, it may be another one."""
    return planned(request, precision, floor, method).chosen.evaluator


@lru_cache(maxsize=256)
def _cheapest(
    request: SpectrumRequest, precision: str, kinds: tuple[type[Evaluator], ...], device: Device | None
) -> Evaluator:
    """Choose the exact evaluator of least work; what was chosen before is known at once.

    The device is that of the process now. It is an argument since another one may choose otherwise.
    """
    if device is not None:
        precision_of(precision)  # says what the device lacks
    exact = [
        evaluator
        for kind in kinds
        if not kind.approximate and (evaluator := kind.offer(request, precision)) is not None
    ]
    if not exact:
        raise InputError(no_room(request))
    return exact[0] if len(exact) == 1 else min(exact, key=lambda evaluator: evaluator.work(request))


def planned(
    request: SpectrumRequest, precision: str, floor: float | None, method: str | None = None
) -> SpectrumPlan:
    """Weigh every evaluator that could serve a request.

    Parameters and errors are those of ``choose``.

    Returns
    -------
    SpectrumPlan
        The evaluator that ``choose`` gives, with the reason, and the others with what speaks against each.
    """
    check_floor(floor)
    check_precision(precision)
    only = None if floor is not None and precision == "double" else precision
    possible = candidates(request, floor, method)
    if method is not None and method not in {c.evaluator.method for c in possible}:
        raise InputError(unavailable(request, method, precision))
    averaged = [replace(c, errors=c.errors.averaged(request.realizations, request.n)) for c in possible]
    weighed = [
        replace(candidate, against=objection(candidate, only, floor, method)) for candidate in averaged
    ]
    # Seconds are estimates; where all are exact, counted work decides, as in ``choose``.
    fitting = sorted(
        (c for c in weighed if not c.against),
        key=lambda c: c.evaluator.work(request) if floor is None else c.cost.seconds,
    )
    if not fitting:
        if floor is None or only not in {None, *(c.evaluator.precision for c in weighed)}:
            if devices_present():
                precision_of(precision)  # says what the device lacks
            raise InputError(unavailable(request, method, precision))
        best = min(c.errors.resolvable for c in weighed if only in (None, c.evaluator.precision))
        # Rounded up, so that what is named is served.
        raise InputError(
            f"floor={floor:g} is out of reach: the least power known to 1% here is {1.05 * best:.1e}"
            + ("" if only != "float" else '; precision="double" reaches deeper')
        )
    chosen, *slower = fitting
    others = [replace(c, against="slower") for c in slower]
    others += [c for c in weighed if c.against]
    if method is not None:
        why = f"{chosen.evaluator.title} was asked for"
    elif floor is not None:
        why = f"it is the cheapest that knows P = {floor:g} to 1%"
    elif precision != "double":
        why = f"{precision} was asked for"
    else:
        why = "it is exact, and no floor was given that would allow less"
    return SpectrumPlan(request, chosen, why + chosen.evaluator.remark, tuple(others))


def check_floor(floor: object) -> None:
    """Refuse a floor that is neither None nor a positive power with an InputError."""
    if floor is not None and not (
        isinstance(floor, (int, float, np.number)) and not isinstance(floor, bool) and 0 < floor < math.inf
    ):
        raise InputError(f"floor must be a positive power, such as 1e-12; got {floor!r}")
