"""Which evaluation a spectrum gets, and why: the cheapest that is exact to what was asked for."""

from __future__ import annotations

import math
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field, replace

import numpy as np

from gbnbench.analysis.precision import precision_of
from gbnbench.analysis.spectrum.error_model import Errors, rms_for
from gbnbench.analysis.spectrum.evaluation_cost import (
    CALL_SECONDS,
    NUMPY_RATE,
    Cost,
    can_be_gridded,
    device_cost,
    device_errors,
    gridded_is_cheaper,
    numpy_cost,
)
from gbnbench.analysis.spectrum.evaluators import nufft, numpy_product
from gbnbench.analysis.spectrum.evaluators.evaluation import (
    DIRECT,
    GRIDDED,
    NUFFT,
    PRODUCT,
    SEPARABLE,
    STREAMED,
    Evaluation,
)
from gbnbench.analysis.spectrum.evaluators.gridded_product import least_gridded
from gbnbench.analysis.spectrum.limits import check_fmax
from gbnbench.analysis.spectrum.request import Request, shell_request
from gbnbench.core.errors import InputError
from gbnbench.opencl import devices_present


@dataclass(frozen=True)
class Candidate:
    """An evaluation with its cost and errors, and what speaks against it ("" for the one chosen)."""

    evaluation: Evaluation
    cost: Cost
    errors: Errors
    against: str = ""


@dataclass(frozen=True)
class Plan:
    """The evaluation chosen for a request, and those that were not.

    Attributes
    ----------
    request : Request
        What is asked for.
    chosen : Candidate
        What will be done.
    why : str
        In a sentence.
    others : tuple of Candidate
        The rest, each with what speaks against it.
    """

    request: Request
    chosen: Candidate
    why: str
    others: tuple[Candidate, ...] = field(default=())

    @property
    def method(self) -> str:
        """Name of the evaluation chosen."""
        return self.chosen.evaluation.method

    @property
    def precision(self) -> str:
        """Its precision."""
        return self.chosen.evaluation.precision

    @property
    def flops(self) -> float:
        """Its arithmetic operations."""
        return self.chosen.cost.flops

    @property
    def bytes(self) -> int:
        """Its memory."""
        return self.chosen.cost.bytes

    @property
    def seconds(self) -> float:
        """Its expected time."""
        return self.chosen.cost.seconds

    @property
    def errors(self) -> Errors:
        """Its errors, for points not seen yet."""
        return self.chosen.errors

    def explain(self) -> str:
        """Say in a few lines what will be done, why, what it costs and how exact it is."""
        evaluation, cost, errors = self.chosen.evaluation, self.chosen.cost, self.errors
        lines = [
            str(self.request),
            f"  {evaluation.label}, on {evaluation.device.partition(' (')[0]}",
            f"  because {self.why}",
            f"  {_si(cost.flops)}flop, {_si(cost.bytes)}B, about {cost.seconds:.2g} s",
            f"  error of sqrt(P): {errors.rms:.1e} typically, {errors.bound:.1e} at worst; "
            f"P = {errors.resolvable:.1e} is known to 1%",
        ]
        lines += [
            f"  not {other.evaluation.label}, about {other.cost.seconds:.2g} s: {other.against}"
            for other in self.others
        ]
        return "\n".join(lines)

    def __str__(self) -> str:
        return self.explain()


def plan(
    n: int,
    d: int,
    fmax: int,
    precision: str | None = None,
    *,
    realizations: int = 1,
    frequencies: int | None = None,
    half: bool = False,
    shells: bool = False,
    band: Sequence[float] | None = None,
    corners: bool = False,
    floor: float | None = None,
) -> Plan:
    """Choose how a spectrum will be evaluated, before there are any points.

    Parameters
    ----------
    n, d : int
        Points a set and dimension.
    fmax : int
        Largest harmonic on each axis.
    precision : {"double", "float"}, optional
        As in ``gbnbench.periodogram``.
    realizations : int
        Sets.
    frequencies : int, optional
        How many are listed, instead of a cube.
    half : bool
        Half a cube.
    shells, band, corners : bool, (low, high) optional, bool
        As in ``gbnbench.shells``, instead of a cube.
    floor : float, optional
        Smallest power that must be known to 1%.

    Returns
    -------
    Plan
        ``explain()`` says all of it in words.

    Raises
    ------
    InputError
        As ``gbnbench.periodogram`` and ``gbnbench.shells``: what cannot fit is refused with what would.

    Examples
    --------
    >>> print(plan(1024, 2, 64).method)
    two-group product
    """
    listed = 1 if frequencies is None else frequencies
    counts = {"n": n, "d": d, "realizations": realizations, "frequencies": listed}
    for name, value in counts.items():
        if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < 1:
            raise InputError(f"{name} must be an integer of at least 1; got {value!r}")
    asked = {
        "frequencies": frequencies is not None,
        "half": half,
        "shells": shells or corners or band is not None,
    }
    for name, value in (("half", half), ("shells", shells), ("corners", corners)):
        if not isinstance(value, (bool, np.bool_)):
            raise InputError(f"{name} must be True or False; got {value!r}")
    if sum(asked.values()) > 1:
        raise InputError(f"ask for one of {', '.join(name for name, is_asked in asked.items() if is_asked)}")
    if frequencies is not None:
        if isinstance(fmax, bool) or not isinstance(fmax, (int, np.integer)) or not 0 <= fmax <= 1 << 63:
            raise InputError(f"fmax must be the largest |f_a| listed, at most 2^63; got {fmax!r}")
        request = Request("listed", n, d, int(fmax), realizations, frequencies)
    elif shells or band is not None or corners:
        request = shell_request(n, d, fmax, realizations, band, corners)
    else:
        f = check_fmax(fmax, d)
        request = Request("half cube" if half else "cube", n, d, f, realizations, (2 * f + 1) ** d)
    return planned(request, precision, floor)


