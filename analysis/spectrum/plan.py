"""The plan of a spectrum: the cheapest evaluator that is exact to what was asked for, and why."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from gbnbench.analysis.precision import PrecisionName, precision_of
from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.protocol import EvaluationCost, Evaluator
from gbnbench.analysis.spectrum.evaluators.registry import EVALUATORS
from gbnbench.analysis.spectrum.limits import check_fmax
from gbnbench.analysis.spectrum.request import SpectrumRequest, shell_request
from gbnbench.core.errors import InputError
from gbnbench.opencl import devices_present, use_device

PRECISIONS = ("double", "float")


@dataclass(frozen=True)
class Candidate:
    """An evaluator with its cost and errors, and what speaks against it.

    Attributes
    ----------
    evaluator : Evaluator
        The evaluator, at its precision.
    cost : EvaluationCost
        What the request takes with it.
    errors : Errors
        Errors of the mean power's square root.
    against : str
        Why it is not chosen; empty for the one that is.
    """

    evaluator: Evaluator
    cost: EvaluationCost
    errors: Errors
    against: str = ""


@dataclass(frozen=True)
class SpectrumPlan:
    """The evaluator chosen for a request, and those that were not.

    Attributes
    ----------
    request : SpectrumRequest
        The frequencies, points and sets.
    chosen : Candidate
        The evaluator that will be used.
    why : str
        The reason, in a sentence.
    others : tuple of Candidate
        The rest, each with what speaks against it.

    Examples
    --------
    >>> from gbnbench import plan
    >>> plan(1024, 2, 64).precision
    'double'
    """

    request: SpectrumRequest
    chosen: Candidate
    why: str
    others: tuple[Candidate, ...] = field(default=())

    @property
    def method(self) -> str:
        """The chosen evaluator's word, such as "product"."""
        return self.chosen.evaluator.method

    @property
    def precision(self) -> str:
        """The chosen evaluator's precision, "double" or "float"."""
        return self.chosen.evaluator.precision

    @property
    def flops(self) -> float:
        """Number of its arithmetic operations."""
        return self.chosen.cost.flops

    @property
    def bytes(self) -> int:
        """Memory that it needs."""
        return self.chosen.cost.bytes

    @property
    def seconds(self) -> float:
        """Time that it is expected to take."""
        return self.chosen.cost.seconds

    @property
    def errors(self) -> Errors:
        """Its errors, for points not seen yet."""
        return self.chosen.errors

    def explain(self) -> str:
        """Say in a few lines what will be done, why, what it costs and how exact it is."""
        evaluator, cost, errors = self.chosen.evaluator, self.chosen.cost, self.errors
        lines = [
            str(self.request),
            f"  {evaluator.label}, on {evaluator.device.partition(' (')[0]}",
            f"  because {self.why}",
            f"  {_si(cost.flops)}flop, {_si(cost.bytes)}B, about {cost.seconds:.2g} s",
            f"  error of sqrt(P): {errors.rms:.1e} typically, {errors.bound:.1e} at worst; "
            f"P = {errors.resolvable:.1e} is known to 1%",
        ]
        lines += [
            f"  not {other.evaluator.label}, about {other.cost.seconds:.2g} s: {other.against}"
            for other in self.others
        ]
        return "\n".join(lines)

    def __str__(self) -> str:
        return self.explain()


