"""The optimiser reaches the paper's quality; settings are checked; the low band's preconditioner is right."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.radial import profile_measures
from gbnbench.analysis.radial.radial_power import radial
from gbnbench.analysis.spatial.distances import min_distance
from gbnbench.analysis.spatial.valence import valence6
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.errors import InputError
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.generator import GaussianBlueNoise
from gbnbench.generators.gbn.lowest_band import LowestBandPreconditioner
from gbnbench.generators.gbn.step_sizes import gaussian_curvature, largest_curvature, step_size
from gbnbench.generators.protocol import realization_rng


@pytest.fixture(scope="module")
def spectrum():
    return periodogram(GaussianBlueNoise()(1024, 2, realization_rng(1, 0)), 64)


def test_three_hundred_gradients_reach_the_papers_ten_thousand_steps(spectrum):
    """The authors' ten sets of 1,024 points, 10,000 steps: P(1) 3.3e-10, floor 6.6e-10, peak 2.14."""
    shells = radial(spectrum)
    assert profile_measures.power_at_1(shells) < 3e-9
    assert profile_measures.noise_floor(shells) < 2e-9
    assert 1.8 < profile_measures.peak(shells)[0] < 2.9


def test_the_profile_is_the_papers_equation_19(spectrum):
    fit = profile_measures.exponential_fit(radial(spectrum))
    assert fit.slope == pytest.approx(4 * math.pi**2, rel=0.03)
    assert fit.residual_db < profile_measures.powerlaw_fit(radial(spectrum)).residual_db / 2


def test_the_papers_descent_is_slower_by_the_published_factor():
    """In 2D, k accelerated gradients do the work of about k^2/9 steps: 60 of them against 400."""
    excess = {}
    for name, maker in {
        "descent": GaussianBlueNoise(iterations=400),
        "accelerated": GaussianBlueNoise(gradients=60),
    }.items():
        excess[name] = energy_evaluation(256, 2, 1.0)(maker(256, 2, realization_rng(2, 0))[None]).excess[0]
    assert excess["accelerated"] == pytest.approx(excess["descent"], rel=0.6)


