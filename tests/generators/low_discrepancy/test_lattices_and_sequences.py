"""Rank-1 lattices, Hammersley sets and Kronecker sequences against closed forms and exact fractions."""

from __future__ import annotations

from fractions import Fraction
from math import gcd

import numpy as np
import pytest

from gbnbench.analysis.measures import measures
from gbnbench.analysis.spatial.discrepancy import discrepancies
from gbnbench.analysis.spatial.discrepancy_kernels import Discrepancy
from gbnbench.generators.low_discrepancy.hammersley import primes, radical_inverse
from gbnbench.generators.low_discrepancy.kronecker import generalised_golden_ratio
from gbnbench.generators.low_discrepancy.rank1_lattice import best_generator, korobov_vectors, merits
from gbnbench.generators.registry import find, generate
from tests.oracles.power import direct_power, half_space

FIBONACCI = [1, 1, 2, 3, 5, 8, 13, 21, 34, 55, 89, 144, 233, 377, 610]


@pytest.mark.parametrize("k", range(5, 15))
def test_at_fibonacci_numbers_the_best_of_p2_is_the_fibonacci_lattice(k: int) -> None:
    """The inverse of a and the mirror images n - a give the same lattice but for symmetry."""
    n, a = FIBONACCI[k], best_generator(FIBONACCI[k], 2, "p2")
    same = {
        FIBONACCI[k - 1],
        n - FIBONACCI[k - 1],
        pow(FIBONACCI[k - 1], -1, n),
        n - pow(FIBONACCI[k - 1], -1, n),
    }
    assert a in same


def test_at_a_fibonacci_number_no_lattice_has_less_periodic_discrepancy() -> None:
    def wraparound(a: int) -> float:
        x = np.arange(55)[:, None] * korobov_vectors(np.array([a]), 55, 2) % 55 / 55
        return float(measures(x)["discrepancy_wd"])

    found = {a: wraparound(a) for a in range(1, 28) if gcd(a, 55) == 1}
    assert min(found.values()) >= found[best_generator(55, 2, "p2")] * (1 - 1e-9)


@pytest.mark.parametrize(("n", "z"), [(8, (1, 3)), (13, (1, 5)), (9, (1, 2, 4))])
def test_p2_is_the_sum_over_the_dual_lattice(n: int, z: tuple[int, ...]) -> None:
    """The Bernoulli form by fractions, and the dual sum up to |h| = 400, whose rest is below a hundredth."""
    ours = merits(np.array([z]), n, "p2")[0]
    total = 0.0
    for i in range(n):
        product = 1.0
        for component in z:
            u = Fraction(i * component % n, n)
            product *= 1 + 2 * np.pi**2 * float(u * u - u + Fraction(1, 6))
        total += product
    assert ours == pytest.approx(total / n - 1, rel=1e-12)
    if len(z) == 2:
        h = np.stack(np.meshgrid(*2 * [np.arange(-400, 401)]), axis=-1).reshape(-1, 2)
        dual = h[(h @ np.array(z)) % n == 0]
        series = np.sum(1 / np.prod(np.maximum(1, np.abs(dual)) ** 2.0, axis=1)) - 1
        assert series < ours < series * 1.02


@pytest.mark.parametrize(("n", "d"), [(64, 2), (101, 2), (100, 3)])
def test_the_greatest_distance_is_greatest(n: int, d: int) -> None:
    def least(a: int) -> float:
        x = np.arange(1, n)[:, None] * korobov_vectors(np.array([a]), n, d) % n / n
        return float(np.sqrt((np.minimum(x, 1 - x) ** 2).sum(axis=1)).min())

    best = best_generator(n, d, "distance")
    assert least(best) == pytest.approx(max(least(a) for a in range(1, n) if gcd(a, n) == 1))
    assert merits(korobov_vectors(np.array([best]), n, d), n, "distance")[0] == pytest.approx(-least(best))


def test_rank1_power_is_n_on_the_dual_lattice_and_nothing_elsewhere() -> None:
    n, f = 21, half_space(6, 2)
    z = korobov_vectors(np.array([best_generator(n, 2, "p2")]), n, 2)[0]
    power = direct_power(generate("rank1", n=n, d=2, seed=3), f)
    dual = (f @ z) % n == 0
    assert dual.any()
    assert np.allclose(power[dual], n, rtol=1e-10, atol=0)
    assert power[~dual].max() < 1e-24


