"""The OpenCL device of a run: checked in the workers, before other work, and the same in all of them."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable
from contextlib import AbstractContextManager

from gbnbench.core.errors import DeviceError
from gbnbench.doctor.trust import ensure_trusted
from gbnbench.execution.calls import Calls
from gbnbench.execution.executor_choice import chosen_executor
from gbnbench.execution.progress import Progress
from gbnbench.execution.remote_call import here
from gbnbench.opencl import choose, devices_present
from gbnbench.opencl.device import DEVICE_VARIABLE, selected

MOST_ASKED = 8  # workers on other machines
Device = dict[str, str]


def prove_device_if_any(
    calls: Calls, progress: Progress, total: int, done: int, meanwhile: Callable[[], None] | None = None
) -> None:
    """Let a worker here check the OpenCL device, if there is one: a bad driver kills only that worker.

    Parameters
    ----------
    calls : Calls
        Without other work.
    progress : Progress
        Told of the check.
    total, done : int
        Steps of the work that follows, and how many of them are finished.
    meanwhile : callable, optional
        Called while the worker is at it.

    Raises
    ------
    DeviceError
        If there is a device and it cannot be used.
    """
    if not devices_present():
        return
    choose()
    progress.start(total, done, "checking the device (kernels of a new one are compiled, once)")
    calls.submit(None, ensure_trusted)
    if meanwhile is not None:
        meanwhile()
    if failure := calls.next().failure:
        raise DeviceError(f"the OpenCL device cannot be used: {failure}")


def proven_calls(jobs: int, calls: int, prove_device: bool) -> AbstractContextManager[Calls]:
    """Take calls by the executor in force.

    Parameters
    ----------
    jobs : int
        Workers to start, where their number is chosen here.
    calls : int
        How many calls are known to come.
    prove_device : bool
        Whether workers elsewhere have to prove their device before their first call.

    Returns
    -------
    context of Calls
    """
    chosen = chosen_executor()
    if not chosen.remote:
        return chosen.calls(max(1, min(jobs, calls)))
    return chosen.calls(jobs, (unfit, run_device(jobs), selected()) if prove_device else None)


def run_device(jobs: int) -> Device | None:
    """Describe the device on which a run is made: that of this process, or of the executor's workers.

    Parameters
    ----------
    jobs : int
        Workers to start, where their number is chosen here.

    Returns
    -------
    dict of str or None
        As ``Device.describe`` gives it; None where there is none. Of workers with several, what most have.

    Raises
    ------
    DeviceError
        If no worker can tell.
    UnfinishedError
        If no worker can be reached, or none can serve.
    """
    chosen = chosen_executor()
    if not chosen.remote:
        return device_here("")
    if "device" not in chosen.facts:
        with chosen.waiting(), chosen.calls(jobs) as calls:
            asked = min(chosen.workers(jobs).count, MOST_ASKED)
            for k in range(asked):
                calls.submit(k, device_here, selected())
            told = [calls.next() for _ in range(asked)]
        found = Counter(tuple(one.value.items()) for one in told if one.value)
        if not found and all(one.failure for one in told):
            raise DeviceError(f"no worker can tell its device: {told[0].failure}")
        chosen.facts["device"] = dict(found.most_common(1)[0][0]) if found else None
    device: Device | None = chosen.facts["device"]
    return device


def needed_device(jobs: int) -> Device:
    """Describe the device of a run as ``run_device`` does; raises DeviceError where there is none."""
    device = run_device(jobs)
    if device is None and chosen_executor().remote:
        raise DeviceError("no worker has an OpenCL device, and the comparison needs one there")
    return device or choose().describe()


def device_here(selector: str) -> Device | None:
    """Describe the device of this process, chosen by a selector if one is given; None where there is none."""
    if selector:
        os.environ[DEVICE_VARIABLE] = selector
    return choose().describe() if devices_present() else None


def unfit(expected: Device | None, selector: str) -> str:
    """Tell, in a worker, why it cannot take part in a run.

    Parameters
    ----------
    expected : dict of str or None
        The device of the run: on another one the last digits would differ.
    selector : str
        As in ``GBNBENCH_DEVICE``.

    Returns
    -------
    str
        Empty if it can.
    """
    try:
        found = device_here(selector)
        if found == expected:
            if found is not None:
                ensure_trusted()
            return ""
    except DeviceError as error:
        return f"{here()} cannot use its OpenCL device: {error}"
    has, wanted = (
        f"computes by {d['name']} ({d['platform']} {d['version']})" if d else "" for d in (found, expected)
    )
    return (
        f"{here()} {has or 'has no OpenCL device'}, and this run {wanted or 'is made without one'}: "
        "last digits would differ"
    )
