"""Peak rate of multiply-adds of a device, and the time that a kernel launch takes, both measured."""

from __future__ import annotations

import time
from collections.abc import Callable

import numpy as np

from gbnbench.core.cache_folder import recall, remember
from gbnbench.core.errors import DeviceError, InputError
from gbnbench.opencl.program import Program
from gbnbench.opencl.runtime import Runtime
from gbnbench.opencl.runtime import runtime as open_runtime

CHAINS = 10  # two multiply-adds a cycle, each four or five cycles long
FEW, MANY = 1 << 16, 1 << 22  # steps of a chain; MANY counts exactly in float
RISE = 2.0**-20  # what a step adds
SECONDS = 0.005  # of one run
RUNS = 7
LAUNCHES = 200
ITEMS = 2048  # work-items of a GPU's compute unit, so that it is full


def fma_peak(precision: str, runtime: Runtime | None = None) -> float:
    """Measure the peak rate of multiply-adds of a device.

    Parameters
    ----------
    precision : {"double", "float"}
        Precision of the multiply-adds.
    runtime : Runtime, optional
        The device; by default the chosen one.

    Returns
    -------
    float
        Flops a second, two a multiply-add: of one core of a CPU, by CPU time; of a whole GPU, by wall time.

    Raises
    ------
    InputError
        If precision is neither of the two.
    DeviceError
        If there is no device, it has no such precision, or it adds up wrong.

    Notes
    -----
    The best of seven runs of up to 5 ms counts. Each of ten accumulators repeats y <- y a + b with a = 1 and
    b = 2^-20, which the compiler cannot know, so that the sums can be checked exactly.
    """
    if precision not in ("double", "float"):
        raise InputError(f'precision must be "double" or "float"; got {precision!r}')
    run = _Chains(runtime or open_runtime(), precision)
    run(FEW)
    steps = min(MANY, max(FEW, int(FEW * SECONDS / _least(lambda: run(FEW), 3, run.clock))))
    taken = _least(lambda: run(steps), RUNS, run.clock)
    run.check(steps)
    return run.flops(steps) / taken


def peak(precision: str) -> float:
    """Peak rate of the chosen device by ``fma_peak``, measured once and then cached.

    Raises
    ------
    InputError, DeviceError
        As ``fma_peak``.
    """
    return _remembered(f"peak-{precision}", lambda: max(fma_peak(precision) for _ in range(3)))


def launch_seconds() -> float:
    """Time to launch an empty kernel on the chosen device and wait for it, measured once and then cached.

    Returns
    -------
    float
        CPU seconds; wall seconds on a GPU.

    Raises
    ------
    DeviceError
        If there is no device.
    """
    return _remembered("typed-launch", _launch)


def _launch() -> float:
    run = _Chains(open_runtime(), "float", full=False)

    def launches() -> None:
        for _ in range(LAUNCHES):
            run(0)

    launches()
    return _least(launches, 3, run.clock) / LAUNCHES


def _remembered(name: str, measure: Callable[[], float]) -> float:
    key = f"{name}-{open_runtime().device.fingerprint}"
    known = recall(key)
    if isinstance(known, float) and 0 < known < float("inf"):
        return known
    found = measure()
    remember(key, found)
    return found


def _least(call: Callable[[], None], times: int, clock: Callable[[], float]) -> float:
    taken = []
    for _ in range(times):
        began = clock()
        call()
        taken.append(clock() - began)
    return max(min(taken), 1e-7)


class _Chains:
    """The kernel with its buffers; called with a number of steps it runs and waits."""

    def __init__(self, runtime: Runtime, precision: str, full: bool = True) -> None:
        self._runtime = runtime
        self._lanes = runtime.lanes(precision)
        self._real = np.float64 if precision == "double" else np.float32
        cpu = runtime.device.is_cpu
        self.clock = time.process_time if cpu else time.perf_counter
        items = runtime.device.compute_units * ITEMS if full and not cpu else runtime.group
        self._items = -(-items // runtime.group) * runtime.group
        self._program: Program = runtime.program(
            "gbnbench.opencl",
            ("/vector.cl", "/fma.cl"),
            {"DOUBLE": int(precision == "double"), "LANES": self._lanes, "CHAINS": CHAINS},
        )
        self._factors = runtime.upload(np.repeat(np.array([1, RISE, 1], self._real), self._lanes))
        self._sums = np.empty(self._items * self._lanes, self._real)
        self._out = runtime.empty(self._sums.nbytes)

    def flops(self, steps: int) -> float:
        """Flops of a run."""
        return 2.0 * CHAINS * self._lanes * self._items * steps

    def __call__(self, steps: int) -> None:
        self._program.run(
            "fma_chains", (self._items,), (self._runtime.group,), self._factors, self._out, np.uint32(steps)
        )
        self._runtime.finish()

    def check(self, steps: int) -> None:
        """Compare the last run's sums with what they must be, or say that they are wrong."""
        self._runtime.download(self._out, self._sums)
        expected = CHAINS * (1 + steps * RISE) + sum(range(CHAINS)) / 16
        if not np.allclose(self._sums, expected, rtol=1e-6, atol=0):
            raise DeviceError(
                f"{self._runtime.device.label} adds up wrong: {self._sums[0]} instead of {expected}. Run: "
                "gbnbench doctor"
            )
