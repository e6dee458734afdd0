"""Programs of kernels: their source, and how a kernel is launched."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from importlib import resources
from threading import Lock
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from gbnbench.opencl.runtime import Runtime

# A kernel object holds its arguments from the moment they are set until it is enqueued: one thread at a time.
LAUNCH = Lock()


class Program:
    """A built program, which holds one kernel object for each entry point."""

    def __init__(self, owner: Runtime, built: Any) -> None:
        self.owner = owner
        self._kernels = {kernel.function_name: kernel for kernel in built.all_kernels()}
        self._typed: set[str] = set()

    def run(self, name: str, global_size: Sequence[int], local_size: Sequence[int], *args: Any) -> None:
        """Enqueue a kernel.

        Parameters
        ----------
        name : str
            Entry point.
        global_size, local_size : sequences of int
            Work-items. The local size is always given, since without it PoCL uses one core.
        *args
            Buffers and numpy scalars of the kernel's own types, the same ones at every launch.
        """
        with LAUNCH:
            kernel = self._kernels[name]
            if name not in self._typed:
                # A number whose type pyopencl is not told is tried as a buffer first, which takes it 8 us.
                kernel.set_arg_types([arg.dtype if isinstance(arg, np.generic) else None for arg in args])
                self._typed.add(name)
            kernel(self.owner.queue, tuple(global_size), tuple(local_size), *args)


@cache
def source(package: str, files: tuple[str, ...]) -> str:
    """Join kernel files.

    Parameters
    ----------
    package : str
        Package whose ``kernels`` folder holds the files.
    files : tuple of str
        Names of files; one that begins with a slash is taken from gbnbench's own ``kernels``.

    Returns
    -------
    str
        OpenCL C, each file under its own ``#line``.
    """
    parts = []
    for name in files:
        home = "gbnbench.opencl" if name.startswith("/") else package
        text = (resources.files(home) / "kernels" / name.lstrip("/")).read_text()
        parts.append(f'#line 1 "{name.lstrip("/")}"\n{text}')
    return "\n".join(parts)
