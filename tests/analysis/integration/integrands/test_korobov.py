"""Korobov's functions: values and energies against their Fourier series."""

from __future__ import annotations

import itertools
import math

import mpmath
import numpy as np
import pytest

from gbnbench.analysis.integration.integrands.korobov import Korobov, KorobovProduct
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.integer_frequencies import MOST_FREQUENCIES, half_ball, to_half_space


def series(t: float, smoothness: int) -> mpmath.mpf:
    """Sum over h >= 1 of 2 cos(2 pi h t) / h^smoothness, by the polylogarithm."""
    with mpmath.workdps(30):
        return 2 * mpmath.polylog(smoothness, mpmath.expjpi(2 * mpmath.mpf(t))).real


@pytest.mark.parametrize("smoothness", [2, 4, 6])
@pytest.mark.parametrize("d", [1, 2, 3, 5, 8, 12])
def test_values_are_those_of_the_series(d: int, smoothness: int) -> None:
    rng = np.random.default_rng(d)
    one = Korobov(smoothness, 0.7).draw(d, rng)
    largest = (1 + 1.4 * float(mpmath.zeta(smoothness))) ** d
    for x in rng.random((2, d)):
        factors = [1 + 0.7 * series(t, smoothness) for t in x - one.shift]
        assert one(x[None])[0] == pytest.approx(float(mpmath.fprod(factors)), abs=4e-16 * d * largest)
    assert one.integral == 1


@pytest.mark.parametrize("smoothness", [2, 4, 6])
def test_each_factor_has_mean_one(smoothness: int) -> None:
    one = KorobovProduct(np.zeros(1), smoothness, 1.0)
    at, weights = np.polynomial.legendre.leggauss(8)  # exact for polynomials up to degree 15
    assert weights @ one((at[:, None] + 1) / 2) / 2 == pytest.approx(1, abs=1e-14)


@pytest.mark.parametrize(("d", "m"), [(1, 4096), (2, 1024)])
def test_energy_is_that_of_the_fourier_transform_of_samples(d: int, m: int) -> None:
    one = Korobov(6, 0.5).draw(d, np.random.default_rng(4))
    x = np.stack(np.meshgrid(*[np.arange(m) / m] * d, indexing="ij"), axis=-1)
    f = half_ball(d, 20)
    sampled = np.abs(np.fft.fftn(one(x))[tuple(f.T)] / m**d) ** 2
    assert one.energy(f) == pytest.approx(sampled, rel=1e-9)
    slow = [math.prod(0.25 * abs(h) ** -12.0 if h else 1.0 for h in row) for row in f.tolist()]
    assert one.energy(f) == pytest.approx(slow, rel=1e-14)


@pytest.mark.parametrize(
    ("d", "smoothness", "weight", "share"),
    [(1, 2, 1, 1e-6), (2, 2, 1, 1e-3), (2, 4, 0.1, 1e-8), (3, 4, 1, 1e-5), (5, 6, 1, 1e-6), (8, 4, 0.2, 1e-4),
     (12, 4, 0.1, 1e-3), (5, 4, 3, 0.5)],
)  # fmt: skip
def test_frequencies_leave_out_no_more_than_the_share(
    d: int, smoothness: int, weight: float, share: float
) -> None:
    family = Korobov(smoothness, weight)
    f = family.frequencies(d, share)
    assert (to_half_space(f)[0] == f).all()
    assert f.any(axis=1).all()
    assert len(np.unique(f, axis=0)) == len(f)
    with mpmath.workdps(40):
        total = (1 + 2 * mpmath.mpf(weight) ** 2 * mpmath.zeta(2 * smoothness)) ** d - 1
        kept = 2 * mpmath.fsum(family.mean_energy(f).tolist())
        assert 0 <= float(1 - kept / total) < share
    if d <= 2:  # none left out is stronger than one listed
        listed = {tuple(row) for row in f.tolist()}
        reach = int(np.abs(f).max()) + 1
        cube = np.array(list(itertools.product(range(-reach, reach + 1), repeat=d)))
        out = [row for row in to_half_space(cube)[0].tolist() if any(row) and tuple(row) not in listed]
        assert family.mean_energy(np.array(out)).max() <= family.mean_energy(f).min() * (1 + 1e-12)


def test_too_many_frequencies_are_refused_with_their_number() -> None:
    with pytest.raises(RefusalError, match=f"frequencies, .* at most {MOST_FREQUENCIES} are listed"):
        Korobov().frequencies(12, 1e-6)


def test_settings_out_of_range_are_told() -> None:
    with pytest.raises(InputError, match="smoothness of korobov must be 2, 4 or 6; got 3"):
        Korobov(3)  # type: ignore[arg-type]
    with pytest.raises(InputError, match="weight of korobov must be positive; got 0"):
        Korobov(weight=0)
    with pytest.raises(RefusalError, match="Korobov's functions are for d = 1 to 20; got d=0"):
        Korobov().draw(0, np.random.default_rng(0))


@pytest.mark.parametrize(
    ("smoothness", "weight", "d", "share"),
    [(6, 1.0, 1, 1e-27), (6, 1.0, 2, 1e-27), (4, 1.0, 2, 1e-20), (6, 50.0, 3, 1e-15), (2, 0.01, 1, 1e-12)],
)
def test_shares_far_below_rounding_are_kept_to(smoothness, weight, d, share):
    """1 - 1e-27 is 1 in doubles: what is left out is summed here in 60 digits, frequency by frequency."""
    with mpmath.workdps(60):
        total = (1 + 2 * mpmath.mpf(weight) ** 2 * mpmath.zeta(2 * smoothness)) ** d - 1
        found = Korobov(smoothness, weight).frequencies(d, share)
        kept = mpmath.mpf(0)
        for row in found:
            sizes = [int(abs(h)) for h in row if h]
            energy = mpmath.mpf(weight) ** (2 * len(sizes)) / mpmath.mpf(math.prod(sizes)) ** (2 * smoothness)
            kept += 2 * energy
        assert 0 < (total - kept) / total < share
