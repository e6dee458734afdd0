"""Stealthy sets: an empty band by both methods, disorder beyond it, one dimension's blue noise, refusals."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.generators.gauss_newton.modes import edge_binding
from gbnbench.generators.monitor import Monitor
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import generate
from gbnbench.generators.spectral_control.empty_band import band_power
from gbnbench.generators.spectral_control.stealthy import Stealthy


def below(x, edge):
    """Power at every frequency with 0 < nu < edge, and just beyond, by the exact periodogram."""
    n, d = x.shape
    fmax = int(1.3 * edge * n ** (1 / d)) + 1
    power = periodogram(x, fmax).power
    nu = np.sqrt(((np.indices(power.shape) - fmax) ** 2).sum(axis=0)) * n ** (-1 / d)
    return power[(nu > 0) & (nu < edge * (1 - 1e-9))], power[(nu > 1.05 * edge) & (nu < 1.25 * edge)]


@pytest.mark.parametrize(
    ("n", "d", "edge"),
    [
        (256, 2, 0.5),
        (256, 2, None),
        (200, 3, None),
        (128, 1, None),
        (128, 1, 0.1),
        (64, 5, None),
        (36, 2, 0.4),
    ],
)
def test_newton_empties_the_band_to_rounding(n, d, edge):
    x = Stealthy(edge=edge)(n, d, realization_rng(1, 0))
    inside, beyond = below(x, edge_binding(0.6, d) if edge is None else edge)
    assert inside.max() < 1e-26
    assert beyond.mean() > 0.05  # the edge is a step


@pytest.mark.parametrize(("n", "d", "edge"), [(256, 2, 0.5), (200, 3, 0.6), (64, 1, 0.3)])
def test_the_truncated_energy_empties_it_to_the_power_asked_for(n, d, edge):
    x = Stealthy(edge=edge, method="harmonics", power=1e-10)(n, d, realization_rng(2, 0))
    inside, beyond = below(x, edge)
    assert inside.max() <= 1.001e-10
    assert beyond.mean() > 0.05


def test_the_bars_in_the_plane():
    """n = 1024: nu <= 0.5 to 1e-25, the paper's almost perfect step; flat, and disordered."""
    x = np.stack([Stealthy(edge=0.5)(1024, 2, realization_rng(s, 0)) for s in (0, 1)])
    shells = radial(periodogram(x, 48))
    assert shells.power[shells.nu < 0.5].max() < 1e-25
    assert 0.7 < np.average(shells.power[shells.nu > 0.55], weights=shells.count[shells.nu > 0.55]) < 1.5


def test_band_power_is_the_periodograms():
    x = np.random.default_rng(0).random((40, 2))
    assert np.sort(np.repeat(band_power(x, 1.3), 2)) == pytest.approx(np.sort(below(x, 1.3)[0]), rel=1e-9)


def test_one_dimension_has_blue_noise_below_half_and_none_of_the_grids_order():
    """Fig. 13: the mean periodogram of sets is 0 in the band, then rises; no spike at nu = 1 as in a grid."""
    x = np.stack([Stealthy(edge=0.3, gradients=150)(64, 1, realization_rng(s, 0)) for s in range(16)])
    power = periodogram(x, 128).power[128:]
    nu = np.arange(129) / 64
    assert power[1:19].max() < 1e-26  # nu < 0.3
    assert power[22:].min() > 0.05
    assert 0.7 < power[(nu > 0.4) & (nu < 2)].mean() < 1.7
    assert power[64] < 12  # a grid has 64 there


def test_one_dimension_without_an_edge_descends_to_the_grid():
    """Supplement B: the whole energy's least is the regular grid, and nothing is in its way."""
    spread = []
    for gradients in (0, 100, 1500):
        x = np.sort(generate("gbn", n=32, d=1, realizations=3, gradients=gradients)[..., 0], axis=1)
        gaps = np.diff(np.concatenate([x, x[:, :1] + 1], axis=1), axis=1) * 32
        spread.append(gaps.std(axis=1).max())
    assert spread[0] > 0.5
    assert spread[1] < 0.3
    assert spread[2] < 0.05


def test_equal_shares_give_the_edge_of_each_dimension():
    assert edge_binding(0.8, 1) == pytest.approx(0.4)
    assert edge_binding(np.pi / 8, 2) == pytest.approx(0.5)
    assert edge_binding(0.5, 3) == pytest.approx((0.5 * 3 / (4 * np.pi / 3)) ** (1 / 3))


@pytest.mark.parametrize(("d", "edge"), [(1, 0.6), (2, 0.85), (3, 1.0)])
def test_edges_that_bind_every_coordinate_are_refused(d, edge):
    with pytest.raises(RefusalError, match="lower the edge"):
        Stealthy(edge=edge)(512, d, realization_rng(0, 0))


@pytest.mark.slow
def test_a_band_that_is_not_reached_is_never_returned():
    with pytest.raises(RefusalError, match="after 20 gradients"):
        Stealthy(edge=0.6, method="harmonics", most=20)(256, 2, realization_rng(0, 0))
    with pytest.raises(RefusalError, match="could not be brought to 0"):
        Stealthy(edge=0.45, gradients=0)(256, 1, realization_rng(0, 0))


@pytest.mark.parametrize(
    ("n", "d", "edge", "core"), [(256, 2, None, 0.8), (150, 3, None, 0.8), (64, 1, 0.2, 0.7)]
)
def test_a_core_keeps_points_apart_and_the_band_empty(n, d, edge, core):
    from scipy.spatial import cKDTree

    x = Stealthy(edge=edge, core=core)(n, d, realization_rng(3, 0))
    assert below(x, edge_binding(0.6, d) if edge is None else edge)[0].max() < 1e-26
    nearest = cKDTree(x, boxsize=np.ones(d)).query(x, k=2)[0][:, 1].min()
    assert nearest * n ** (1 / d) >= core


def test_half_the_plane_is_covered_where_two_thirds_were_published():
    """Kim & Torquato cover at most 0.67 of the plane at chi = 0.45; a core of 0.8 spacings covers 0.50."""
    edge = edge_binding(0.9, 2)
    x = Stealthy(edge=edge, core=0.8)(200, 2, realization_rng(0, 0))
    assert below(x, edge)[0].max() < 1e-26


@pytest.mark.slow
def test_a_core_that_is_not_reached_is_refused():
    with pytest.raises(RefusalError, match=r"n=36 points in d=2 .* no farther apart than .* core=1.05"):
        Stealthy(edge=0.6, core=1.05)(36, 2, realization_rng(0, 0))
    with pytest.raises(InputError, match="a core needs method=newton"):
        Stealthy(core=0.5, method="harmonics")


@pytest.mark.parametrize(
    "settings",
    [{"core": -1.0}, {"edge": 0.0}, {"edge": np.nan}, {"gradients": -1}, {"most": -1}, {"power": 0.0}],
)
def test_settings_out_of_range_are_refused(settings):
    with pytest.raises(InputError, match=next(iter(settings))):
        Stealthy(**settings)


def test_sets_are_the_same_drawn_alone_or_together_and_say_how_far_they_are():
    for settings in ({}, {"method": "harmonics"}):
        told: list[tuple[int, int, str]] = []
        monitor = Monitor(progress=lambda *now, told=told: told.append(now))
        together = generate("stealthy", n=100, seed=2, realizations=2, monitor=monitor, **settings)
        assert np.array_equal(together[0], generate("stealthy", n=100, seed=2, **settings))
        assert {total for _, total, _ in told} == {200}
        assert all(done < total for done, total, _ in told)
        assert told[-1][0] >= 100
        assert "set 2" in told[-1][2]
