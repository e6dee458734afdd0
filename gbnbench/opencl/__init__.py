"""OpenCL made safe: the choice of a device, proven vector widths, programs built once, buffers held."""

from gbnbench.opencl.device import DEVICE_VARIABLE, Device, choose, devices, devices_present, use_device
from gbnbench.opencl.program import Launch, Program, RepeatedLaunch
from gbnbench.opencl.runtime import Runtime, runtime

__all__ = [
    "DEVICE_VARIABLE",
    "Device",
    "Launch",
    "Program",
    "RepeatedLaunch",
    "Runtime",
    "choose",
    "devices",
    "devices_present",
    "runtime",
    "use_device",
]
