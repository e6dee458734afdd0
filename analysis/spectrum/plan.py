"""The plan of a spectrum: the cheapest evaluator that is exact enough for a request, and the reason."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from gbnbench.analysis.precision import PrecisionName, precision_of
from gbnbench.analysis.spectrum.candidates import (
    Candidate,
    candidates,
    check_precision,
    no_room,
    objection,
    unavailable,
)
from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.protocol import Evaluator
from gbnbench.analysis.spectrum.evaluators.registry import EVALUATORS
from gbnbench.analysis.spectrum.limits import check_fmax
from gbnbench.analysis.spectrum.request import SpectrumRequest, shell_request
from gbnbench.core.errors import InputError
from gbnbench.opencl import devices_present, use_device


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
        """Word of the chosen evaluator, such as "product"."""
        return self.chosen.evaluator.method

    @property
    def precision(self) -> str:
        """Precision of the chosen evaluator, "double" or "float"."""
        return self.chosen.evaluator.precision

    @property
    def flops(self) -> float:
        """Number of arithmetic operations."""
        return self.chosen.cost.flops

    @property
    def bytes(self) -> int:
        """Memory that it needs, in bytes."""
        return self.chosen.cost.bytes

    @property
    def seconds(self) -> float:
        """Expected time, in seconds."""
        return self.chosen.cost.seconds

    @property
    def errors(self) -> Errors:
        """Errors of the square root of the mean power, for points that are not known yet."""
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
        raise InputError(no_room(request))
    return exact[0] if len(exact) == 1 else min(exact, key=lambda evaluator: evaluator.work(request))


def planned(
    request: SpectrumRequest, precision: str, floor: float | None, method: str | None = None
) -> SpectrumPlan:
    """Weigh every evaluator that could serve a request.

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
    SpectrumPlan

    Raises
    ------
    InputError
        If precision is unknown, nothing resolves the floor, or there is no such method for the request.
    DeviceError
        If the device lacks the precision.
    """
    if floor is not None and not (
        isinstance(floor, (int, float, np.number)) and not isinstance(floor, bool) and 0 < floor < math.inf
    ):
        raise InputError(f"floor must be a positive power, such as 1e-12; got {floor!r}")
    check_precision(precision)
    only = None if floor is not None and precision == "double" else precision
    possible = candidates(request, floor, method)
    if method is not None and method not in {c.evaluator.method for c in possible}:
        raise InputError(unavailable(request, method, precision))
    averaged = [replace(c, errors=c.errors.averaged(request.realizations, request.n)) for c in possible]
    weighed = [
        replace(candidate, against=objection(candidate, only, floor, method)) for candidate in averaged
    ]
    fitting = sorted((c for c in weighed if not c.against), key=lambda c: c.cost.seconds)
    if not fitting:
        if floor is None or only not in {None, *(c.evaluator.precision for c in weighed)}:
            if devices_present():
                precision_of(precision)  # says what the device lacks
            raise InputError(unavailable(request, method, precision))
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


def _si(value: float) -> str:
    """Format a number with three digits and an SI prefix, such as "1.23 G"."""
    for prefix in ("", "k", "M", "G", "T", "P"):
        if value < 999.5:
            return f"{value:.3g} {prefix}"
        value /= 1000
    return f"{value:.3g} E"
