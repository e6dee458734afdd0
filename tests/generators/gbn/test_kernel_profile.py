"""The kernel's profile against mpmath's theta function, and truncated transforms against quadrature."""

from __future__ import annotations

import math

import mpmath
import numpy as np
import pytest

from gbnbench.core.errors import InputError
from gbnbench.generators.gbn.kernel_profile import energy_profile, theta, truncated_transform
from tests.oracles.theta import jacobi


@pytest.mark.parametrize(("side", "sigma"), [(0.7, 1.0), (2.4, 1.0), (2.6, 1.0), (8.0, 1.3), (40.0, 1.0)])
def test_the_profile_is_jacobis_theta(side, sigma):
    u = np.linspace(-side, 2 * side, 25)
    with mpmath.workdps(30):
        exact = [float(jacobi(mpmath.mpf(float(v)) / side, mpmath.mpf(sigma) / side)) for v in u]
    assert theta(u, side, sigma) == pytest.approx(exact, rel=0, abs=4e-16 * max(exact))
    largest = max(theta(np.zeros(1), side, sigma))
    assert energy_profile(u, side, sigma) == pytest.approx(np.array(exact) / largest, rel=0, abs=1e-15)
    assert energy_profile(np.array([0.0, side]), side, sigma) == pytest.approx([1, 1])


@pytest.mark.parametrize("cutoff", [0.5, 1.0, 2.0, 3.0, 6.0])
def test_truncated_transforms_agree_with_quadrature(cutoff):
    sigma = 0.8
    nu = np.array([0.0, 1e-3, 0.1, 0.25, 0.6, 2.0])
    line, plane = (truncated_transform(nu, sigma, cutoff, d) for d in (1, 2))

    def gauss(r):
        return mpmath.exp(-r * r / (2 * mpmath.mpf(sigma) ** 2))

    with mpmath.workdps(25):
        panels = mpmath.linspace(0, cutoff * sigma, 20)
        for k, v in enumerate(nu):
            w = 2 * mpmath.pi * mpmath.mpf(float(v))
            one = 2 * mpmath.quad(lambda r, w=w: gauss(r) * mpmath.cos(w * r), panels)
            two = 2 * mpmath.pi * mpmath.quad(lambda r, w=w: r * gauss(r) * mpmath.besselj(0, w * r), panels)
            assert line[k] == pytest.approx(float(one), rel=0, abs=1e-14 * line[0])
            assert plane[k] == pytest.approx(float(two), rel=0, abs=1e-14 * plane[0])


def test_the_whole_gaussian_and_its_truncations_meet():
    nu = np.linspace(0, 1, 11)
    for d in (1, 2):
        whole = truncated_transform(nu, 1.0, math.inf, d)
        assert whole == pytest.approx((2 * np.pi) ** (d / 2) * np.exp(-2 * np.pi**2 * nu**2), rel=1e-13)
        assert truncated_transform(nu, 1.0, 9.0, d) == pytest.approx(whole, rel=0, abs=1e-13)
    far = np.abs(truncated_transform(np.array([3.0]), 1.0, 1.0))[0]
    assert (
        far > 1e3 * np.abs(truncated_transform(np.array([3.0]), 1.0, 6.0))[0]
    )  # Fig. 4: a shorter range leaks more


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ((1.0, 1.0, 3), "d must be 1 or 2; got 3"),
        ((-1.0, 1.0), "sigma and cutoff must be positive"),
        ((1.0, 20.0), "cutoff up to 12, or inf"),
    ],
)
def test_what_has_no_transform_is_refused(arguments, says):
    with pytest.raises(InputError, match=says):
        truncated_transform(np.zeros(1), *arguments)
    with pytest.raises(InputError, match="side and sigma"):
        theta(np.zeros(1), 0.0, 1.0)
