"""OpenCL devices and runtimes: the choice of a device, proven vector widths, programs built once, buffers."""

from gbnbench.opencl.device import DEVICE_VARIABLE, Device, choose, devices, devices_present
from gbnbench.opencl.runtime import Program, Runtime, runtime

__all__ = [
    "DEVICE_VARIABLE",
    "Device",
    "Program",
    "Runtime",
    "choose",
    "devices",
    "devices_present",
    "runtime",
]
