"""Work of evaluations in multiply-adds, and the time it takes on an OpenCL device.

The constants were measured on CPUs. They count the work for each point on a pair of a leading and a trailing
frequency, the work on the tables, and what is done once with each point and each power. What is no product of
vectors gains nothing of wide ones nor of float: it is counted in narrow multiply-adds, those of four lanes.
"""

from __future__ import annotations

import numpy as np

from gbnbench.analysis.precision import Precision
from gbnbench.analysis.spectrum.evaluators.evaluation_cost import EvaluationCost
from gbnbench.analysis.spectrum.request import SpectrumRequest
from gbnbench.opencl.peak_rate import launch_seconds, peak

# Multiply-adds for a pair of frequencies and a point (four, and the waste of a tile), for an entry of a
# table, for a cosine and sine, for a power that is written, and for a pair that is reduced to its shell.
TILE, ENTRY, COSINE, WRITTEN, SHELL = 5.0, 40.0, 200.0, 20.0, 550.0
# Narrow multiply-adds for a point that is brought to the device, and those that take as long as the launches
# of a product that is no small cube, and as all else of a call. Fitted to the CPU times of 108 cubes in 1D to
# 3D, half of them in float, within 15% (rms). Of 144 cubes each was given to the quickest evaluator or
# to one that took a tenth longer at most.
CARRIED_POINT, LAUNCHED, SET_UP = 120.0, 6.3e5, 1.12e6
SET_UP_SECONDS = 4.2e-11  # of a core, for each multiply-add of a set-up
NARROW_LANES = 4
CALL_SECONDS = 1e-4  # for every request, where there are no launches
NUMPY_RATE = 4e9  # multiply-adds that numpy does in a second on one core


def narrow(p: Precision) -> float:
    """Count the multiply-adds of the device's vectors that pass in the time of one of four lanes.

    Parameters
    ----------
    p : Precision
        Precision on the device.

    Returns
    -------
    float
        With AVX-512 2 in double and 4 in float, 1 with vectors of four lanes or less.
    """
    return max(1.0, p.lanes / NARROW_LANES)


def device_cost(
    p: Precision,
    request: SpectrumRequest,
    work: float,
    launches: float,
    held: float,
    set_up: float = SET_UP,
    points: int | None = None,
) -> EvaluationCost:
    """Turn work into time by the device's measured multiply-add peak.

    Parameters
    ----------
    p : Precision
        Precision on the device.
    request : SpectrumRequest
        What is evaluated.
    work : float
        Multiply-adds, without the set-up.
    launches : float
        Number of kernel launches.
    held : float
        Bytes besides the points'.
    set_up : float
        Multiply-adds that take as long in double as the set-up does, in any precision.
    points : int, optional
        Points that are on the device at once; all of all sets if not given.

    Returns
    -------
    EvaluationCost
    """
    at_once = request.realizations * request.n if points is None else points
    of_points = at_once * request.d * 2 * np.dtype(p.real).itemsize
    device = p.runtime.device
    cores = device.compute_units if device.is_cpu else 1
    seconds = SET_UP_SECONDS * set_up + launches * launch_seconds() + 2 * work / peak(p.name) / cores
    return EvaluationCost(2 * work, int(held + of_points), seconds)
