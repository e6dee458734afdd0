"""Indicators of balls: volumes in closed form, segments and caps beyond the box, and Fourier series."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import qmc

from gbnbench.analysis.integration.integrands.ball import Ball, Balls
from gbnbench.analysis.integration.integrands.ball_volume import ball_volume, radius_of
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.integer_frequencies import MOST_FREQUENCIES, half_ball


def by_laplace(d: int, radius: float) -> float:
    """Volume by Laplace's transform of the sum of squares, inverted on Talbot's contour in 60 digits.

    L(s) = [sqrt(pi / s) erf(sqrt(s) / 2)]^d / s; erf = 1 - erfc is expanded, and each term, having a factor
    exp(-k s / 4), inverted at rho - k / 4. Fresnel's integrals and Fourier's series play no part.
    """
    with mpmath.workdps(60):
        total, nodes = mpmath.mpf(0), 36
        for k in range(d + 1):
            tau = mpmath.mpf(radius) ** 2 - mpmath.mpf(k) / 4
            if tau <= 0:
                break
            part = mpmath.mpf(0)
            for j in range(nodes):  # half of the contour, which is symmetric about the real axis
                t = (j + mpmath.mpf(1) / 2) * mpmath.pi / nodes
                cot = mpmath.cot(0.6407 * t)
                z = 2 * nodes / tau * (-0.4814 + 0.6122 * t * cot + 0.2645j * t)
                slope = 2 * nodes / tau * (0.6122 * (cot - 0.6407 * t * (1 + cot**2)) + 0.2645j)
                value = mpmath.exp(z * tau) * (mpmath.pi / z) ** (mpmath.mpf(d) / 2) / z
                part += (value * (mpmath.erfc(mpmath.sqrt(z) / 2) * mpmath.exp(z / 4)) ** k * slope / 1j).real
            total += (-1) ** k * math.comb(d, k) * part / nodes
        return float(total)


@pytest.mark.parametrize(
    ("d", "radius"), [(4, 0.57), (5, 0.639), (5, 0.9), (8, 0.811), (12, 0.996), (12, 1.3), (20, 1.288)]
)
def test_volumes_are_those_of_the_inverse_laplace_transform(d: int, radius: float) -> None:
    assert ball_volume(d, radius) == pytest.approx(by_laplace(d, radius), abs=1e-13)


@pytest.mark.parametrize("radius", [0.5 + 1e-9, 0.52, 0.6, 0.7, 0.7071])
def test_discs_and_spheres_lose_their_segments_and_caps(radius: float) -> None:
    with mpmath.workdps(40):
        r, h = mpmath.mpf(radius), mpmath.mpf(radius) - 0.5
        segment = r**2 * mpmath.acos(0.5 / r) - 0.5 * mpmath.sqrt(r**2 - 0.25)
        assert ball_volume(2, radius) == pytest.approx(float(mpmath.pi * r**2 - 4 * segment), abs=1e-15)
        cap = mpmath.pi * h**2 * (3 * r - h) / 3
        assert ball_volume(3, radius) == pytest.approx(float(4 * mpmath.pi / 3 * r**3 - 6 * cap), abs=2e-15)


@pytest.mark.parametrize(
    ("d", "radius"), [(3, 0.75), (3, 0.8), (3, 0.865), (4, 0.53), (4, 0.62), (4, 0.75), (4, 0.97)]
)
def test_a_volume_is_the_integral_of_slices(d: int, radius: float) -> None:
    rho = radius**2
    breaks = sorted({math.sqrt(rho - k / 4) for k in range(1, d) if 0 < rho - k / 4 < 0.25})
    slices, error = quad(
        lambda u: ball_volume(d - 1, math.sqrt(rho - u * u)),
        0,
        0.5,
        points=breaks or None,
        epsabs=1e-13,
        limit=400,
    )
    assert ball_volume(d, radius) == pytest.approx(2 * slices, abs=2e-13 + 2 * error)
    assert error < 1e-10


@pytest.mark.parametrize("d", [1, 2, 3, 4, 5, 8, 12, 20])
@pytest.mark.parametrize("volume", [0.02, 0.5, 0.97])
def test_balls_hold_their_share_of_points(d: int, volume: float) -> None:
    radius = radius_of(d, volume)
    assert ball_volume(d, radius) == pytest.approx(volume, abs=3e-15)
    ball = Balls(volume).draw(d, np.random.default_rng(d))
    assert ball.integral == pytest.approx(volume, abs=3e-15)
    assert ball(qmc.Sobol(d, seed=2).random_base2(15)).mean() == pytest.approx(volume, abs=0.006)


def test_a_ball_reaches_across_the_edges() -> None:
    ball = Ball(np.array([0.95, 0.02]), 0.1)
    assert ball(np.array([[0.0, 0.0], [0.9, 0.97], [0.04, 0.02], [0.5, 0.5], [0.06, 0.02]])).tolist() == [
        1,
        1,
        1,
        0,
        0,
    ]


@pytest.mark.parametrize("radius", [0.1, 0.37, 0.5])
def test_energy_is_that_of_quadrature(radius: float) -> None:
    f = np.arange(9)[:, None]
    line = [
        (2 * radius if k == 0 else math.sin(2 * math.pi * k * radius) / (math.pi * k)) ** 2 for k in range(9)
    ]
    assert Ball(np.array([0.3]), radius).energy(f) == pytest.approx(line, abs=1e-15)
    disc = Ball(np.array([0.3, 0.9]), radius)
    for k in (1, 2, 5):  # slices across the axis of f, smooth in the angle
        value, _ = quad(
            lambda t, k=k: math.cos(2 * math.pi * k * radius * math.sin(t)) * 2 * (radius * math.cos(t)) ** 2,
            -math.pi / 2, math.pi / 2, epsabs=1e-14,
        )  # fmt: skip
        assert disc.energy(np.array([[k, 0], [0, -k]])) == pytest.approx([value**2] * 2, abs=1e-14)
    assert disc.energy(np.array([[3, 4]])) == pytest.approx(disc.energy(np.array([[5, 0]])), rel=1e-13)


@pytest.mark.parametrize(
    ("d", "volume", "share"), [(1, 0.5, 0.01), (2, 0.5, 0.02), (2, 0.01, 0.1), (3, 0.5, 0.03), (5, 0.01, 0.4)]
)
def test_frequencies_leave_out_no_more_than_the_share(d: int, volume: float, share: float) -> None:
    family = Balls(volume)
    f = family.frequencies(d, share)
    square = (f**2).sum(axis=1)
    energy = 2 * family.mean_energy(f)
    total = volume * (1 - volume)  # Parseval
    assert 0 < 1 - energy.sum() / total < share
    assert 1 - energy[square < square.max()].sum() / total >= share
    assert len(half_ball(d, int(square.max()))) == len(f)


def test_what_is_not_known_or_too_much_is_refused() -> None:
    with pytest.raises(
        RefusalError, match=r"up to radius 1/2, .* got 0.5696 in d=4: take a volume up to 0.308"
    ):
        Balls().frequencies(4, 0.1)
    with pytest.raises(RefusalError, match=f"at most {MOST_FREQUENCIES} are listed"):
        Balls().frequencies(3, 1e-3)
    with pytest.raises(RefusalError, match="radius 1/2"):
        Balls().draw(8, np.random.default_rng(0)).energy(np.ones((1, 8), dtype=np.int64))
    with pytest.raises(InputError, match=r"volume of ball must be a share .* got 1"):
        Balls(1.0)
    with pytest.raises(RefusalError, match="balls are for d = 1 to 20; got d=30"):
        Balls().draw(30, np.random.default_rng(0))
