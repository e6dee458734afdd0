"""The finding of one check of a kernel."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Check:
    """One kernel at one size and precision against numpy.

    Attributes
    ----------
    kernel, size, precision : str
        What was tried.
    error, allowed : float
        Largest departure and its bound, in the units of the kernel's own check.
    fault : str
        Why it could not be tried at all; empty where it ran.
    """

    kernel: str
    size: str
    precision: str
    error: float
    allowed: float
    fault: str = ""

    @property
    def passed(self) -> bool:
        """Whether the kernel may be trusted here."""
        return not self.fault and self.error <= self.allowed
