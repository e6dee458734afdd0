from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gbnbench.analysis.spatial.discrepancy import discrepancies
from gbnbench.core.errors import RefusalError
from gbnbench.core.torus import wrap


def slow(x: np.ndarray) -> dict[str, float]:
    """Closed forms of Hickernell (1998), Zhou, Fang & Ning (2013) and Warnock (1972), by loops."""
    n, d = x.shape
    c1 = sum(math.prod(1 + abs(v - 0.5) / 2 - abs(v - 0.5) ** 2 / 2 for v in p) for p in x)
    m1 = sum(math.prod(5 / 3 - abs(v - 0.5) / 4 - abs(v - 0.5) ** 2 / 4 for v in p) for p in x)
    s1 = sum(math.prod(1 - v * v for v in p) for p in x)
    c2 = w2 = m2 = s2 = 0.0
    for p in x:
        for q in x:
            pairs = list(zip(p, q, strict=True))
            c2 += math.prod(1 + abs(a - 0.5) / 2 + abs(b - 0.5) / 2 - abs(a - b) / 2 for a, b in pairs)
            w2 += math.prod(1.5 - abs(a - b) * (1 - abs(a - b)) for a, b in pairs)
            m2 += math.prod(
                15 / 8 - abs(a - 0.5) / 4 - abs(b - 0.5) / 4 - 3 * abs(a - b) / 4 + (a - b) ** 2 / 2
                for a, b in pairs
            )
            s2 += math.prod(1 - max(a, b) for a, b in pairs)
    return {
        "CD": (13 / 12) ** d - 2 / n * c1 + c2 / n**2,
        "WD": -((4 / 3) ** d) + w2 / n**2,
        "MD": (19 / 12) ** d - 2 / n * m1 + m2 / n**2,
        "L2-star": math.sqrt(3.0**-d - 2.0 ** (1 - d) / n * s1 + s2 / n**2),
    }


@pytest.mark.parametrize(("n", "d"), [(1, 1), (9, 1), (20, 2), (15, 5)])
def test_against_the_closed_forms(n: int, d: int) -> None:
    x = np.random.default_rng(n).random((2, n, d))
    made = discrepancies(x)
    assert list(made) == ["CD", "WD", "MD", "L2-star"]
    for k in range(2):
        for kind, value in slow(x[k]).items():
            assert made[kind][k] == pytest.approx(value, rel=1e-9)  # type: ignore[index]


def test_too_many_points_are_refused_before_the_sum() -> None:
    with pytest.raises(RefusalError, match="at most 22360"):
        discrepancies(np.full((80_000, 2), 0.5))


@settings(deadline=None, max_examples=25)
@given(st.integers(0, 2**32 - 1), st.integers(1, 40), st.integers(1, 4))
def test_wrap_around_discrepancy_does_not_know_the_origin(seed: int, n: int, d: int) -> None:
    rng = np.random.default_rng(seed)
    x = rng.random((n, d))
    assert discrepancies(wrap(x + rng.random(d)))["WD"][0] == pytest.approx(
        discrepancies(x)["WD"][0], abs=1e-12
    )
    permuted = discrepancies(rng.permutation(x))
    for kind, value in discrepancies(x).items():
        assert permuted[kind][0] == pytest.approx(value[0], abs=1e-12)
