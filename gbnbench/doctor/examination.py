"""The examination of a device by all checks of the kernels, in this process or in one of its own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gbnbench.doctor.check import Check
from gbnbench.doctor.kernel_checks import KernelChecks, planned_checks
from gbnbench.execution.calls import Calls
from gbnbench.execution.worker_pool import Pool
from gbnbench.opencl import Device, choose


@dataclass(frozen=True)
class Examination:
    """All checks of one device.

    Attributes
    ----------
    device : Device
        Which.
    checks : tuple of Check
        In the order tried.
    """

    device: Device
    checks: tuple[Check, ...]

    @property
    def trusted(self) -> bool:
        """Whether every check passed."""
        return all(check.passed for check in self.checks)

    @property
    def verdict(self) -> str:
        """One sentence for the user."""
        failed = sorted({check.kernel for check in self.checks if not check.passed})
        if failed:
            return (
                f"do not trust {self.device.label}: {', '.join(failed)} departs from numpy. Choose another "
                "device (gbnbench devices), or update its driver and run gbnbench doctor again"
            )
        precisions = " and ".join(sorted({check.precision for check in self.checks}))
        return (
            f"{self.device.label} can be trusted: {len(self.checks)} checks in {precisions} agree with numpy"
        )


def examine(quick: bool = False) -> Examination:
    """Try every kernel on the chosen device, in this process.

    Parameters
    ----------
    quick : bool
        Fewer sizes: a second or two.

    Returns
    -------
    Examination

    Raises
    ------
    DeviceError
        If there is no device.
    """
    device = choose()
    checks = [check for planned in planned_checks(quick, device) for check in carried_out(*planned)]
    return Examination(device, tuple(checks))


def examine_apart(quick: bool = False) -> Examination:
    """Try every kernel on the chosen device, in a process that a wrong kernel may take down with it.

    Parameters, returns and what is raised are those of ``examine``.
    """
    device = choose()
    planned = planned_checks(quick, device)
    checks: list[Check] = []
    with Pool(1, {}) as pool:
        calls = Calls(pool, tries=1)
        for function, case, precision in planned:
            calls.submit(None, carried_out, function, case, precision)
            done = calls.next()
            checks.extend(done.value or [_not_tried(function, case, precision, done.failure)])
    return Examination(device, tuple(checks))


def carried_out(function: KernelChecks, case: tuple[float, ...], precision: str) -> list[Check]:
    """Carry out checks; an exception of any kind is a check that failed.

    Parameters
    ----------
    function : callable
        As ``planned_checks`` lists it.
    case : tuple
        Its sizes.
    precision : {"double", "float"}
        The precision.

    Returns
    -------
    list of Check
    """
    try:
        return list(function(*case, precision))
    except Exception as error:
        return [_not_tried(function, case, precision, f"{type(error).__name__}: {error}")]


def _not_tried(function: KernelChecks, case: tuple[float, ...], precision: str, why: str) -> Check:
    """Make the check that failed because it could not be carried out to its end."""
    name = function.__name__.strip("_").replace("_", " ")
    return Check(name, " ".join(f"{value:g}" for value in case), precision, np.inf, 0.0, why)
