"""Cost of an evaluation: work, memory and time."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class EvaluationCost:
    """Work, memory and time of an evaluation.

    Attributes
    ----------
    flops : float
        Additions and multiplications of all that it does.
    bytes : int
        Memory where it needs most.
    seconds : float
        Expected time on all cores of the device.
    """

    flops: float
    bytes: int
    seconds: float
