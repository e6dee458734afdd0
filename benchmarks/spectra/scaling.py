"""Growth of the periodogram's cost along sweeps of its size, and the slopes of that growth."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np
import pandas as pd

from gbnbench.benchmarks.spectra.cases import SpectrumBenchmark, SpectrumCase
from gbnbench.benchmarks.spectra.rivals import ours
from gbnbench.benchmarks.spectra.timing_columns import SIZE, TIMES, peak_share, size_columns, time_columns
from gbnbench.benchmarks.timing.interleaved import interleave
from gbnbench.benchmarks.timing.machine import Row

STEEP = 1e7  # operations from which a slope is fitted: below, launching the kernels is what costs
SCALING = (
    "sweep",
    *SIZE,
    "method",
    "family",
    "precision",
    "evaluation",
    "flops",
    "rounds",
    *TIMES,
    "share_of_peak",
)


def grow(sweep: str, case: SpectrumCase, plan: SpectrumBenchmark, most: Mapping[str, float]) -> Iterator[Row]:
    """Time gbnbench on one size of a sweep, and the plain product where it chooses another.

    Parameters
    ----------
    sweep : str
        Name of the sweep.
    case : SpectrumCase
        The size.
    plan : SpectrumBenchmark
        Gives the time to spend.
    most : mapping
        The multiply-add peak of one core by precision.

    Returns
    -------
    iterator of dict
    """
    x = case.points()
    every = list(ours(case.n, case.d, case.fmax, case.sets))
    timings = interleave({r.name: r.prepare(x, case.fmax) for r in every}, plan.sweep_seconds)
    for rival in every:
        yield {
            **size_columns(case),
            "sweep": sweep,
            "method": rival.name,
            "family": rival.family,
            "precision": rival.precision,
            "evaluation": rival.evaluation,
            "flops": case.flops,
            **time_columns(timings[rival.name]),
            "share_of_peak": peak_share(case, rival, timings[rival.name], most),
        }


def slopes(scaling: pd.DataFrame) -> pd.DataFrame:
    """Slope of log CPU time against log work asked for, a row a sweep and method.

    Returns
    -------
    DataFrame
        sweep, method, sizes, slope (least squares over sizes of at least 1e7 operations; nan where these span
        less than a factor of ten), steepest (largest slope between neighbours), share_least and share_most
        (of the peak, over the same sizes; nan where the plain product is not what ran).
    """
    rows = []
    for (sweep, method), part in scaling.groupby(["sweep", "method"], sort=False):
        large = part[part.flops >= STEEP].sort_values("flops")
        work, cost = np.log(large.flops.to_numpy(float)), np.log(large.cpu_ms.to_numpy(float))
        wide = len(work) > 1 and work[-1] - work[0] >= math.log(10)
        apart = np.diff(work) > math.log(1.2)
        local = np.diff(cost)[apart] / np.diff(work)[apart]
        rows.append(
            {
                "sweep": sweep,
                "method": method,
                "sizes": len(large),
                "slope": float(np.polyfit(work, cost, 1)[0]) if wide else math.nan,
                "steepest": float(local.max()) if wide else math.nan,
                "share_least": float(large.share_of_peak.min()),
                "share_most": float(large.share_of_peak.max()),
            }
        )
    return pd.DataFrame(rows)
