"""Verdicts against a baseline: three standard errors of the difference decide."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd
import pytest

from gbnbench.analysis.measure_definitions import DEFINITIONS
from gbnbench.core.results.measures import Measures
from gbnbench.core.results.radial import RadialPower
from gbnbench.core.results.spectrum import Spectrum
from gbnbench.runs.baseline import judge, verdict
from gbnbench.runs.comparison_result import Run, SourceResult


def source(
    label: str, realizations: int = 16, n: int = 16, error: float = 0.1, **values: float
) -> SourceResult:
    names = [definition.name for definition in DEFINITIONS]
    empty = np.zeros(0)
    return SourceResult(
        key=f"{label}_n{n}",
        label=label,
        n=n,
        d=2,
        realizations=realizations,
        points=np.zeros((realizations, n, 2)),
        spectrum=Spectrum(np.zeros((1, 1)), n, 2, realizations, 0),
        radial=RadialPower(empty, empty, empty, np.zeros(0, dtype=np.int64)),
        anisotropy=pd.DataFrame({"frequency": [], "nu": [], "anisotropy_db": []}),
        rdf=None,
        valence=None,
        zone_plate=None,
        measures=Measures({**dict.fromkeys(names, 1.0), **values}, dict.fromkeys(names, error)),
        cpu_seconds=0.0,
        warnings=(),
    )


def test_three_standard_errors_of_the_difference_decide() -> None:
    # Both errors are 0.1, so that of the difference is 0.1414 and three of them 0.4243.
    before = Run({}, (source("gbn"),))
    after = Run({}, (source("gbn", noise_floor=1.43, peak=1.42, evacuated_energy=1.43, min_distance=0.57),))
    changes, notes = judge(after, before)
    assert notes == ()
    assert {(c.measure, c.verdict) for c in changes} == {
        ("noise_floor", "worse"), ("evacuated_energy", "better"), ("min_distance", "worse")
    }  # fmt: skip
    floor = next(c for c in changes if c.measure == "noise_floor")
    assert (floor.before, floor.after, floor.key) == (1.0, 1.43, "gbn_n16")
    assert floor.deviations == pytest.approx(0.43 / math.sqrt(0.02))


def test_rows_pair_by_label_n_and_d() -> None:
    before = Run({}, (source("gbn", peak=9.0), source("sobol"), source("gbn", n=64)))
    after = Run({}, (source("random"), source("gbn", n=64, peak=9.0), source("gbn")))
    changes, notes = judge(after, before)
    assert [(c.n, c.measure, c.verdict) for c in changes] == [(64, "peak", "worse"), (16, "peak", "better")]
    assert notes == (
        "random (n=16, d=2): not in the baseline",
        "sobol (n=16, d=2): only in the baseline",
    )


def test_few_realizations_are_noted() -> None:
    changes, notes = judge(Run({}, (source("gbn", 4, peak=99.0),)), Run({}, (source("gbn", 16),)))
    assert [c.measure for c in changes if c.measure == "peak"] == ["peak"]
    assert notes == ("gbn (n=16, d=2): 4 realizations; below 8 chance alone often makes a verdict",)


@pytest.mark.parametrize(("before", "after"), [(1, 4), (4, 1), (1, 1)])
def test_a_single_realization_gives_no_verdict(before: int, after: int) -> None:
    changes, notes = judge(Run({}, (source("gbn", after, peak=99.0),)), Run({}, (source("gbn", before),)))
    assert changes == ()
    assert notes == ("gbn (n=16, d=2): no verdict from a single realization",)


def test_what_is_undefined_gives_no_verdict_and_what_never_varies_counts_at_once() -> None:
    assert verdict(math.nan, 1.0, 0.1, "lower")[0] == ""
    assert verdict(1.0, 2.0, math.nan, "lower")[0] == ""
    assert verdict(-math.inf, -math.inf, 0.1, "lower")[0] == ""
    assert verdict(1.0, 1.0, 0.0, "lower")[0] == ""
    assert verdict(1.0, 1.0 + 1e-15, 0.0, "lower")[0] == ""  # rounding
    assert verdict(1.0, 1.0 + 1e-6, 0.0, "lower") == ("worse", math.inf)
    assert verdict(1.0, 2.0, 0.1, "higher")[0] == "better"
