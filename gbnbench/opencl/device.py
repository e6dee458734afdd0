"""OpenCL devices that are present, and the choice of one by the user's selector."""

from __future__ import annotations

import hashlib
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

from gbnbench.core.errors import DeviceError, NoRoomError
from gbnbench.core.writable_caches import lead_caches

if TYPE_CHECKING:
    import pyopencl as cl

DEVICE_VARIABLE = "GBNBENCH_DEVICE"
FOUND_VARIABLE = "GBNBENCH_DEVICE_FOUND"  # set for worker processes of one that has found a device
SHORT_OF_MEMORY = ("failed to map", "allocate memory")  # in the linker's words
_selector: ContextVar[str | None] = ContextVar("selector", default=None)

INSTALL = (
    'Install one: pip install "pyopencl[pocl]" brings a CPU device on Linux x86-64; elsewhere install the '
    "OpenCL runtime of your GPU or CPU's vendor, then run: gbnbench devices"
)


@dataclass(frozen=True)
class Device:
    """An OpenCL device as gbnbench sees it.

    Attributes
    ----------
    index : int
        Position in ``devices()``, by which the user may select it.
    name, platform, platform_version, version, driver : str
        As the runtime reports them; the platform version tells two PoCLs apart.
    is_cpu, has_double : bool
        Whether it is a CPU, and whether it computes in double precision.
    compute_units : int
        Cores or multiprocessors.
    position : (int, int)
        Indices of the platform and of the device in it.
    """

    index: int
    name: str
    platform: str
    platform_version: str
    version: str
    driver: str
    is_cpu: bool
    has_double: bool
    compute_units: int
    position: tuple[int, int]

    @property
    def label(self) -> str:
        """One line for tables and manifests."""
        return f"{self.name} ({self.platform}, {self.platform_version.strip()})"

    @property
    def fingerprint(self) -> str:
        """Short digest of device, driver and version, under which measurements of the device are cached."""
        text = "|".join((self.platform, self.platform_version, self.name, self.version, self.driver))
        return hashlib.sha256(text.encode()).hexdigest()[:16]

    def describe(self) -> dict[str, str]:
        """JSON-ready record for results."""
        return {
            "name": self.name,
            "platform": self.platform,
            "version": self.platform_version.strip(),
            "driver": self.driver,
        }


def import_pyopencl() -> Any:
    """Import pyopencl with cache folders that it and PoCL can write, or say what to install."""
    try:
        if "pyopencl" not in sys.modules:
            lead_caches()
    except OSError as error:
        raise NoRoomError(
            f"no folder takes the files of compiled kernels, up to 1 MiB ({error}). Make room, raise the "
            "limit on the size of files (ulimit -f) or set GBNBENCH_CACHE to a folder that can be written"
        ) from None
    try:
        import pyopencl
    except ImportError as error:
        if any(words in str(error) for words in SHORT_OF_MEMORY):
            raise NoRoomError(
                f"pyopencl cannot be loaded ({error}): give the process more memory (ulimit -v), or use "
                "fewer workers with --jobs"
            ) from None
        raise DeviceError(f"pyopencl cannot be imported ({error}). {INSTALL}") from None
    return pyopencl


def handle(position: tuple[int, int]) -> cl.Device:
    """Look up the pyopencl device at a (platform, device) position."""
    pyopencl = import_pyopencl()
    device: cl.Device = pyopencl.get_platforms()[position[0]].get_devices()[position[1]]
    return device


@cache
def devices() -> tuple[Device, ...]:
    """All OpenCL devices, in the order of platforms; empty where there is none.

    Raises
    ------
    DeviceError
        If pyopencl is not installed.
    NoRoomError
        If it, or a device, cannot be loaded for want of memory or of room for compiled kernels.
    """
    cl = import_pyopencl()
    try:
        platforms = cl.get_platforms()
    except cl.LogicError:  # the loader's way of saying that it knows no platform
        return ()
    except cl.MemoryError as error:
        raise NoRoomError(f"there is not enough memory to look for OpenCL devices ({error})") from None
    found: list[Device] = []
    for i, platform in enumerate(platforms):
        try:
            present = platform.get_devices()
        except cl.MemoryError as error:
            raise NoRoomError(f"{platform.name.strip()} has not enough memory to start ({error})") from None
        except cl.Error:
            continue
        for j, device in enumerate(present):
            found.append(
                Device(
                    index=len(found),
                    name=device.name.strip(),
                    platform=platform.name.strip(),
                    platform_version=platform.version,
                    version=device.version.strip(),
                    driver=device.driver_version.strip(),
                    is_cpu=bool(device.type & cl.device_type.CPU),
                    has_double="cl_khr_fp64" in device.extensions.split() or bool(device.double_fp_config),
                    compute_units=device.max_compute_units,
                    position=(i, j),
                )
            )
    return tuple(found)


def devices_present() -> bool:
    """Whether there is any device; where there is none, spectra are left to numpy.

    Raises
    ------
    NoRoomError
        If kernels cannot be compiled for want of room or memory, or this is a worker process and finds no
        device where its parent found one: numpy's last digits would differ from those of another worker, or
        of an earlier part of the same run.
    """
    try:
        present = bool(devices())
    except NoRoomError:
        raise
    except DeviceError:
        present = False
    if not present and os.environ.get(FOUND_VARIABLE):
        raise NoRoomError(
            "a worker process finds no OpenCL device where the process that started it found one. If memory "
            "is limited, give it more, or use fewer workers with --jobs"
        )
    return present


def found_already() -> bool:
    """Whether this process has looked for devices and found one; it does not look now."""
    return devices.cache_info().currsize > 0 and bool(devices())


@contextmanager
def use_device(selector: str | None) -> Iterator[None]:
    """Let ``choose`` pick a device within a ``with`` block, and in the worker processes that start there.

    Parameters
    ----------
    selector : str or None
        As in ``choose``; None changes nothing.

    Raises
    ------
    DeviceError
        At once, if there is no device, or the selector fits none or several.
    """
    if selector is None:
        yield
        return
    token = _selector.set(str(choose(selector).index))
    try:
        yield
    finally:
        _selector.reset(token)


def selected() -> str:
    """Return the selector in force: that of ``use_device``, else ``$GBNBENCH_DEVICE``, else an empty text."""
    return _selector.get() or os.environ.get(DEVICE_VARIABLE, "")


def choose(selector: str | None = None) -> Device:
    """Pick a device.

    Parameters
    ----------
    selector : str, optional
        An index of ``devices()``, or part of a device's name, platform or platform version, in any case;
        without it that of ``use_device`` or ``$GBNBENCH_DEVICE``, else the best found: double precision
        first, then GPUs.

    Returns
    -------
    Device

    Raises
    ------
    DeviceError
        If there is no device, or the selector fits none or several.
    """
    if selector is not None and not isinstance(selector, str):
        raise DeviceError(f"device must be a text, an index such as '0' or part of a name; got {selector!r}")
    present = devices()
    if not present:
        raise DeviceError(f"no OpenCL device found. {INSTALL}")
    wanted = selected() if selector is None else selector
    if not wanted.strip():
        return min(present, key=lambda d: (not d.has_double, d.is_cpu, d.index))
    fitting = [d for d in present if wanted.strip() == str(d.index)] or [
        d for d in present if wanted.strip().lower() in d.label.lower()
    ]
    if len(fitting) != 1:
        listing = "; ".join(f"{d.index}: {d.label}" for d in fitting or present)
        fault = "fits several devices" if fitting else "fits no device"
        raise DeviceError(f"device {wanted!r} {fault}: {listing}. Give one index, or more of the name")
    return fitting[0]
