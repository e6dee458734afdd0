"""Sobol points with nested Owen scrambling: elementary intervals, strata and nesting."""

from __future__ import annotations

from collections import Counter

import numpy as np
import pytest
from scipy.stats import chisquare, kstest, qmc

from gbnbench.generators.direct import sobol
from gbnbench.generators.direct.sobol import (
    MOST_BITS,
    MOST_DIMENSIONS,
    Sobol,
    directions,
    owen_permutation,
    unscrambled,
)
from gbnbench.generators.registry import generate
from tests.oracles.power import direct_power, half_space


@pytest.mark.parametrize("m", [0, 1, 4, 8])
def test_every_elementary_interval_holds_one_point_in_2d(m: int) -> None:
    for x in generate("sobol", n=2**m, d=2, realizations=3).reshape(3, -1, 2):
        for k in range(m + 1):
            cell = np.floor(x * [2**k, 2 ** (m - k)]) @ [2 ** (m - k), 1]
            assert np.array_equal(np.sort(cell), np.arange(2**m))


@pytest.mark.parametrize(("bits", "d"), [(0, 1), (1, 2), (10, 2), (7, 40), (3, 1000), (13, 3)])
def test_unscrambled_points_are_those_of_scipy(bits: int, d: int) -> None:
    theirs = qmc.Sobol(d, scramble=False, bits=MOST_BITS).random_base2(bits)
    assert np.array_equal(unscrambled(bits, d) * 2.0**-bits, theirs)


def test_points_are_the_same_where_scipy_has_moved_its_table(monkeypatch: pytest.MonkeyPatch) -> None:
    kept = generate("sobol", n=100, d=3, seed=2)
    monkeypatch.setattr(sobol, "NUMBERS", "stats/elsewhere.npz")
    sobol.directions.cache_clear()
    assert np.array_equal(generate("sobol", n=100, d=3, seed=2), kept)
    sobol.directions.cache_clear()


def test_all_direction_numbers_are_those_of_scipy() -> None:
    theirs = qmc.Sobol(MOST_DIMENSIONS, scramble=False, bits=MOST_BITS)._sv
    assert np.array_equal(directions(MOST_DIMENSIONS), theirs)


@pytest.mark.parametrize("d", [1, 5, 40])
def test_every_axis_is_stratified(d: int) -> None:
    strata = np.sort(np.floor(generate("sobol", n=128, d=d) * 128), axis=0)
    assert np.array_equal(strata, np.repeat(np.arange(128)[:, None], d, axis=1))


def test_any_size_is_a_part_of_the_next_balanced_one() -> None:
    x = generate("sobol", n=100, d=3)
    assert x.shape == (100, 3)
    for axis in range(3):
        assert len(np.unique(np.floor(x[:, axis] * 128))) == 100


def test_permutation_is_nested() -> None:
    permutation = owen_permutation(7, np.random.default_rng(3))
    assert np.array_equal(np.sort(permutation), np.arange(128))
    for digits in range(8):
        pairs = np.stack([np.arange(128), permutation]) >> (7 - digits)
        assert len(np.unique(pairs, axis=1).T) == 2**digits


def test_all_nested_permutations_are_equally_likely() -> None:
    """Three digits have 2**7 of them; a linear matrix scramble with digital shift reaches only 2**6."""
    rng = np.random.default_rng(11)
    seen = Counter(tuple(owen_permutation(3, rng)) for _ in range(6400))
    assert len(seen) == 128
    assert chisquare(list(seen.values())).pvalue > 1e-4


@pytest.mark.slow
def test_power_is_that_of_nested_scrambling() -> None:
    """A pair that first differs in digit j of an axis lies in sibling halves of width h = 2**-j."""
    n, d, sets = 16, 2, 800
    f = np.concatenate([half_space(3, d), [[8, 0], [16, 0], [0, 16], [16, 16], [5, 7]]])
    digits = np.floor(qmc.Sobol(d, scramble=False).random_base2(4) * n).astype(int)
    first, second = np.nonzero(~np.eye(n, dtype=bool))
    h = 2.0 ** (np.floor(np.log2(digits[first] ^ digits[second])) - 4)
    turns = f[:, None] * h
    pairs = np.prod(np.cos(2 * np.pi * turns) * np.sinc(turns) ** 2, axis=2)
    expected = 1 + pairs.sum(axis=1) / n
    axis = (f == 0).any(axis=1)
    assert np.allclose(expected[axis], 1 - np.sinc(f[axis].sum(axis=1) / n) ** 2, atol=1e-12)
    power = np.array([direct_power(x, f) for x in generate("sobol", n=n, d=d, realizations=sets)])
    assert np.all(np.abs(power.mean(axis=0) - expected) < 5 * power.std(axis=0) / np.sqrt(sets) + 1e-9)


@pytest.mark.parametrize("name", ["sobol", "halton"])
def test_each_point_is_uniform_over_realizations(name: str) -> None:
    sets = generate(name, n=5, d=3, realizations=1500)
    for point in (0, 3):
        for axis in range(3):
            assert kstest(sets[:, point, axis], "uniform").pvalue > 1e-4


def test_largest_coordinate_stays_below_one() -> None:
    class Ones(np.random.Generator):
        def integers(self, low, high=None, size=None, **_):  # type: ignore[no-untyped-def,override]
            return np.full(size, high - 1, dtype=np.int64)

    x = Sobol()(8, 2, Ones(np.random.PCG64(0)))
    assert x.max() == 1 - 2.0**-53


def test_limits_are_refused() -> None:
    assert Sobol().refusal(2**30, 21201) is None
    assert "at most 21201" in str(Sobol().refusal(4, 21202))
    assert "nearest is 1073741824" in str(Sobol().refusal(2**30 + 1, 2))