@pytest.mark.parametrize(("n", "d", "floor"), [(16, 2, 1e-7), (216, 3, 1e-7), (200, 8, 1e-6), (64, 1, 1e-6)])
def test_other_dimensions_and_small_sets_reach_deep_floors(n, d, floor):
    x = GaussianBlueNoise(gradients=200)(n, d, realization_rng(3, 0))
    assert (
        profile_measures.noise_floor(radial(periodogram(x, max(1, n // 4) if d == 1 else 1 if d == 8 else 4)))
        < floor
    )


def test_it_stops_at_the_excess_asked_for():
    x = GaussianBlueNoise(excess=1e-3)(256, 2, realization_rng(4, 0))
    assert 2e-4 < energy_evaluation(256, 2, 1.0)(x[None]).excess[0] <= 1e-3


def test_a_kernel_cut_off_runs_through_though_its_energy_falls_below_uniform_points():
    """Within one sigma the sets become as regular as centroidal tessellations (Section 4.4)."""
    x = GaussianBlueNoise(cutoff=1.0)(256, 2, realization_rng(7, 0))
    at = energy_evaluation(256, 2, 1.0, cutoff=1.0)(x[None])
    assert at.excess[0] < -0.01
    assert valence6(x) > 0.75
    assert min_distance(x) > 0.8


@pytest.mark.parametrize("n", [1, 2, 3])
def test_the_smallest_sets_spread_out(n):
    x = GaussianBlueNoise()(n, 2, realization_rng(5, 0))
    assert x.shape == (n, 2)
    if n == 2:  # the farthest that two points of the unit torus can be apart
        difference = x[0] - x[1]
        assert np.abs(np.abs(difference - np.rint(difference)) - 0.5).max() < 1e-3


def test_the_curvature_is_the_published_one():
    assert largest_curvature(10**6, 2, 1.0) == pytest.approx(4.62, abs=0.01)
    assert step_size(1024, 2, 1.0) == pytest.approx(1.2 / 4.62, rel=0.01)


@pytest.mark.slow
def test_long_boxes_of_few_points_converge_too():
    x = GaussianBlueNoise()(1024, 1, realization_rng(0, 0))
    assert profile_measures.power_at_1(radial(periodogram(x, 4))) < 1e-20


def test_a_mode_of_the_low_band_is_divided_by_its_own_curvature():
    n, sigma, size = 900, 1.0, 0.26
    side = 30.0
    x = (np.stack(np.meshgrid(*[np.arange(30)] * 2, indexing="ij"), -1).reshape(-1, 2) + 0.5) / 30
    band = LowestBandPreconditioner(n, 2, gaussian_curvature(2, sigma))
    for f, inside in (([1, 2], True), ([4, -1], True), ([5, 0], False)):
        q = 2 * np.pi * np.array(f) / side
        q2 = q @ q
        along = q / np.sqrt(q2)
        wave = np.cos(2 * np.pi * x @ f + 0.3)[:, None]
        curvature = q2 * 2 * np.pi * sigma**2 * np.exp(-(sigma**2) * q2 / 2)
        expected = (1 / curvature - size) * wave * along if inside else np.zeros((n, 2))
        assert band.correction(x, wave * along, size) == pytest.approx(expected, abs=1e-4)
        across = np.array([-along[1], along[0]])
        assert band.correction(x, wave * across, size) == pytest.approx(np.zeros((n, 2)), abs=1e-4)


@pytest.mark.parametrize(
    ("settings", "says"),
    [
        ({"sigma": 0.1}, r"sigma must lie in \[0\.3, 3\] spacings"),
        ({"sigma": math.nan}, "sigma"),
        ({"gradients": -1}, "gradients"),
        ({"iterations": -1}, "iterations"),
        ({"excess": -1.0}, "excess"),
        ({"cutoff": -1.0}, "cutoff"),
        ({"edge": math.inf}, "edge"),
        ({"edge": 0.5, "cutoff": 2.0}, "in space or in frequency"),
        ({"method": "nesterov", "iterations": 5}, "iterations count the steps of method=descent"),
        ({"step": "fast"}, "step must be auto, authors or a number"),
        ({"step": "-1"}, "step must be"),
    ],
)
def test_settings_out_of_range_are_refused(settings, says):
    with pytest.raises(InputError, match=says):
        GaussianBlueNoise(**settings)


def test_polish_empties_the_lowest_band_and_leaves_the_order():
    plain, polished = (GaussianBlueNoise(polish=edge)(1024, 2, realization_rng(6, 0)) for edge in (0.0, 0.25))
    moved = np.abs(polished - plain)
    assert np.minimum(moved, 1 - moved).max() * 32 < 1e-4  # spacings
    before, after = (radial(periodogram(x, 64)) for x in (plain, polished))
    assert profile_measures.noise_floor(after) < 1e-26 < 1e-10 < profile_measures.noise_floor(before)
    assert profile_measures.peak(after)[0] == pytest.approx(profile_measures.peak(before)[0], rel=1e-3)


def test_steps_are_stable_in_small_boxes_of_high_dimension():
    """Stream 0 of seed 20 once kept P = 1.1e-7 at |f| = 1 where 47 others had 5e-11: a step 11% too long."""
    x = GaussianBlueNoise(gradients=300)(256, 8, realization_rng(20, 0))
    power = periodogram(x, frequencies=np.eye(8, dtype=np.int64)).power
    assert power.mean() < 1e-9


@pytest.mark.slow
def test_float_forces_reach_what_double_does():
    """The excess energy is noisy in float; that must not shorten the step."""
    x = GaussianBlueNoise(gradients=900, precision="float")(256, 2, realization_rng(0, 0))
    y = GaussianBlueNoise(gradients=900)(256, 2, realization_rng(0, 0))
    floor = [profile_measures.noise_floor(radial(periodogram(points, 8))) for points in (x, y)]
    assert floor[0] < 2 * floor[1]


def test_the_authors_step_is_theirs():
    """0.25 / n on coordinates of the box: one step of descent by hand."""
    n, d = 50, 3
    x = realization_rng(7, 0).random((n, d))
    moved = GaussianBlueNoise(iterations=1, step="authors")(n, d, realization_rng(7, 0))
    spacing = n ** (-1 / d)
    force = energy_evaluation(n, d, 1.0)(x[None]).gradient[0] / spacing  # by coordinates of the box
    assert moved == pytest.approx(np.mod(x - 0.25 / n * force, 1.0), abs=1e-12)
