"""Programs of kernels: their source, how it is built, and how a kernel is launched."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from importlib import resources
from threading import Lock
from typing import TYPE_CHECKING, Any

import numpy as np

from gbnbench.core.cache_folder import cache_folder
from gbnbench.core.errors import DeviceError
from gbnbench.opencl.device import import_pyopencl

if TYPE_CHECKING:
    from gbnbench.opencl.runtime import Runtime

# Safe everywhere it was tried; -cl-fast-relaxed-math and -cl-unsafe-math-optimizations give wrong gradients.
OPTIONS = ("-cl-std=CL1.2", "-cl-mad-enable", "-cl-finite-math-only")

# A kernel object holds its arguments from the moment they are set until it is enqueued: one thread at a time.
LAUNCH = Lock()


class Program:
    """A built program, which holds one kernel object for each entry point."""

    def __init__(self, owner: Runtime, built: Any) -> None:
        self.owner, self._built = owner, built
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
                kernel.set_arg_types(_types(args))
                self._typed.add(name)
            kernel(self.owner.queue, tuple(global_size), tuple(local_size), *args)

    def prepared(
        self, name: str, global_size: Sequence[int], local_size: Sequence[int], *args: Any
    ) -> Launch:
        """Make a launch whose arguments stay set, for one thread.

        Parameters
        ----------
        name, global_size, local_size
            As in ``run``.
        *args
            As in ``run``; those that each call gives come first: None for a buffer, its type for a number.

        Returns
        -------
        Launch
        """
        kernel = import_pyopencl().Kernel(self._built, name)
        kernel.set_arg_types(_types(args))
        for index, arg in enumerate(args):
            if arg is not None and not isinstance(arg, type):
                kernel.set_arg(index, arg)
        return Launch(self.owner, kernel, tuple(global_size), tuple(local_size), args)


@dataclass(frozen=True)
class Launch:
    """A kernel object of its own whose arguments are set, but for the first ones, which each call gives.

    Attributes
    ----------
    owner : Runtime
        The device.
    kernel
        The pyopencl object.
    global_size, local_size : tuple of int
        Work-items.
    held : tuple
        The arguments, so that their buffers live as long as the launch.
    numbers : dict of int to number
        Numbers that were given, by position. They are set again only where they change, since a number takes
        8 us and a buffer .2 us.
    """

    owner: Runtime
    kernel: Any
    global_size: tuple[int, ...]
    local_size: tuple[int, ...]
    held: tuple[Any, ...]
    numbers: dict[int, Any] = field(default_factory=dict)

    def __call__(self, *arguments: Any) -> None:
        """Enqueue the kernel with these buffers and numbers as its first arguments."""
        for index, argument in enumerate(arguments):
            if isinstance(argument, np.generic):
                if self.numbers.get(index) == argument:
                    continue
                self.numbers[index] = argument
            self.kernel.set_arg(index, argument)
        self.owner.enqueue(self.kernel, self.global_size, self.local_size)


class RepeatedLaunch:
    """A launch that may be the only one of its kind, or one of many, for one thread.

    To set the numbers among the arguments once and for all takes as long as five launches, so that only the
    second call does it.

    Parameters
    ----------
    program : Program
        The program.
    name, global_size, local_size, *args
        As in ``Program.prepared``.
    """

    def __init__(
        self, program: Program, name: str, global_size: Sequence[int], local_size: Sequence[int], *args: Any
    ) -> None:
        self._program, self._of, self._args = program, (name, global_size, local_size), args
        self._prepared: Launch | None = None
        self._called = False

    def __call__(self, *arguments: Any) -> None:
        """Enqueue the kernel with these buffers and numbers as its first arguments."""
        if not self._called:
            self._called = True
            self._program.run(*self._of, *arguments, *self._args[len(arguments) :])
            return
        if self._prepared is None:
            self._prepared = self._program.prepared(*self._of, *self._args)
        self._prepared(*arguments)


def _types(args: Sequence[Any]) -> list[Any]:
    """Types of numbers, None for buffers: a number of no known type is tried as a buffer first, for 8 us."""
    return [
        np.dtype(arg) if isinstance(arg, type) else arg.dtype if isinstance(arg, np.generic) else None
        for arg in args
    ]


def build(owner: Runtime, package: str, files: tuple[str, ...], defines: Mapping[str, object]) -> Program:
    """Build kernel files for a device, or take from pyopencl's folder what was built for it before.

    Parameters
    ----------
    owner : Runtime
        The device.
    package, files
        As in ``source``.
    defines : mapping
        ``-D`` macros.

    Returns
    -------
    Program

    Raises
    ------
    DeviceError
        If the compiler refuses; its log is in the text.
    """
    cl = import_pyopencl()
    options = [*OPTIONS, *(f"-D {name}={value}" for name, value in defines.items())]
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", cl.CompilerWarning)
            built = cl.Program(owner.context, source(package, files)).build(
                options, cache_dir=str(cache_folder() / "pyopencl")
            )
    except cl.RuntimeError as error:
        raise DeviceError(f"{owner.device.label} cannot build {', '.join(files)}: {error}") from None
    return Program(owner, built)


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
