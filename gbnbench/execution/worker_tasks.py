"""What a comparison's workers are asked to do: prove the device, draw one set, measure one source."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from gbnbench.core.errors import DeviceError
from gbnbench.core.torus import FloatArray
from gbnbench.execution.worker_pool import Pool
from gbnbench.generators.protocol import Generator, checked_draw, realization_rng

if TYPE_CHECKING:
    from gbnbench.analysis.measures import Analysis

AGAIN_SECONDS = 5.0

_met: set[tuple[Generator, int, int]] = set()  # in a worker: what it has drawn before


def draw_set(
    generator: Generator, n: int, d: int, seed: int, k: int, again: bool = False
) -> tuple[FloatArray, float, bool]:
    """Draw realization k in a worker.

    Parameters
    ----------
    generator, n, d, seed, k
        What to draw.
    again : bool
        Draw it twice where the worker is new to it and the first took under five seconds, so that the cost of
        the second is free of imports and kernel builds; for sources of which no worker draws two sets.

    Returns
    -------
    x : (n, d) float64
        The points.
    cpu_seconds : float
        Of one draw.
    first : bool
        Whether that draw was the worker's first with this generator, n and d.
    """
    first = (generator, n, d) not in _met
    _met.add((generator, n, d))
    began = time.process_time()
    x = generator(n, d, realization_rng(seed, k))
    cost = time.process_time() - began
    x = checked_draw(generator, x, n, d)
    if first and again and cost < AGAIN_SECONDS:
        began = time.process_time()
        generator(n, d, realization_rng(seed, k))
        return x, time.process_time() - began, False
    return x, cost, first


def check_device() -> None:
    """Let the device prove itself in a worker, once for each device, driver and version."""
    from gbnbench.doctor.kernel_checks import ensure_trusted

    ensure_trusted()


def prove_device(pool: Pool) -> None:
    """Let a worker prove the device before there is other work: what a bad driver kills is not the command.

    Raises
    ------
    DeviceError
        If it cannot be used.
    """
    pool.submit(None, check_device)
    if failure := pool.next().failure:
        raise DeviceError(f"the OpenCL device cannot be used: {failure}")


def analyse_sets(points: FloatArray) -> Analysis:
    """Measure one source in a worker."""
    from gbnbench.analysis.measures import analyse

    return analyse(points)
