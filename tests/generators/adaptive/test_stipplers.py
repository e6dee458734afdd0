"""What defines each other stippler: centroids, one dot's ink a cell, thresholds and diffused errors."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.spatial import cKDTree

from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.dithering.error_diffusion import diffuse
from gbnbench.generators.adaptive.registry import adaptive_points
from gbnbench.generators.adaptive.voronoi.weighted_cells import CellParts

RAMP = as_density(np.linspace(0.2, 1, 40)[:, None] * np.ones(30))


@pytest.mark.parametrize("toroidal", [False, True])
def test_cells_are_those_of_a_plain_search(toroidal):
    density = as_density(RAMP.values, toroidal=toroidal)
    x = np.random.default_rng(0).random((20, 2)) * density.shape
    parts = CellParts(density, 20)
    cells = parts.cells(x)
    apart = parts.places[:, None] - x
    if toroidal:
        apart -= np.array(density.shape) * np.rint(apart / density.shape)
    nearest = (apart**2).sum(axis=2).argmin(axis=1)
    assert (cells.nearest == nearest).all()
    assert cells.masses.sum() == pytest.approx(20)
    for k in range(20):
        own = nearest == k
        centroid = (parts.masses[own, None] * apart[own, k]).sum(axis=0) / parts.masses[own].sum()
        assert cells.moves[k] == pytest.approx(centroid, abs=1e-12)


def test_secord_ends_at_centroids():
    x = adaptive_points("secord[iterations=400,tolerance=0.0005]", RAMP, 60)
    moves = CellParts(RAMP, 60).cells(x).moves
    assert np.sqrt((moves**2).sum(axis=1).mean()) < 0.01  # pixels; the spacing is 4.5


def test_cells_of_lbg_have_about_one_dot():
    masses = CellParts(RAMP, 60).cells(adaptive_points("lbg", RAMP, 60)).masses
    assert masses.sum() == pytest.approx(60)
    assert masses.min() > 0.4
    assert masses.max() < 1.8


def test_lbg_depends_on_the_seed():
    sets = [adaptive_points("lbg", RAMP, 60, seed=1, realization=k) for k in (0, 1)]
    again = adaptive_points("lbg", RAMP, 60, seed=1)
    assert (sets[0] == again).all()
    away = cKDTree(sets[0]).query(sets[1])[0]
    assert np.median(away) > 1  # pixels; the spacing is 4.5, and that of unrelated sets would leave 1.7


def test_a_cell_splits_along_its_longest_axis():
    wide = as_density(np.ones((4, 40)))
    directions, deviations = CellParts(wide, 1).cells(np.array([[2.0, 20.0]])).main_axes()
    assert np.abs(directions[0]) == pytest.approx([0, 1], abs=1e-9)
    assert deviations[0] == pytest.approx(40 / np.sqrt(12), rel=1e-3)


def test_the_pixels_of_a_mask_are_those_above_its_thresholds():
    flat = as_density(np.ones((64, 64)))
    x = adaptive_points("voidcluster[side=32]", flat, 512)
    ones = np.zeros((64, 64), bool)
    ones[tuple(x.astype(int).T)] = True
    assert ones.sum() == 512
    assert (ones[:32, :32] == ones[32:, 32:]).all()  # two of four tiles


def test_diffused_errors_are_floyd_and_steinbergs():
    density = np.random.default_rng(2).random((5, 6)) * 0.6
    black, _ = diffuse(density, np.full(density.shape, 0.5))
    left, expected = density.copy(), np.zeros(density.shape, bool)
    for i in range(5):
        step = 1 if i % 2 == 0 else -1
        for j in range(6)[::step]:
            expected[i, j] = left[i, j] >= 0.5
            error = left[i, j] - expected[i, j]
            for down, along, share in ((0, step, 7), (1, -step, 3), (1, 0, 5), (1, step, 1)):
                if i + down < 5 and 0 <= j + along < 6:
                    left[i + down, j + along] += error * share / 16
    assert (black == expected).all()


@pytest.mark.parametrize("name", ["floydsteinberg", "voidcluster[side=16]"])
def test_halftones_of_volumes_are_refused(name):
    from gbnbench.core.errors import RefusalError

    with pytest.raises(RefusalError, match="two axes"):
        adaptive_points(name, as_density(np.ones((4, 4, 4))), 5)
