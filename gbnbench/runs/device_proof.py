"""The check of the OpenCL device in a worker, before other work: a bad driver kills only that worker."""

from __future__ import annotations

from collections.abc import Callable

from gbnbench.core.errors import DeviceError
from gbnbench.doctor.trust import ensure_trusted
from gbnbench.execution.progress import Progress
from gbnbench.execution.worker_pool import Pool
from gbnbench.opencl import choose, devices_present


def prove_device_if_any(
    pool: Pool, progress: Progress, total: int, done: int, meanwhile: Callable[[], None] | None = None
) -> None:
    """Let a worker check the OpenCL device, if there is one.

    Parameters
    ----------
    pool : Pool
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
    pool.submit(None, ensure_trusted)
    if meanwhile is not None:
        meanwhile()
    if failure := pool.next().failure:
        raise DeviceError(f"the OpenCL device cannot be used: {failure}")
