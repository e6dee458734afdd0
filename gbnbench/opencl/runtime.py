"""A context and queue on the chosen device, with programs built once for each set of definitions."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from functools import cache, cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gbnbench.core.errors import DeviceError
from gbnbench.opencl.device import Device, choose, handle, import_pyopencl
from gbnbench.opencl.program import Program, build
from gbnbench.opencl.width_probe import VectorWidths, vector_widths


class Runtime:
    """One device ready to compute.

    Attributes
    ----------
    device : Device
        The device.
    context, queue
        pyopencl objects; the queue runs in order.
    process : int
        Process that opened it; forks of that process must not use it.
    """

    def __init__(self, device: Device) -> None:
        cl = import_pyopencl()
        self._cl = cl
        self.device = device
        self.process = os.getpid()
        self.context = cl.Context([handle(device.position)])
        self.queue = cl.CommandQueue(self.context)
        self._programs: dict[tuple[object, ...], Program] = {}

    @cached_property
    def widths(self) -> VectorWidths:
        """Proven vector widths on a CPU; one lane a work-item elsewhere."""
        if not self.device.is_cpu:
            return VectorWidths(1, 1 if self.device.has_double else 0)
        return vector_widths(self.device)

    @cached_property
    def largest_buffer(self) -> int:
        """Bytes of the largest buffer that the device gives."""
        return int(handle(self.device.position).max_mem_alloc_size)

    @cached_property
    def local_bytes(self) -> int:
        """Bytes of local memory that a work-group has."""
        return int(handle(self.device.position).local_mem_size)

    def lanes(self, precision: str) -> int:
        """Vector width for precision, "float" or "double".

        Raises
        ------
        DeviceError
            If the device cannot compute in that precision.
        """
        lanes = self.widths.float64 if precision == "double" else self.widths.float32
        if lanes == 0:
            widths = self.widths
            fault = f" ({widths.fault})" if widths.fault else ""
            other = ' or precision="float" where a power floor of 1e-13 suffices' if widths.float32 else ""
            raise DeviceError(
                f"{self.device.label} does not compute in {precision}{fault}; choose another device "
                f"(gbnbench devices){other}"
            )
        return lanes

    @property
    def group(self) -> int:
        """Work-group size: 1 where work-items are vectors already, a wavefront's worth on a GPU."""
        return 1 if self.device.is_cpu else 64

    def program(
        self, package: str, files: Sequence[str], defines: Mapping[str, object] | None = None
    ) -> Program:
        """Build kernel files, once for each set of definitions.

        Parameters
        ----------
        package : str
            Package whose ``kernels`` folder holds the files, such as ``gbnbench.analysis``; a file name that
            begins with a slash is taken from gbnbench's own ``kernels``.
        files : sequence of str
            Joined in this order, each under its own ``#line``.
        defines : mapping, optional
            ``-D`` macros.

        Returns
        -------
        Program
            Built by the first call, the same object in later ones.

        Raises
        ------
        DeviceError
            If the compiler refuses; its log is in the text.
        """
        key = (package, tuple(files), tuple(sorted((defines or {}).items(), key=str)))
        if key not in self._programs:
            self._programs[key] = build(self, package, tuple(files), defines or {})
        return self._programs[key]

    def enqueue(self, kernel: Any, global_size: tuple[int, ...], local_size: tuple[int, ...]) -> None:
        """Enqueue a kernel whose arguments are set.

        Parameters
        ----------
        kernel : pyopencl.Kernel
            The kernel.
        global_size, local_size : tuple of int
            Work-items, as in ``Program.run``.
        """
        self._cl.enqueue_nd_range_kernel(self.queue, kernel, global_size, local_size)

    def upload(self, array: NDArray[Any]) -> Any:
        """Copy an array to a new device buffer."""
        flags = self._cl.mem_flags.READ_WRITE | self._cl.mem_flags.COPY_HOST_PTR
        return self._cl.Buffer(self.context, flags, hostbuf=np.ascontiguousarray(array))

    def empty(self, nbytes: int) -> Any:
        """Make an uninitialised device buffer.

        Raises
        ------
        DeviceError
            If the device has no such memory.
        """
        if nbytes > self.largest_buffer:
            raise DeviceError(
                f"{self.device.label} gives buffers of at most {self.largest_buffer} bytes; "
                f"{nbytes} were needed"
            )
        return self._cl.Buffer(self.context, self._cl.mem_flags.READ_WRITE, max(int(nbytes), 1))

    def shared(self, array: NDArray[Any]) -> Any:
        """Make a buffer of a host array's own memory, which a CPU device reads and writes in place.

        Parameters
        ----------
        array : array
            C-contiguous; it must live as long as the buffer.

        Returns
        -------
        pyopencl.Buffer
        """
        flags = self._cl.mem_flags.READ_WRITE | self._cl.mem_flags.USE_HOST_PTR
        return self._cl.Buffer(self.context, flags, hostbuf=array)

    def readable(self, array: NDArray[Any]) -> Any:
        """Make a buffer that kernels read an array from: on a CPU the array's own memory, else a copy.

        Parameters
        ----------
        array : array
            It must not change as long as kernels read the buffer. One that is not contiguous is copied.

        Returns
        -------
        pyopencl.Buffer
        """
        flags = self._cl.mem_flags
        how = flags.USE_HOST_PTR if self.device.is_cpu else flags.COPY_HOST_PTR
        return self._cl.Buffer(
            self.context, flags.READ_ONLY | how, hostbuf=np.require(array, requirements=("C", "A"))
        )

    def local(self, nbytes: int) -> Any:
        """Ask for local memory of a work-group, at most ``local_bytes``, as an argument of a kernel."""
        return self._cl.LocalMemory(int(nbytes))

    def download(self, buffer: Any, out: NDArray[Any]) -> NDArray[Any]:
        """Copy the beginning of a buffer to the host, after the kernels before it have ended.

        Parameters
        ----------
        buffer : pyopencl.Buffer
            Source.
        out : array
            Destination, which is filled.

        Returns
        -------
        array
            ``out``.
        """
        self._cl.enqueue_copy(self.queue, out, buffer)
        return out

    def update(self, buffer: Any, array: NDArray[Any], offset: int = 0) -> None:
        """Copy an array into an existing buffer.

        Parameters
        ----------
        buffer : pyopencl.Buffer
            Destination.
        array : array
            Source.
        offset : int
            First byte of the buffer that is overwritten.
        """
        self._cl.enqueue_copy(self.queue, buffer, np.ascontiguousarray(array), dst_offset=offset)

    def clear(self, buffer: Any, nbytes: int) -> None:
        """Fill the beginning of a buffer with zeros.

        Parameters
        ----------
        buffer : pyopencl.Buffer
            Destination.
        nbytes : int
            Bytes to fill, a multiple of 4.
        """
        self._cl.enqueue_fill_buffer(self.queue, buffer, np.uint32(0), 0, nbytes)

    def finish(self) -> None:
        """Wait for all that was enqueued."""
        self.queue.finish()


@cache
def _open(device: Device) -> Runtime:
    return Runtime(device)


def runtime() -> Runtime:
    """Open the device that ``choose`` picks, once a process.

    Raises
    ------
    DeviceError
        If there is no such device, or it was opened before this process was forked.
    """
    opened = _open(choose())
    if os.getpid() != opened.process:
        raise DeviceError(
            "an OpenCL device that was used before a fork cannot be used after it: start workers by spawn, "
            'multiprocessing.get_context("spawn")'
        )
    return opened
