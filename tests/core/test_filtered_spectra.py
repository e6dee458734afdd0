"""Gaussian-filtered spectra: those of a picture into which every point is drawn as a Gaussian."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench import periodogram, radial, shells
from gbnbench.analysis.radial.anisotropy import anisotropy
from gbnbench.cli import run
from gbnbench.core.errors import InputError
from gbnbench.io.points import save


def test_it_is_the_spectrum_of_points_drawn_as_gaussians():
    n, sigma, pixels = 30, 0.4, 128
    x = np.random.default_rng(0).random((n, 2))
    width = sigma / np.sqrt(n)
    at = (np.arange(pixels) + 0.5) / pixels
    drawn = np.zeros((pixels, pixels))
    for point in x:
        across = [sum(np.exp(-((at - c + k) ** 2) / (2 * width**2)) for k in range(-2, 3)) for c in point]
        drawn += np.outer(*across) / (2 * np.pi * width**2)
    transform = np.fft.fft2(drawn) / pixels**2
    spectrum = periodogram(x, 6).filtered(sigma)
    f = np.arange(-6, 7)
    assert spectrum.power == pytest.approx(np.abs(transform[np.ix_(f, f)]) ** 2 / n, rel=1e-9, abs=1e-14)


def test_halves_lists_shells_and_radial_power_are_filtered_alike():
    x = np.random.default_rng(1).random((2, 50, 3))
    whole = periodogram(x, 4).filtered(0.3)
    half = periodogram(x, 4, half=True).filtered(0.3)
    assert half.whole().power == pytest.approx(whole.power, rel=1e-12)
    f = np.array([[1, -2, 3], [0, 0, 0]])
    listed = periodogram(x, frequencies=f).filtered(0.3)
    assert listed.power == pytest.approx(whole.power[tuple((f + 4).T)], rel=1e-12)
    of_shells = shells(x, 4).filtered(0.3)
    assert of_shells.power == pytest.approx(radial(whole).power, rel=1e-12)
    assert radial(periodogram(x, 4)).filtered(0.3).power == pytest.approx(radial(whole).power, rel=1e-12)
    raw, filtered = anisotropy(shells(x, 4)), anisotropy(of_shells)
    assert filtered.anisotropy_db.to_numpy() == pytest.approx(raw.anisotropy_db.to_numpy(), nan_ok=True)


@pytest.mark.parametrize("sigma", [-1, float("nan"), "wide"])
def test_a_width_that_is_none_is_refused(sigma):
    with pytest.raises(InputError, match="sigma"):
        periodogram([[0.5, 0.5]], 1).filtered(sigma)


def test_the_command_filters(tmp_path, capsys):
    x = np.random.default_rng(2).random((40, 2))
    save(tmp_path / "x.txt", x)
    out = tmp_path / "s.npy"
    assert run(["spectrum", str(tmp_path / "x.txt"), "--fmax", "5", "--filter", "0.5", "-o", str(out)]) == 0
    assert np.load(out) == pytest.approx(periodogram(x, 5).filtered(0.5).power, rel=1e-9)
    assert "filtered by a Gaussian of 0.5 spacings" in capsys.readouterr().out
    assert run(["spectrum", str(tmp_path / "x.txt"), "--filter", "-1"]) == 2
