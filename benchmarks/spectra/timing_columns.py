"""Columns that every timing of a spectrum has: its size, its times, its share of the peak rate."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from gbnbench.analysis.spectrum.evaluators.cube_product import CubeProduct
from gbnbench.benchmarks.spectra.cases import SpectrumCase
from gbnbench.benchmarks.spectra.rivals import Rival
from gbnbench.benchmarks.timing.interleaved import Timing
from gbnbench.benchmarks.timing.machine import Row

TIMES = ("cpu_ms", "cpu_ms_median", "wall_ms", "wall_ms_median")
SIZE = ("n", "d", "F", "sets")


def size_columns(case: SpectrumCase) -> Row:
    """Return the columns ``SIZE`` of a case."""
    return {"n": case.n, "d": case.d, "F": case.fmax, "sets": case.sets}


def time_columns(timing: Timing) -> Row:
    """Return the number of rounds and the columns ``TIMES``: least and median over the rounds, in ms."""
    return {
        "rounds": len(timing.cpu),
        "cpu_ms": 1e3 * float(timing.cpu.min()),
        "cpu_ms_median": 1e3 * float(np.median(timing.cpu)),
        "wall_ms": 1e3 * float(timing.wall.min()),
        "wall_ms_median": 1e3 * float(np.median(timing.wall)),
    }


def peak_share(case: SpectrumCase, rival: Rival, timing: Timing, most: Mapping[str, float]) -> float:
    """Share of what one core can do, by the product's operations.

    Parameters
    ----------
    case : SpectrumCase
        The size.
    rival : Rival
        The way to the power.
    timing : Timing
        What its calls took.
    most : mapping
        The multiply-add peak of one core by precision, operations a second.

    Returns
    -------
    float
        From 0 to 1; nan for evaluations other than the plain product, which do not do these operations.
    """
    if rival.evaluation != CubeProduct.title:
        return math.nan
    return case.flops / float(timing.cpu.min()) / most[rival.precision]