def choose(
    request: Request, precision: str | None, floor: float | None, method: str | None = None
) -> Evaluation:
    """Choose an evaluation; costs are weighed only where a floor leaves a choice.

    Raises
    ------
    InputError
        If precision is unknown, nothing resolves the floor, or there is no such method for the request.
    DeviceError
        If the device lacks the precision.
    """
    if floor is not None or method is not None:
        return planned(request, precision, floor, method).chosen.evaluation
    wanted = precision or "double"
    if request.what == "shells" and not devices_present():
        return planned(request, wanted, None).chosen.evaluation  # refuses a cube that does not fit
    exact = {"listed": DIRECT, "shells": STREAMED}.get(request.what, PRODUCT)
    if precision_known(wanted) and devices_present():
        p = precision_of(wanted)  # or say what is missing
        return Evaluation(GRIDDED if gridded_is_cheaper(p, request) else exact, wanted)
    return Evaluation(SEPARABLE, wanted)


def planned(request: Request, precision: str | None, floor: float | None, method: str | None = None) -> Plan:
    """Weigh every evaluation that could serve a request; raises as ``choose``."""
    if floor is not None and not (
        isinstance(floor, (int, float, np.number)) and not isinstance(floor, bool) and 0 < floor < math.inf
    ):
        raise InputError(f"floor must be a positive power, such as 1e-12; got {floor!r}")
    if precision is not None:
        precision_known(precision)
    possible = candidates(request, floor, method)
    if method is not None and method not in {c.evaluation.method for c in possible}:
        raise InputError(_unavailable(request, method, precision))
    averaged = [replace(c, errors=c.errors.averaged(request.realizations, request.n)) for c in possible]
    weighed = [_weighed(candidate, precision, floor, method) for candidate in averaged]
    fitting = sorted((c for c in weighed if not c.against), key=lambda c: c.cost.seconds)
    if not fitting:
        if floor is None or precision not in {None, *(c.evaluation.precision for c in weighed)}:
            if devices_present():
                precision_of(precision or "double")  # says what the device lacks
            raise InputError(_unavailable(request, method, precision))
        best = min(c.errors.resolvable for c in weighed if precision in (None, c.evaluation.precision))
        raise InputError(
            f"floor={floor:g} is out of reach: the least power known to 1% here is {best:.1g}"
            + ("" if precision != "float" else '; precision="double" reaches deeper')
        )
    chosen, *slower = fitting
    others = [replace(c, against="slower") for c in slower]
    others += [c for c in weighed if c.against]
    if method is not None:
        why = f"{method} was asked for"
    elif floor is not None:
        why = f"it is the cheapest that knows P = {floor:g} to 1%"
    elif precision is not None:
        why = f"{precision} was asked for"
    else:
        why = "it is exact, and no floor was given that would allow less"
    if chosen.evaluation.method == SEPARABLE:
        why += ", and there is no OpenCL device"
    return Plan(request, chosen, why, tuple(others))


