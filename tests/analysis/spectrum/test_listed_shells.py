"""Shells listed frequency by frequency: their sizes, the frequencies, and how far they are affordable."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.spectrum.listed_shells import (
    LARGEST_LIST,
    affordable_square,
    default_shells,
    half_ball,
    largest_square,
    listed_count,
    shell_sizes,
)
from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.core.errors import InputError
from tests.oracles.power import direct_power


@pytest.mark.parametrize("d", [8, 20, 50, 100])
def test_sizes_of_shells_are_counted_by_choosing_axes(d: int) -> None:
    def choose(k: int) -> int:
        return math.comb(d, k) * 2**k

    # |f|^2 = 4, 5 and 6 also have an axis of 2 beside none, one and two of 1.
    assert shell_sizes(d, 6) == [
        1, choose(1), choose(2), choose(3), choose(4) + 2 * d,
        choose(5) + 2 * d * 2 * (d - 1), choose(6) + 2 * d * math.comb(d - 1, 2) * 4,
    ]  # fmt: skip


def test_sizes_in_four_and_eight_dimensions_are_jacobi_s() -> None:
    for k, size in enumerate(shell_sizes(4, 30)[1:], start=1):
        assert size == 8 * sum(m for m in range(1, k + 1) if k % m == 0 and m % 4)
    for k, size in enumerate(shell_sizes(8, 30)[1:], start=1):
        assert size == 16 * sum((-1) ** (k + m) * m**3 for m in range(1, k + 1) if k % m == 0)


@pytest.mark.parametrize(("d", "low", "high"), [(1, 1, 9), (3, 2, 11), (7, 1, 4), (20, 3, 3)])
def test_half_a_ball_holds_one_of_each_pair_in_the_order_of_shells(d: int, low: int, high: int) -> None:
    square, f = half_ball(d, high, low)
    assert np.array_equal(square, (f * f).sum(axis=1))
    assert np.all(np.diff(square) >= 0)
    assert 2 * len(f) == sum(shell_sizes(d, high)[low:])
    pairs = {tuple(row) for row in f.tolist()} | {tuple(row) for row in (-f).tolist()}
    assert len(pairs) == 2 * len(f)


def test_on_a_line_the_shells_are_the_squares_however_many_points() -> None:
    for most in range(20):
        for wanted in (1, 3, 4, 40, 99):
            within = np.cumsum(shell_sizes(1, wanted + 1)[1:])  # of |f|^2 = 1, 2, ...
            affordable = [square for square in range(1, wanted + 1) if within[square - 1] <= most]
            assert largest_square(1, most, wanted) == max(affordable, default=0)
    assert listed_count(1, 4, 99) == 8  # |f| = 2 to 9
    # of a million points 4,000 pairs of frequencies are affordable; numbers up to 4e12 are never listed
    assert affordable_square(10**6, 1) == 4001**2 - 1


def test_sizes_beyond_64_bits_are_exact() -> None:
    sizes = shell_sizes(400, 12)
    assert sizes[12] > 2**64
    lower, upper = shell_sizes(199, 12), shell_sizes(201, 12)
    assert sizes[12] == sum(lower[k] * upper[12 - k] for k in range(13))  # two factors of one power


def test_what_is_affordable_is_just_below_what_is_not() -> None:
    for d in (8, 20, 100):
        for most in (10, 1000, 10**6):
            reached = largest_square(d, most, 40)
            within = np.cumsum(shell_sizes(d, 41)[1:])
            assert reached == 40 or within[reached] > most
            assert reached == 0 or within[reached - 1] <= most
    assert affordable_square(10**9, 50, 10**9) == 1  # 2 d frequencies always are


@pytest.mark.parametrize("d", [39, 40, 60, 100])
def test_shells_of_cubes_that_cannot_be_counted_are_exact(d: int) -> None:
    x = np.random.default_rng(d).random((2, 7, d))
    found = shells(x, band=(1, math.sqrt(2)))
    assert found.count.tolist() == [2 * d, 2 * d * (d - 1)]
    square, f = half_ball(d, 2)
    power = np.mean([direct_power(one, f) for one in x], axis=0)
    for k, row in enumerate(found.power):
        of_shell = power[square == k + 1]
        assert row == pytest.approx(of_shell.mean(), rel=1e-12)
        assert found.deviation[k] == pytest.approx(((of_shell - of_shell.mean()) ** 2).sum(), rel=1e-11)


def test_defaults_take_a_ball_while_its_cube_can_be_counted() -> None:
    assert default_shells(32, 20) == (2, None)
    fmax, band = default_shells(32, 50)
    assert (fmax, band) == (2, (1.0, math.sqrt(3)))


def test_shells_that_are_too_many_say_how_far_they_go() -> None:
    with pytest.raises(
        InputError, match=r"with \|f\|\^2 = 4 they are .* frequencies; the band 1,1\.73205 can"
    ):
        shells(np.zeros((2, 100)), band=(1, 2))
    assert sum(shell_sizes(100, 3)) * 100 <= 2 * LARGEST_LIST
