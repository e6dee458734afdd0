"""Anisotropy: unbiased on isotropic noise of any profile, and right on a known directional spectrum."""

from __future__ import annotations

import math
from fractions import Fraction

import numpy as np
import pytest

from gbnbench.analysis.radial.anisotropy import anisotropy, anisotropy_db
from gbnbench.analysis.spectrum.shells import exact_shells
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.results.spectrum import Spectrum

FMAX, N = 24, 24**2


def noise(rng, sets, profile):
    """Mean of exponentially distributed powers, equal at f and -f: what |F|^2 of disordered sets is."""
    size = 2 * FMAX + 1
    half = rng.exponential(size=(sets, size * size // 2)).mean(axis=0)
    cube = np.concatenate([half, [N], half[::-1]]).reshape(size, size)
    f = np.indices((size, size)) - FMAX
    return cube * profile(np.hypot(*f) / FMAX)


@pytest.mark.parametrize("sets", [1, 2, 10, 32])
@pytest.mark.parametrize("profile", [lambda nu: np.ones_like(nu), lambda nu: np.exp(20 * nu**2)])
def test_isotropic_noise_reads_minus_ten_log_m_at_every_m_and_on_steep_profiles(sets, profile):
    rng = np.random.default_rng(sets)
    shells = exact_shells(FMAX, 2)
    linear = [
        10 ** (anisotropy_db(noise(rng, sets, profile), shells, sets, 1 / FMAX) / 10) for _ in range(60)
    ]
    error = np.std(linear) / np.sqrt(60)
    assert np.mean(linear) == pytest.approx(1 / sets, abs=max(4 * error, 0.03 / sets))


def test_a_directional_spectrum_reads_its_own_variance():
    f = np.indices((2 * FMAX + 1,) * 2) - FMAX
    angle = np.arctan2(f[1], f[0])
    power = 1 + 0.5 * np.cos(2 * angle)
    sets = 10**9  # no noise: what is left is the variance 0.125 of the cosine itself
    assert anisotropy_db(power, exact_shells(FMAX, 2), sets, 1 / FMAX) == pytest.approx(
        10 * np.log10(0.125), abs=1.2
    )
    rings = anisotropy(Spectrum(power, n=N, d=2, realizations=sets, fmax=FMAX))
    assert list(rings.columns) == ["frequency", "nu", "anisotropy_db", "psa_db"]
    outer = rings[rings["nu"] > 0.5]
    assert outer["psa_db"].mean() == pytest.approx(10 * np.log10(0.125), abs=0.3)


def test_psas_form_takes_a_slope_within_a_ring_for_anisotropy_and_ours_does_not():
    f = np.indices((2 * FMAX + 1,) * 2) - FMAX
    power = np.exp(20 * (np.hypot(*f) / FMAX) ** 2)
    rings = anisotropy(Spectrum(power, n=N, d=2, realizations=10**9, fmax=FMAX))
    at = rings["nu"].between(0.5, 0.9)
    assert rings["psa_db"][at].min() > -25
    assert rings["anisotropy_db"][at].max() < -100


def test_powers_that_differ_in_their_last_digits_have_their_exact_variance():
    """Departures of 1e-12 about 1e6: the mean square less the square of the mean would be rounding alone."""
    rng = np.random.default_rng(3)
    size = 2 * FMAX + 1
    half = 1e6 * (1 + 1e-12 * rng.integers(0, 1000, size * size // 2))
    power = np.concatenate([half, [N], half[::-1]]).reshape(size, size)
    rings = anisotropy(Spectrum(power, n=N, d=2, realizations=1, fmax=FMAX)).set_index("frequency")
    square = np.sum((np.indices((size, size)) - FMAX) ** 2, axis=0).ravel()[: size * size // 2]
    inside = square <= FMAX**2
    for k in (3, 10, 20):
        ring = [Fraction(float(p)) for p in half[inside & (np.rint(np.sqrt(square)) == k)]]
        mean = sum(ring) / len(ring)
        variance = sum((p - mean) ** 2 for p in ring) / (len(ring) - 1) / mean**2
        assert rings["psa_db"][k] == pytest.approx(10 * math.log10(variance), abs=1e-6)


def test_rounding_off_a_lattices_harmonics_is_no_direction():
    f = np.indices((2 * FMAX + 1,) * 2) - FMAX
    power = np.random.default_rng(1).exponential(1e-30, f[0].shape)
    power[(f % 16 == 0).all(axis=0)] = 256
    rings = anisotropy(Spectrum(power, n=256, d=2, realizations=1, fmax=FMAX)).set_index("frequency")
    assert np.isnan(rings["anisotropy_db"].drop([16, 23])).all()  # |f| = 16 and 16 sqrt 2
    assert rings["anisotropy_db"][16] == -np.inf  # four equal powers
    with pytest.raises(RefusalError, match="most frequencies"):
        anisotropy_db(power, exact_shells(FMAX, 2), 1, 1 / 16)


def test_where_no_shell_has_two_directions_it_is_refused():
    with pytest.raises(RefusalError, match="two independent frequencies"):
        anisotropy_db(np.ones(9), exact_shells(4, 1), 1, 0.25)
    with pytest.raises(InputError, match="whole cube"):
        anisotropy(Spectrum(np.ones(1), n=1, d=2, realizations=1, fmax=1, frequencies=np.array([[1, 0]])))
