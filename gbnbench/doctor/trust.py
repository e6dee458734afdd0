"""The trust in a device that passed the checks of the kernels, remembered for its driver and our version."""

from __future__ import annotations

import gbnbench
from gbnbench.core.cache_folder import recall, remember
from gbnbench.core.errors import DeviceError
from gbnbench.opencl import runtime


def ensure_trusted() -> None:
    """Examine the chosen device quickly, once for each device, driver and version of ours, and remember.

    Raises
    ------
    DeviceError
        If there is no device, or a kernel departs from numpy on it.
    """
    device = runtime().device
    key = f"trusted-{gbnbench.__version__}-{device.fingerprint}"
    if recall(key) is True:
        return
    from gbnbench.doctor.examination import examine  # it loads the kernels of every generator

    examination = examine(quick=True)
    if not examination.trusted:
        raise DeviceError(examination.verdict)
    remember(key, True)
