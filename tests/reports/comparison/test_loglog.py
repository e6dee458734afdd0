"""The guide of the log-log picture: which fits say that a set is Gaussian blue noise."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import pytest

from gbnbench.reports.comparison.loglog import guide


def fitted(epsilon: float, c: float, residual: float) -> Any:
    measured = {"profile_epsilon": epsilon, "profile_c": c, "profile_residual_db": residual}
    return SimpleNamespace(measures=SimpleNamespace(measured=measured))


GBN, DEEPER = fitted(1.9e-10, 39.4, 1.16), fitted(2e-20, 41.0, 2.0)
STEP = fitted(3.9e-14, 46.6, 25.5)  # as fitted to four sets of step, n = 1,024, whose c is near by chance


def test_the_guide_is_that_of_the_deepest_blue_noise() -> None:
    found = guide([GBN, DEEPER])
    assert found is not None
    epsilon, end = found
    assert epsilon == 2e-20
    assert epsilon * math.exp(4 * math.pi**2 * end**2) == pytest.approx(1)


def test_a_step_is_no_blue_noise_of_that_kind() -> None:
    assert guide([GBN, STEP]) == guide([GBN])
    assert guide([STEP]) is None
    assert guide([fitted(1e-4, 18.2, 4.0)]) is None  # a c of BNOT's
