"""The plan of a spectrum: the evaluator that was chosen for a request, why, and the others."""

from __future__ import annotations

from dataclasses import dataclass, field

from gbnbench.analysis.spectrum.candidates import Candidate
from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.request import SpectrumRequest


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


def _si(value: float) -> str:
    """Format a number with three digits and an SI prefix, such as "1.23 G"."""
    for prefix in ("", "k", "M", "G", "T", "P"):
        if value < 999.5:
            return f"{value:.3g} {prefix}"
        value /= 1000
    return f"{value:.3g} E"
