"""Integer frequencies of balls and shells against counts and Jacobi's theorem."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.errors import RefusalError
from gbnbench.core.integer_frequencies import half_ball, half_count, shell_counts, to_half_space


@pytest.mark.parametrize(("d", "square"), [(1, 9), (2, 26), (3, 11), (5, 4), (8, 2)])
def test_half_a_ball_is_what_the_shells_count(d: int, square: int) -> None:
    side = int(square**0.5) + 1
    cube = np.indices((2 * side + 1,) * d).reshape(d, -1).T - side
    lengths = (cube**2).sum(axis=1)
    squares, counts = shell_counts(d, square)
    assert counts.tolist() == np.bincount(lengths)[squares].tolist()
    assert squares.tolist() == np.unique(lengths[lengths <= square]).tolist()
    half = half_ball(d, square)
    assert half_count(d, square) == len(half)
    whole = {tuple(f) for f in np.concatenate([half, -half])}
    assert len(whole) == 2 * len(half) == counts.sum() - 1
    assert whole == {tuple(f) for f in cube[(lengths > 0) & (lengths <= square)]}


def test_shells_of_eight_dimensions_are_those_of_jacobi() -> None:
    for m, count in zip(*shell_counts(8, 12), strict=True):  # 16 sum over divisors of (-1)^(m + t) t^3
        divisors = [t for t in range(1, m + 1) if m % t == 0]
        assert count == (16 * sum((-1) ** (m + t) * t**3 for t in divisors) or 1)


def test_halves_meet_in_one() -> None:
    f = np.random.default_rng(0).integers(-2, 3, (400, 4))
    one, turned = to_half_space(f)
    other, _ = to_half_space(-f)
    assert (one == other).all()
    assert (np.where(turned[:, None], -one, one) == f).all()
    kept = one[one.any(axis=1)]
    assert {tuple(row) for row in kept} <= {tuple(row) for row in half_ball(4, 16)}


def test_a_ball_too_large_to_count_is_refused() -> None:
    with pytest.raises(RefusalError, match=r"up to \|f\|=1e\+04 in d=2 are too many"):
        shell_counts(2, 10**8)


def test_counting_stops_where_there_are_enough() -> None:
    assert 1e150 < shell_counts(30_000, 1764, 1e150)[1].sum() < 1e160
