"""Radial power against a loop over frequencies, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.core.errors import InputError
from gbnbench.core.results.spectrum import Spectrum


def test_radial_power_is_the_mean_over_each_shell():
    rng = np.random.default_rng(1)
    power = rng.random((9, 9, 9))
    frame = radial(Spectrum(power, n=27, d=3, realizations=1, fmax=4)).to_frame()
    assert list(frame.columns) == ["frequency", "nu", "power", "count"]
    groups: dict[int, list[float]] = {}
    for f in np.ndindex(9, 9, 9):
        r2 = sum((c - 4) ** 2 for c in f)
        if 0 < r2 <= 16:
            groups.setdefault(r2, []).append(power[f])
    assert frame["frequency"].to_numpy() == pytest.approx(np.sqrt(sorted(groups)), rel=1e-15)
    assert frame["power"].to_numpy() == pytest.approx([np.mean(groups[k]) for k in sorted(groups)], rel=1e-13)
    assert frame["count"].tolist() == [len(groups[k]) for k in sorted(groups)]
    assert frame["nu"].to_numpy() == pytest.approx(frame["frequency"].to_numpy() / 3)


def test_jittered_sets_follow_their_closed_form():
    m, sets = 8, 400
    rng = np.random.default_rng(2)
    corners = np.stack(np.meshgrid(*[np.arange(m)] * 2, indexing="ij"), axis=-1).reshape(-1, 2)
    x = (corners + rng.random((sets, m * m, 2))) / m
    spectrum = periodogram(x, 10)
    f = np.indices((21, 21)) - 10
    expected = 1 - np.prod(np.sinc(f / m) ** 2, axis=0)  # E P of stratified sets, DC apart
    expected[(f % m == 0).all(axis=0)] = np.nan  # and their grid's own harmonics
    ratio = (spectrum.power / expected)[np.isfinite(expected) & (expected > 0)]
    assert ratio.mean() == pytest.approx(1, abs=5 / np.sqrt(sets * 200))


def test_by_digits_and_annuli_hold_the_same_total():
    spectrum = periodogram(np.random.default_rng(3).random((50, 3)), 4)
    shells = radial(spectrum)
    total = (shells.power * shells.count).sum()
    for other in (radial(spectrum, by="digits"), radial(spectrum, by="annuli", width=1.5)):
        assert (other.power * other.count).sum() == pytest.approx(total, rel=1e-13)
        assert (np.diff(other.frequency) >= 0).all()


@pytest.mark.parametrize(
    ("arguments", "says"),
    [({"by": "rings"}, "shells, pooled, digits, annuli"), ({"by": "annuli", "width": 0}, "positive")],
)
def test_bad_requests_are_refused(arguments, says):
    with pytest.raises(InputError, match=says):
        radial(periodogram([[0.5, 0.5]], 2), **arguments)


def test_listed_frequencies_have_no_shells():
    with pytest.raises(InputError, match="whole cube"):
        radial(periodogram([[0.5, 0.5]], frequencies=[[1, 0]]))


def test_shells_are_radial_power_already_and_what_is_no_spectrum_is_refused():
    x = np.random.default_rng(5).random((40, 3))
    assert np.allclose(radial(shells(x, 4)).power, radial(periodogram(x, 4)).power, rtol=1e-12)
    with pytest.raises(InputError, match="by="):
        radial(shells(x, 4), by="digits")
    with pytest.raises(InputError, match="ndarray"):
        radial(x)
