"""The regression check: cases are measured again and judged, or what they expect is measured anew."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from scipy.special import stdtrit

from gbnbench.core.errors import GbnbenchError, InputError
from gbnbench.execution.calls import Finished
from gbnbench.execution.progress import Progress
from gbnbench.opencl import choose
from gbnbench.regression.cases import Case, Expectation, Spread, Values
from gbnbench.regression.measurement import observe
from gbnbench.regression.verdict import Verdict, failed, judge, skipped, title
from gbnbench.runs.resumable import TaskRun
from gbnbench.runs.task import Task

FALSE_ALARM = 1e-4  # chance that another seed, or another device, alone makes a measure worse
ROUNDING = 1e-9  # relative spread below which seeds do not matter


@dataclass(frozen=True)
class ExpectationChange:
    """An expectation before and after an update."""

    case: str
    measure: str
    before: Expectation
    after: Expectation


def check(cases: Sequence[Case], *, jobs: int = 1, progress: Progress | None = None) -> tuple[Verdict, ...]:
    """Measure cases once each, at their own seeds, and judge every measure.

    Parameters
    ----------
    cases : sequence of Case
        Which, all with expected values.
    jobs : int
        Worker processes of one thread each; with 1 the work is done in this process.
    progress : Progress, optional
        Told what is being done.

    Returns
    -------
    tuple of Verdict
        In the order of the cases and of their measures.

    Raises
    ------
    InputError
        If something expected has never been measured.
    DeviceError
        If there is no device.
    """
    for case in cases:
        for measure, expectation in case.measures.items():
            if not expectation.expected:
                raise InputError(
                    f"{case.name} expects nothing of {measure} yet: gbnbench check --update --only "
                    f"{case.name} measures it"
                )
    able = [case for case in cases if _reason(case) is None]
    verdicts = {case.name: skipped(case, _reason(case) or "") for case in cases}
    by_key = {_key(case, case.seed): case for case in able}
    for done in _measure([(case, case.seed) for case in able], jobs, progress or Progress()):
        case = by_key[str(done.key)]
        verdicts[case.name] = (
            failed(case, done.failure)
            if done.failure
            else [judge(case, measure, done.value[measure]) for measure in case.measures]
        )
    return tuple(verdict for case in cases for verdict in verdicts[case.name])


def update(
    cases: Sequence[Case], seeds: int, *, jobs: int = 1, progress: Progress | None = None
) -> tuple[tuple[Case, ...], tuple[ExpectationChange, ...]]:
    """Measure anew what cases expect, over several seeds; what has a reference stays.

    Parameters
    ----------
    cases : sequence of Case
        Which.
    seeds : int
        Over how many, from each case's own upwards; at least 3.
    jobs, progress
        As in ``check``.

    Returns
    -------
    cases : tuple of Case
        With new values, spreads and tolerances.
    changes : tuple of ExpectationChange
        Every expectation that was measured, in order.

    Raises
    ------
    InputError
        If something is undefined for some seed, or the seeds are too few.
    GbnbenchError
        If a case could not be measured.
    """
    if seeds < 3:
        raise InputError(f"a spread needs at least 3 seeds; got {seeds}")
    measured = [case for case in cases if not case.exact]
    for case in measured:
        if reason := _reason(case):
            raise InputError(f"{case.name}: {reason}")
    found: dict[str, dict[str, Values]] = {}
    runs = [(case, case.seed + k) for case in measured for k in range(seeds)]
    labels = {_key(case, seed): f"{case.name}, seed {seed}" for case, seed in runs}
    for done in _measure(runs, jobs, progress or Progress()):
        if done.failure:
            raise GbnbenchError(f"{labels[str(done.key)]}, could not be measured: {done.failure}")
        found[str(done.key)] = done.value
    made, changes = [], []
    for case in cases:
        renewed = dict(case.measures)
        for measure, expectation in case.measures.items():
            if expectation.reference:
                continue
            values = [found[_key(case, case.seed + k)][measure] for k in range(seeds)]
            renewed[measure] = expect(f"{case.name}: {title(measure)}", expectation, values)
            changes.append(ExpectationChange(case.name, measure, expectation, renewed[measure]))
        made.append(replace(case, measures=renewed))
    return tuple(made), tuple(changes)


def expect(what: str, expectation: Expectation, values: Sequence[Values]) -> Expectation:
    """Expect what several seeds gave: their mean, and a tolerance by their spread.

    Parameters
    ----------
    what : str
        For errors.
    expectation : Expectation
        Its side, scale and reason are kept.
    values : sequence of tuple of float
        A value a seed.

    Returns
    -------
    Expectation
        With the mean, the tolerance and the spread.

    Raises
    ------
    InputError
        If a value is not finite, not one number, or not above 0 where the scale is a ratio.

    Notes
    -----
    Another seed, or the same on a device that rounds otherwise, departs from the mean of K by a deviation of
    s sqrt(1 + 1/K), s being estimated with K - 1 degrees of freedom: the tolerance is that times the quantile
    of Student's t that is exceeded once in ten thousand; of the logarithms where the scale is a ratio.
    """
    sample = np.array(values)
    if sample.shape[1:] != (1,) or expectation.scale == "relative":
        raise InputError(f"{what}: only single values have a spread; several need a reference")
    if not np.isfinite(sample).all():
        raise InputError(f"{what} is undefined for some seeds; take it out of the case")
    ratio = expectation.scale == "ratio"
    if ratio and not (sample > 0).all():
        raise InputError(f"{what} is not above 0 for some seeds; its scale must be difference")
    sample = np.log(sample[:, 0]) if ratio else sample[:, 0]
    count = len(sample)
    deviation, mean = float(sample.std(ddof=1)), float(sample.mean())
    least = ROUNDING if ratio else ROUNDING * max(abs(mean), ROUNDING)
    side = FALSE_ALARM / (2 if expectation.better == "neither" else 1)
    reach = -float(stdtrit(count - 1, side)) * max(deviation, least) * math.sqrt(1 + 1 / count)
    return replace(
        expectation,
        expected=(_digits(math.exp(mean) if ratio else mean, 6),),
        tolerance=1 + _digits(math.expm1(reach), 3) if ratio else _digits(reach, 3),
        spread=Spread(count, _digits(deviation, 3)),
    )


def _digits(value: float, digits: int) -> float:
    return float(f"{value:.{digits - 1}e}")


def _reason(case: Case) -> str | None:
    """Why the chosen device cannot run a case, None where it can."""
    device = choose()
    if case.precision == "double" and not device.has_double:
        return f"{device.label} does not compute in double"
    return None


def _key(case: Case, seed: int) -> str:
    return f"{case.name}/{seed}"


def _measure(runs: Sequence[tuple[Case, int]], jobs: int, progress: Progress) -> Iterator[Finished]:
    """Measure every case with its seed, the largest first."""
    ordered = sorted(runs, key=lambda run: -run[0].realizations * run[0].n ** 2)
    tasks = [
        Task(_key(case, seed), f"measuring {case.name}", observe, (case, seed), done=f"measured {case.name}")
        for case, seed in ordered
    ]
    # What the doctor would refuse is a verdict here.
    return TaskRun(tasks).complete(
        None if jobs == 1 else jobs, progress, doing="measuring", prove_device=False
    )
