from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.integration.integrands.integer_frequencies import (
    check_count,
    half_ball,
    half_count,
    halved,
    shells,
)
from gbnbench.core.errors import RefusalError


@pytest.mark.parametrize(("d", "square"), [(1, 9), (2, 26), (3, 11), (5, 4), (8, 2)])
def test_half_a_ball_is_what_the_shells_count(d: int, square: int) -> None:
    side = int(square**0.5) + 1
    cube = np.indices((2 * side + 1,) * d).reshape(d, -1).T - side
    lengths = (cube**2).sum(axis=1)
    squares, counts = shells(d, square)
    assert counts.tolist() == np.bincount(lengths)[squares].tolist()
    assert squares.tolist() == np.unique(lengths[lengths <= square]).tolist()
    half = half_ball(d, square)
    assert half_count(d, square) == len(half)
    whole = {tuple(f) for f in np.concatenate([half, -half])}
    assert len(whole) == 2 * len(half) == counts.sum() - 1
    assert whole == {tuple(f) for f in cube[(lengths > 0) & (lengths <= square)]}


def test_shells_of_eight_dimensions_are_those_of_jacobi() -> None:
    for m, count in zip(*shells(8, 12), strict=True):  # 16 sum over divisors of (-1)^(m + t) t^3
        divisors = [t for t in range(1, m + 1) if m % t == 0]
        assert count == (16 * sum((-1) ** (m + t) * t**3 for t in divisors) or 1)


def test_halves_meet_in_one() -> None:
    f = np.random.default_rng(0).integers(-2, 3, (400, 4))
    one, turned = halved(f)
    other, _ = halved(-f)
    assert (one == other).all()
    assert (np.where(turned[:, None], -one, one) == f).all()
    kept = one[one.any(axis=1)]
    assert {tuple(row) for row in kept} <= {tuple(row) for row in half_ball(4, 16)}


def test_a_list_too_long_is_refused_with_its_length() -> None:
    with pytest.raises(
        RefusalError, match=r"a ball in d=3 has 5000000 frequencies, .* leave out a larger share"
    ):
        check_count("a ball", 3, 5_000_000)
    with pytest.raises(RefusalError, match=r"up to \|f\|=1e\+04 in d=2 are too many"):
        shells(2, 10**8)
