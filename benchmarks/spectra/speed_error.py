"""Speed against error of the periodogram beside its rivals, in one process and in turn."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from gbnbench.benchmarks.spectra.cases import SpectrumBenchmark, SpectrumCase
from gbnbench.benchmarks.spectra.reference import LongArray, reference_roots
from gbnbench.benchmarks.spectra.rivals import Rival, rivals
from gbnbench.benchmarks.spectra.timing_columns import SIZE, TIMES, peak_share, size_columns, time_columns
from gbnbench.benchmarks.timing.interleaved import interleave
from gbnbench.benchmarks.timing.machine import Row
from gbnbench.core.results.resolution import resolvable_power
from gbnbench.core.torus import FloatArray

SPEED = (
    "case", *SIZE, "method", "family", "precision", "evaluation", "rounds", *TIMES, "ratio", "ratio_min",
    "ratio_max", "error_rms", "error_largest", "resolvable", "share_of_peak",
)  # fmt: skip


def compare(case: SpectrumCase, plan: SpectrumBenchmark, most: Mapping[str, float]) -> Iterator[Row]:
    """Time every rival on one case and take its error.

    Parameters
    ----------
    case : SpectrumCase
        Points in a set, dimension, largest harmonic, number of sets.
    plan : SpectrumBenchmark
        Gives the time to spend, the longest call and the number of probes.
    most : mapping
        The multiply-add peak of one core by precision.

    Returns
    -------
    iterator of dict
        One row for each rival, ours first.
    """
    x = case.points()
    every = list(rivals(case.n, case.d, case.fmax, case.sets, plan.longest))
    timings = interleave({r.name: r.prepare(x, case.fmax) for r in every}, plan.seconds)
    f, truth = sample(case, x[0], plan.probes)
    for rival in every:
        timing = timings[rival.name]
        ratio = timing.over(timings[every[0].name])
        error = errors(rival, x[0], case.fmax, f, truth)
        yield {
            **size_columns(case),
            "case": case.title,
            "method": rival.name,
            "family": rival.family,
            "precision": rival.precision,
            "evaluation": rival.evaluation,
            **time_columns(timing),
            "ratio": float(np.median(ratio)),
            "ratio_min": float(ratio.min()),
            "ratio_max": float(ratio.max()),
            "error_rms": float(np.sqrt(np.mean(error**2))),
            "error_largest": float(error.max()),
            "resolvable": resolvable_power(float(np.sqrt(np.mean(error**2)))),
            "share_of_peak": peak_share(case, rival, timing, most),
        }
    if case.quoted is not None:
        name, seconds = case.quoted
        ratio = seconds / timings[every[0].name].cpu
        row: Row = dict.fromkeys(SPEED, math.nan)
        yield {
            **row,
            **size_columns(case),
            "case": case.title,
            "method": name,
            "family": name,
            "precision": "float",
            "evaluation": "",
            "rounds": 0,
            "cpu_ms": 1e3 * seconds,
            "ratio": float(np.median(ratio)),
            "ratio_min": float(ratio.min()),
            "ratio_max": float(ratio.max()),
        }


def sample(case: SpectrumCase, x: FloatArray, probes: int) -> tuple[Any, LongArray]:
    """Choose random frequencies of the cube, and compute the square root of the true power there.

    Parameters
    ----------
    case : SpectrumCase
        The size.
    x : (n, d) float64
        Points of one set.
    probes : int
        Number of frequencies.

    Returns
    -------
    frequencies : (m, d) int64
    roots : (m,) long double
    """
    f = np.random.default_rng(case.n).integers(-case.fmax, case.fmax + 1, (probes, case.d))
    return f, reference_roots(x, f)


def errors(rival: Rival, x: FloatArray, fmax: int, f: Any, truth: LongArray) -> FloatArray:
    """Measure the errors of the square root of power of one set.

    Parameters
    ----------
    rival : Rival
        The way to the power.
    x : (n, d) float64
        Points of one set.
    fmax : int
        Largest harmonic on each axis.
    f : (m, d) int64
        Frequencies.
    truth : (m,) long double
        The true roots there.

    Returns
    -------
    (m,) float64
        Absolute errors.
    """
    power = rival.prepare(x[None], fmax)()[tuple((f + fmax).T)]
    away: FloatArray = np.abs(np.sqrt(power.astype(np.longdouble)) - truth).astype(np.float64)
    return away