def test_radical_inverses_are_mirrored_digits() -> None:
    for base in (2, 3, 5):
        ours = radical_inverse(np.arange(200), base)
        for i in range(200):
            digits, left = [], i
            while left:
                left, digit = divmod(left, base)
                digits.append(digit)
            exact = sum((Fraction(c, base ** (k + 1)) for k, c in enumerate(digits)), Fraction(0))
            assert ours[i] == float(exact)
    assert primes(6) == [2, 3, 5, 7, 11, 13]
    assert primes(0) == []


def test_hammersley_star_discrepancy_grows_like_log_n_over_n() -> None:
    """L2-star of the plain set in 2D, base 2, m digits (Halton & Zaremba 1969): exact."""
    for m in (3, 6, 9):
        n = 2**m
        x = generate("hammersley[shift=false]", n=n, d=2)
        square = Fraction(m * m, 64) + Fraction(29 * m, 192) + Fraction(3, 8)
        square += -Fraction(m, 16 * n) + Fraction(1, 4 * n) - Fraction(1, 72 * n * n)
        assert measures(x)["discrepancy_star"] == pytest.approx(np.sqrt(float(square)) / n, rel=1e-9)


@pytest.mark.parametrize("d", [1, 2, 3, 8, 100])
def test_the_ratio_solves_its_equation_to_all_digits(d: int) -> None:
    ratio, last = Fraction(generalised_golden_ratio(d)), Fraction(1, 10**56)
    assert (ratio - last) ** (d + 1) < ratio - last + 1
    assert (ratio + last) ** (d + 1) > ratio + last + 1


@pytest.mark.parametrize("d", [1, 2, 30])
def test_far_points_of_a_sequence_are_as_exact_as_near_ones(d: int) -> None:
    """Multiples in doubles would be 1e-10 off at the millionth point."""
    x = generate("kronecker[shift=false]", n=300_000 // d, d=d)
    ratio = Fraction(generalised_golden_ratio(d))
    for i in (1, 2, 1000, len(x)):
        for axis in range(d):
            error = (Fraction(float(x[i - 1, axis])) - Fraction(1, 2) - i / ratio ** (axis + 1)) % 1
            assert min(error, 1 - error) < Fraction(1, 2**52)


def test_multiples_of_the_golden_ratio_have_three_gaps() -> None:
    for n in (10, 55, 100, 300_000):
        x = np.sort(generate("kronecker", n=n, d=1, seed=2)[:, 0])
        gaps = np.diff(x, append=x[0] + 1)
        assert len(np.unique(np.round(gaps, 14))) <= 3


def test_a_prefix_is_the_shorter_set() -> None:
    for name in ("kronecker", "pmj02"):
        longer, shorter = (generate(name, n=n, d=2, seed=9) for n in (64, 50))
        assert np.array_equal(longer[:50], shorter)


def test_limits_are_refused() -> None:
    assert "nearest is 1048576" in str(find("rank1").refusal(2**20 + 1, 2))
    assert "d=21" in str(find("rank1").refusal(8, 21))
    assert "d=101" in str(find("kronecker").refusal(8, 101))
    assert "nearest is 4294967296" in str(find("kronecker").refusal(2**32 + 1, 2))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["sobol", "pmj02", "bluenets[iterations=5]", "hammersley", "rank1"])
@pytest.mark.parametrize("kind", ["L2-star", "L2-periodic"])
def test_discrepancy_falls_like_sqrt_log_n_over_n(name: str, kind: Discrepancy) -> None:
    """From 64 to 4,096 points by 64 / sqrt(2) = 45, random points by 8; a quarter is left to four sets."""
    small, large = (
        np.sqrt(np.mean(discrepancies(generate(name, n=n, d=2, realizations=4), [kind])[kind] ** 2))
        for n in (64, 4096)
    )
    assert small / large == pytest.approx(64 / np.sqrt(2), rel=0.25)