def _unavailable(request: Request, method: str | None, precision: str | None) -> str:
    """Say why a method does not serve a request, and which do."""
    names = {
        "listed": (DIRECT, SEPARABLE),
        "shells": (STREAMED, SEPARABLE),
    }.get(request.what, (PRODUCT, GRIDDED, SEPARABLE, NUFFT))
    if method not in names:
        return f"method must be one of {', '.join(names)} for {request.what}; got {method!r}"
    if method == GRIDDED:
        return (
            f"the gridded product in {precision or 'double'} needs two dimensions and fmax of at least "
            f"{least_gridded(precision or 'double')}; got d={request.d}, fmax={request.fmax}"
        )
    if method == NUFFT and request.d > nufft.DIMENSIONS:
        return f"the non-uniform FFT does up to {nufft.DIMENSIONS} dimensions; got d={request.d}"
    if method == NUFFT and not nufft.available():
        return "the non-uniform FFT needs FINUFFT: pip install finufft"
    if method == NUFFT:
        return f"the non-uniform FFT computes in double; got precision={precision!r}"
    return f"{method} needs an OpenCL device, and there is none; gbnbench devices tells how to get one"


def _weighed(
    candidate: Candidate, precision: str | None, floor: float | None, method: str | None
) -> Candidate:
    """Say what speaks against a candidate: another precision, an error too large, or not being exact."""
    evaluation = candidate.evaluation
    against = ""
    if method is not None and evaluation.method != method:
        against = f"{method} was asked for"
    elif floor is None:
        if evaluation.tolerance and method is None:
            against = f"knows only P = {candidate.errors.resolvable:.1e} to 1%; give a floor to allow that"
        elif evaluation.precision != (precision or "double"):
            against = f"knows only P = {candidate.errors.resolvable:.1e} to 1%"
            if precision is not None:
                against = f"{precision} was asked for"
    elif precision is not None and evaluation.precision != precision:
        against = f"{precision} was asked for"
    elif candidate.errors.resolvable > floor * (1 + 1e-9):
        against = f"knows only P = {candidate.errors.resolvable:.1e} to 1%"
    return replace(candidate, against=against)


def candidates(request: Request, floor: float | None, method: str | None = None) -> list[Candidate]:
    """Every evaluation that this machine has for a request, with costs and errors."""
    found: list[Candidate] = []
    if devices_present():
        exact = {"listed": DIRECT, "shells": STREAMED}.get(request.what, PRODUCT)
        for name in ("double", "float"):
            if name == "double" and not precision_of("float").runtime.device.has_double:
                continue
            p = precision_of(name)
            costs = device_cost(p, request), device_errors(p, request)
            found.append(Candidate(Evaluation(exact, name), *costs))
            if gridded_is_cheaper(p, request) or (method == GRIDDED and can_be_gridded(request, name)):
                costs = device_cost(p, request, gridded=True), device_errors(p, request, gridded=True)
                found.append(Candidate(Evaluation(GRIDDED, name), *costs))
    if method == SEPARABLE or (not found and (request.what != "shells" or _cube_fits(request))):
        for name in ("double", "float"):
            n, d, f = request.n, request.d, request.fmax
            errors = numpy_product.separable_errors(n, d, f, name, listed=request.what == "listed")
            found.append(Candidate(Evaluation(SEPARABLE, name), numpy_cost(request, name), errors))
    if not found:
        raise InputError(
            f"{request} do not fit in memory as a cube, and without an OpenCL device there is no streaming. "
            "Install one: gbnbench devices tells how"
        )
    if request.what in ("cube", "half cube") and request.d <= nufft.DIMENSIONS and nufft.available():
        found += _nufft(request, floor)
    return found


def _nufft(request: Request, floor: float | None) -> list[Candidate]:
    n, d, f = request.n, request.d, request.fmax
    tolerance = nufft.TIGHTEST
    if floor is not None:
        with suppress(InputError):  # out of its reach: then it is weighed at its best
            tolerance = nufft.nufft_tolerance(rms_for(floor), n, d, f)
    errors = nufft.nufft_errors(n, d, f, tolerance)
    seconds = request.realizations * nufft.nufft_seconds(n, d, f, tolerance)
    room = nufft.nufft_bytes(n, d, f, tolerance)
    cost = Cost(seconds * NUMPY_RATE, room, CALL_SECONDS / 4 + seconds)
    return [Candidate(Evaluation(NUFFT, "double", tolerance), cost, errors)]


def _cube_fits(request: Request) -> bool:
    try:
        check_fmax(request.fmax, request.d)
    except InputError:
        return False
    return True


def precision_known(precision: object) -> bool:
    """Whether precision is "double" or "float"; raises InputError otherwise."""
    if precision not in ("double", "float"):
        raise InputError(f'precision must be "double" or "float"; got {precision!r}')
    return True


def _si(value: float) -> str:
    """Three digits and an SI prefix: 1.23 G."""
    for prefix in ("", "k", "M", "G", "T", "P"):
        if value < 999.5:
            return f"{value:.3g} {prefix}"
        value /= 1000
    return f"{value:.3g} E"
