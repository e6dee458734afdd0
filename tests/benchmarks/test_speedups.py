"""CPU time to one noise floor: found between stops, and at a floor that both methods reach."""

from __future__ import annotations

import math

import numpy as np
import pandas as pd
import pytest

from gbnbench.benchmarks.gbn.speedups import crossings, speedup
from gbnbench.generators.gbn.published_quality import AUTHORS_FLOOR


def test_seconds_to_a_floor_are_found_between_stops():
    part = pd.DataFrame(
        {
            "set": [0, 0, 0, 1, 1],
            "gradients": [10, 100, 1000, 10, 100],
            "cpu_s": [0.1, 1.0, 10.0, 0.2, 2.0],
            "noise_floor": [1e-2, 1e-4, 1e-8, 1e-6, 1e-7],
        }
    )
    assert crossings(part, 1e-3) == pytest.approx(np.array([[math.sqrt(0.1), 10**1.5], [0.2, 10]]))
    assert np.isnan(crossings(part, 1e-9)).all()


def test_the_speedup_is_taken_at_a_floor_that_both_reach():
    floors = pd.DataFrame(
        [
            {"case": "c", "precision": "double", "kernel": kernel, "method": method, "curve": method,
             "set": k, "gradients": g, "cpu_s": pace * (1 + k) * g, "noise_floor": level / g**power}
            for k in (0, 1)
            for kernel, method, pace, power, level in (
                ("whole", "nesterov", 0.003, 4, 1.0), ("whole", "descent", 0.002, 2, 1.0),
                ("cut off", "nesterov", 0.001, 4, 1e-9),
            )
            for g in (10, 100, 1000)
        ]
    )  # fmt: skip
    (row,) = speedup(floors).itertuples()
    assert row.floor == pytest.approx(1e-6)  # where descent ends
    assert row.gradients == pytest.approx(10**1.5)
    assert row.their_gradients == pytest.approx(1000)
    assert (row.ratio, row.ratio_min, row.ratio_max) == pytest.approx((2 / 3 * 10**1.5,) * 3)
    deeper = floors.assign(noise_floor=floors.noise_floor * 1e-6)
    assert speedup(deeper).floor.iloc[0] == AUTHORS_FLOOR
