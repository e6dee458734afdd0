"""Throughput of two cores over that of one: the same sets in processes that PoCL holds to some threads."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from dataclasses import dataclass

import numpy as np

from gbnbench.core.errors import DeviceError
from gbnbench.opencl import DEVICE_VARIABLE, runtime

VARIABLE = "POCL_MAX_PTHREAD_COUNT"
N, D, F, SETS = 1024, 2, 64, 16
PATIENCE = 120.0  # seconds that a child may take beyond its measuring


@dataclass(frozen=True)
class Throughput:
    """Sets a second with one thread and with two.

    Attributes
    ----------
    one, two : tuple of float
        Of each round; nothing where it cannot be told.
    reason : str
        Why it cannot be told; empty where it can.
    """

    one: tuple[float, ...] = ()
    two: tuple[float, ...] = ()
    reason: str = ""

    @property
    def ratio(self) -> float:
        """Best over best."""
        return max(self.two) / max(self.one) if self.one and self.two else float("nan")

    def __str__(self) -> str:
        """One line for people."""
        if self.reason:
            return f"throughput of two cores over one: not measured, {self.reason}"
        each = [two / one for one, two in zip(self.one, self.two, strict=True)]
        rounds = "1 round" if len(each) == 1 else f"{len(each)} rounds"
        return (
            f"throughput of two cores over one: {self.ratio:.2f} ({min(each):.2f} to {max(each):.2f} over "
            f"{rounds}; {max(self.one):.0f} and {max(self.two):.0f} sets a second, "
            f"n={N}, d={D}, F={F}, {SETS} sets a call)"
        )


def throughput(seconds: float, rounds: int) -> Throughput:
    """Measure one thread and two in turn, each in a process of its own.

    Parameters
    ----------
    seconds : float
        Time of measuring in each process.
    rounds : int
        How often both are measured.

    Returns
    -------
    Throughput
    """
    device = runtime().device
    if "portable computing language" not in device.platform.lower() or not device.is_cpu:
        return Throughput(reason=f"threads can be set for PoCL on a CPU only, not for {device.label}")
    if device.compute_units < 2 or (os.cpu_count() or 1) < 2:
        return Throughput(reason="the device has one core")
    rates: dict[int, list[float]] = {1: [], 2: []}
    for _ in range(rounds):
        for threads in (1, 2):
            try:
                rates[threads].append(_child(threads, seconds, device.index))
            except (subprocess.SubprocessError, ValueError) as error:
                return Throughput(reason=f"the process with {threads} threads failed ({error})")
    return Throughput(tuple(rates[1]), tuple(rates[2]))


def _child(threads: int, seconds: float, device: int) -> float:
    call = f"from gbnbench.benchmarks.spectra.cores import measure; measure({seconds!r})"
    done = subprocess.run(
        [sys.executable, "-c", call],
        env=os.environ | {VARIABLE: str(threads), DEVICE_VARIABLE: str(device)},
        capture_output=True,
        check=True,
        timeout=seconds + PATIENCE,
    )
    told = json.loads(done.stdout)
    if told["compute_units"] != threads:
        raise DeviceError(f"{VARIABLE}={threads} left {told['compute_units']} cores")
    return float(told["sets_a_second"])


def measure(seconds: float) -> None:
    """Print the sets a second of this process: the fastest call of those that fit in the time."""
    from gbnbench.analysis.spectrum.periodogram import periodogram

    x = np.random.default_rng(0).random((SETS, N, D))
    periodogram(x, F)
    until, best = time.perf_counter() + seconds, float("inf")
    while time.perf_counter() < until:
        began = time.perf_counter()
        periodogram(x, F)
        best = min(best, time.perf_counter() - began)
    print(json.dumps({"compute_units": runtime().device.compute_units, "sets_a_second": SETS / best}))
