"""Vector widths that really work on a device, proved in a child process that may die of them.

The PoCL on PyPI announces 16 floats and 8 doubles as native on AVX-512 processors and kills the process that
uses them. Announced widths are therefore never trusted.
"""

from __future__ import annotations

import subprocess
import sys
from dataclasses import dataclass
from importlib import resources
from typing import Any

import numpy as np

from gbnbench.core.cache_folder import cache_folder, recall, remember
from gbnbench.core.process_end import cause_of_end
from gbnbench.opencl.device import Device, handle, import_pyopencl

SECONDS = 120
CANDIDATES = {"float": (1, 4, 8, 16), "double": (1, 2, 4, 8)}


@dataclass(frozen=True)
class VectorWidths:
    """Widest proven vectors.

    Attributes
    ----------
    float32, float64 : int
        Lanes; 0 where the precision does not work at all.
    fault : str
        What the child processes ended of where nothing was proven; empty where something was.
    """

    float32: int
    float64: int
    fault: str = ""


def _works(context: Any, queue: Any, precision: str, width: int) -> bool:
    """Tell whether vectors of this width compute what numpy does; a device may also kill the process here."""
    cl = import_pyopencl()
    real = np.dtype("float64" if precision == "double" else "float32")
    unsigned = np.dtype(f"u{real.itemsize}")
    a = np.linspace(0.1, 0.9, 16).astype(real)
    b = np.arange(1, 17, dtype=unsigned) * unsigned.type(2654435)
    flags = cl.mem_flags.READ_ONLY | cl.mem_flags.COPY_HOST_PTR
    device_a, device_b = (cl.Buffer(context, flags, hostbuf=array) for array in (a, b))
    out = cl.Buffer(context, cl.mem_flags.WRITE_ONLY, a.nbytes)
    kernels = resources.files("gbnbench.opencl") / "kernels"
    source = "\n".join((kernels / name).read_text() for name in ("vector.cl", "probe.cl"))
    try:
        program = cl.Program(context, source).build(
            [f"-D DOUBLE={int(precision == 'double')}", f"-D LANES={width}"],
            cache_dir=str(cache_folder() / "pyopencl"),
        )
        cl.Kernel(program, "probe")(queue, (1,), (1,), device_a, device_b, out)
        got = np.empty_like(a)
        cl.enqueue_copy(queue, got, out)
    except cl.Error:
        return False
    q = b + (b << unsigned.type(3))
    y = (q >> unsigned.type(4)).astype(np.float64)
    y = np.where(q & unsigned.type(1), y, -y)
    total = (a.astype(np.float64) * a[:4].sum(dtype=np.float64) + y)[:width]
    error = np.abs(got[:width] - (total - np.rint(total) + np.abs(a[:width])))
    error = np.minimum(error, np.abs(error - 1))  # a sum near a half may round either way
    return bool(np.all(error <= 16 * np.finfo(real).eps * np.abs(total).max()))


def _child(platform: int, device: int, precision: str) -> None:
    """Prove widths in ascending order and print each at once, so that the proven ones survive a crash."""
    cl = import_pyopencl()
    chosen = handle((platform, device))
    context = cl.Context([chosen])
    queue = cl.CommandQueue(context)
    for width in CANDIDATES[precision]:
        if _works(context, queue, precision, width):
            print(width, flush=True)


def _widest(device: Device, precision: str) -> tuple[int, str]:
    """Widest vector that a child process proved before it ended or died; 0 for none, with what it died of."""
    arguments = (*device.position, precision)
    call = f"from gbnbench.opencl.width_probe import _child; _child(*{arguments!r})"
    fault = ""
    try:
        child = subprocess.run(
            [sys.executable, "-c", call], capture_output=True, timeout=SECONDS, check=False
        )
        output: bytes | None = child.stdout
        if child.returncode != 0:
            fault = f"a kernel was tried in {precision}, and {cause_of_end(child.returncode, child.stderr)}"
    except subprocess.TimeoutExpired as late:
        output = late.stdout
        fault = f"a kernel was tried in {precision}, and its process gave no answer in {SECONDS} seconds"
    proven = (output or b"").split()
    widest = max((int(width) for width in proven if width.isdigit()), default=0)
    return widest, "" if widest else fault


def vector_widths(device: Device) -> VectorWidths:
    """Widest vectors proven on a device, cached for its driver and version."""
    known = recall(f"widths-{device.fingerprint}")
    if isinstance(known, dict) and set(known) == {"float32", "float64"}:
        return VectorWidths(**known)
    single, fault = _widest(device, "float")
    double, another = _widest(device, "double") if device.has_double else (0, "")
    found = VectorWidths(single, double, fault or another)
    if single and not found.fault:  # a process may die of what is mended later: ask again
        remember(f"widths-{device.fingerprint}", {"float32": single, "float64": double})
    return found