def plan(
    n: int,
    d: int,
    fmax: int,
    precision: PrecisionName = "double",
    *,
    realizations: int = 1,
    frequencies: int | None = None,
    half: bool = False,
    shells: bool = False,
    band: Sequence[float] | None = None,
    corners: bool = False,
    floor: float | None = None,
    device: str | None = None,
) -> SpectrumPlan:
    """Choose how a spectrum will be evaluated, before there are any points.

    Parameters
    ----------
    n, d : int
        Points in a set, and dimension.
    fmax : int
        Largest harmonic on each axis.
    precision : {"double", "float"}
        As in ``gbnbench.periodogram``.
    realizations : int
        Number of sets.
    frequencies : int, optional
        Number of listed frequencies, instead of a cube.
    half : bool
        Only the half of the cube with f_0 >= 0.
    shells, band, corners : bool, (low, high) optional, bool
        As in ``gbnbench.shells``, instead of a cube.
    floor : float, optional
        Smallest power that must be known to 1%.
    device : str, optional
        The OpenCL device, as in ``gbnbench.periodogram``.

    Returns
    -------
    SpectrumPlan
        ``explain()`` says all of it in words.

    Raises
    ------
    InputError
        As ``gbnbench.periodogram`` and ``gbnbench.shells``: what cannot fit is refused with what would.

    Examples
    --------
    >>> print(plan(1024, 2, 64).method)
    product
    """
    listed = 1 if frequencies is None else frequencies
    counts = {"n": n, "d": d, "realizations": realizations, "frequencies": listed}
    for name, value in counts.items():
        if isinstance(value, bool) or not isinstance(value, (int, np.integer)) or value < 1:
            raise InputError(f"{name} must be an integer of at least 1; got {value!r}")
    kinds = {
        "frequencies": frequencies is not None,
        "half": half,
        "shells": shells or corners or band is not None,
    }
    for name, value in (("half", half), ("shells", shells), ("corners", corners)):
        if not isinstance(value, (bool, np.bool_)):
            raise InputError(f"{name} must be True or False; got {value!r}")
    if sum(kinds.values()) > 1:
        raise InputError(f"ask for one of {', '.join(name for name, wanted in kinds.items() if wanted)}")
    if frequencies is not None:
        if isinstance(fmax, bool) or not isinstance(fmax, (int, np.integer)) or not 0 <= fmax <= 1 << 63:
            raise InputError(f"fmax must be the largest |f_a| listed, at most 2^63; got {fmax!r}")
        request = SpectrumRequest("listed", n, d, int(fmax), realizations, frequencies)
    elif shells or band is not None or corners:
        request = shell_request(n, d, fmax, realizations, band, corners)
    else:
        f = check_fmax(fmax, d)
        request = SpectrumRequest("half cube" if half else "cube", n, d, f, realizations, (2 * f + 1) ** d)
    with use_device(device):
        return planned(request, precision, floor)


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
    if floor is not None or method is not None:
        return planned(request, precision, floor, method).chosen.evaluator
    check_precision(precision)
    if devices_present():
        precision_of(precision)  # says what the device lacks
    exact = [
        evaluator
        for kind in EVALUATORS
        if not kind.approximate and (evaluator := kind.offer(request, precision)) is not None
    ]
    if not exact:
        raise InputError(_no_room(request))
    return exact[0] if len(exact) == 1 else min(exact, key=lambda evaluator: evaluator.work(request))


def planned(
    request: SpectrumRequest, precision: str, floor: float | None, method: str | None = None
) -> SpectrumPlan:
    """Weigh every evaluator that could serve a request.

    Parameters
    ----------
    request, precision, floor, method
        As in ``choose``, which raises the same errors.

    Returns
    -------
    SpectrumPlan
    """
    if floor is not None and not (
        isinstance(floor, (int, float, np.number)) and not isinstance(floor, bool) and 0 < floor < math.inf
    ):
        raise InputError(f"floor must be a positive power, such as 1e-12; got {floor!r}")
    check_precision(precision)
    only = None if floor is not None and precision == "double" else precision
    possible = candidates(request, floor, method)
    if method is not None and method not in {c.evaluator.method for c in possible}:
        raise InputError(_unavailable(request, method, precision))
    averaged = [replace(c, errors=c.errors.averaged(request.realizations, request.n)) for c in possible]
    weighed = [replace(candidate, against=_against(candidate, only, floor, method)) for candidate in averaged]
    fitting = sorted((c for c in weighed if not c.against), key=lambda c: c.cost.seconds)
    if not fitting:
        if floor is None or only not in {None, *(c.evaluator.precision for c in weighed)}:
            if devices_present():
                precision_of(precision)  # says what the device lacks
            raise InputError(_unavailable(request, method, precision))
        best = min(c.errors.resolvable for c in weighed if only in (None, c.evaluator.precision))
        raise InputError(
            f"floor={floor:g} is out of reach: the least power known to 1% here is {best:.1g}"
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


def candidates(request: SpectrumRequest, floor: float | None, method: str | None = None) -> list[Candidate]:
    """Gather every evaluator that this machine has for a request, with its cost and errors.

    Parameters
    ----------
    request, floor, method
        As in ``choose``.

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
        raise InputError(_no_room(request))
    return found


def check_precision(precision: object) -> None:
    """Refuse a precision other than "double" and "float" with an InputError."""
    if precision not in PRECISIONS:
        raise InputError(f'precision must be "double" or "float"; got {precision!r}')


def _no_room(request: SpectrumRequest) -> str:
    """Say why nothing serves a request: without a device, shells need a whole cube."""
    return (
        f"{request} do not fit in memory as a cube, and without an OpenCL device there is no streaming. "
        "Install one: gbnbench devices tells how"
    )


def _unavailable(request: SpectrumRequest, method: str | None, precision: str) -> str:
    """Say why a method does not serve a request, and which do."""
    serving = {kind.method: kind for kind in EVALUATORS if request.what in kind.serves}
    if method not in serving:
        return f"method must be one of {', '.join(serving)} for {request.what}; got {method!r}"
    return serving[method].why_not(request, precision)


def _against(candidate: Candidate, only: str | None, floor: float | None, method: str | None) -> str:
    """Say what speaks against a candidate: another precision, an error too large, or not being exact."""
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


def _si(value: float) -> str:
    """Three digits and an SI prefix: 1.23 G."""
    for prefix in ("", "k", "M", "G", "T", "P"):
        if value < 999.5:
            return f"{value:.3g} {prefix}"
        value /= 1000
    return f"{value:.3g} E"
