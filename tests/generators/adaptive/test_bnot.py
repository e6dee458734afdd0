"""Weighted BNOT: cells are measured exactly, get equal shares of the density, and cost less each time."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench import measures
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.power_cells.density_diagram import DensityDiagrams
from gbnbench.generators.adaptive.registry import adaptive_generator, adaptive_points
from gbnbench.generators.power_cells.diagram import power_diagram
from gbnbench.generators.power_cells.equal_areas import equal_masses

RAMP = as_density(np.linspace(0.2, 1, 40)[:, None] * np.ones(30))


def plain_cells(density, x, weight, parts=30):
    """Mass and moment of each cell: every pixel cut into parts, each given to the point of least power."""
    fine = density.finer(parts)
    places = (np.argwhere(fine.values >= 0) + 0.5) / parts
    apart = places[:, None] - x
    if density.toroidal:
        apart -= np.array(density.shape) * np.rint(apart / density.shape)
    own = ((apart**2).sum(axis=2) - weight).argmin(axis=1)
    masses = fine.of_points(1).ravel()
    moments = masses[:, None] * apart[np.arange(len(places)), own]
    return (
        np.bincount(own, masses, len(x)),
        np.stack([np.bincount(own, moments[:, a], len(x)) for a in range(2)], axis=1),
    )


@pytest.mark.parametrize("toroidal", [False, True])
def test_cells_are_those_of_a_plain_sum(toroidal):
    rng = np.random.default_rng(1)
    density = as_density(rng.random((9, 14)) * (rng.random((9, 14)) > 0.3), toroidal=toroidal)
    x, weight = rng.random((20, 2)) * density.shape, 3 * rng.random(20)
    cells = DensityDiagrams(density, 0.0)(x, weight)
    mass, moment = plain_cells(density, x, weight)
    # Some 300 parts of 1e-5 lie on the border of a cell, about half of each wrongly: 1e-4 at one deviation.
    assert np.abs(cells.mass - mass).max() < 4e-4
    assert np.abs(cells.moment - moment).max() < 1.6e-3
    assert cells.mass.sum() == pytest.approx(1, abs=1e-12)
    assert (mass[cells.mass == 0] == 0).all()


def test_a_diagonal_cuts_pixels_in_halves():
    density = as_density([[1.0, 2.0], [4.0, 8.0]])
    cells = DensityDiagrams(density, 0.0)(np.array([[0.5, 1.5], [1.5, 0.5]]), np.zeros(2))
    assert cells.mass == pytest.approx(np.array([0.5 + 2 + 4, 0.5 + 4 + 4]) / 15, abs=1e-15)
    # Triangles have their centroids a third from the diagonal.
    expected = [0.5 * 1 / 3 + 2 * 0.5 + 4 * 4 / 3, 0.5 * 2 / 3 + 2 * 1.5 + 4 * 5 / 3]
    assert cells.moment[0] == pytest.approx((np.array(expected) - 6.5 * np.array([0.5, 1.5])) / 15, abs=1e-15)


def test_a_constant_density_on_the_torus_has_the_cells_of_the_uniform_method():
    rng = np.random.default_rng(2)
    x, weight = rng.random((100, 2)), 0.002 * rng.random(100)
    here = DensityDiagrams(as_density(np.ones((16, 16)), toroidal=True), 0.0)(16 * x, 256 * weight)
    uniform = power_diagram(x, weight)
    assert here.mass == pytest.approx(uniform.mass, abs=1e-14)
    assert here.moment / 16 == pytest.approx(uniform.moment, abs=1e-14)
    assert here.energy / 256 == pytest.approx(uniform.energy, abs=1e-14)


@pytest.mark.parametrize("toroidal", [False, True])
def test_the_laplacian_is_how_masses_change_with_weights(toroidal):
    rng = np.random.default_rng(3)
    diagrams = DensityDiagrams(as_density(rng.random((7, 11)), toroidal=toroidal), 0.0)
    x, weight, step = rng.random((9, 2)) * (7, 11), rng.random(9), 1e-5
    change = [diagrams(x, weight + h).mass - diagrams(x, weight - h).mass for h in step * np.eye(9)]
    expected = np.stack(change, axis=1) / (2 * step)
    assert diagrams(x, weight).laplacian().toarray() == pytest.approx(expected, abs=1e-8)


def test_points_end_at_centroids_of_cells_of_equal_mass():
    x = adaptive_points("bnot", RAMP, 60)
    diagrams = DensityDiagrams(RAMP, 0.0)
    weight, cells = equal_masses(
        lambda trial, near: diagrams(x, trial, near), np.zeros(60), diagrams(x, np.zeros(60)), 1e-9, 20
    )
    assert 60 * np.abs(cells.mass - 1 / 60).max() < 1e-9
    mass, moment = plain_cells(RAMP, x, weight, 10)
    # 2,000 parts a cell, 180 of them on its border: 0.35% at one deviation.
    assert 60 * mass == pytest.approx(np.ones(60), abs=0.02)
    # The gradient is 0.03, which is 0.015 mean spacings between a point and its centroid.
    spacing = np.sqrt(RAMP.values.size / 60)
    assert np.sqrt(((moment / mass[:, None]) ** 2).sum(axis=1).mean()) < 0.02 * spacing


def test_each_alternation_costs_less():
    costs = []
    for alternations in (1, 2, 4, 8):
        x = adaptive_points(f"bnot[alternations={alternations},gradient=0]", RAMP, 60)
        diagrams = DensityDiagrams(RAMP, 0.0)
        start = diagrams(x, np.zeros(60))
        cells = equal_masses(lambda w, near: diagrams(x, w, near), np.zeros(60), start, 1e-6, 20)[1]  # noqa: B023
        costs.append(cells.energy.sum())
    assert (np.diff(costs) < 0).all()


def test_islands_get_their_shares():
    values = np.zeros((30, 50))
    values[5:12, 4:14], values[20:27, 30:45] = 1.0, 2.0  # 70 and 210
    x = adaptive_points("bnot", as_density(values), 40)
    assert (x[:, 1] < 20).sum() == 10


def test_what_bnot_cannot_do_is_refused_in_words():
    with pytest.raises(RefusalError, match="3 axes"):
        adaptive_points("bnot", as_density(np.ones((4, 4, 4))), 5)
    with pytest.raises(InputError, match="gradient must be"):
        adaptive_generator("bnot[gradient=-1]")


@pytest.mark.slow
def test_a_constant_density_has_the_spectrum_of_the_uniform_method():
    flat = as_density(np.ones((128, 128)), toroidal=True)
    found = [measures(adaptive_points("bnot", flat, 1024, seed=seed) / 128) for seed in range(3)]
    # Of the uniform method, mean of three sets: floor 1.12e-4, peak 3.03, least distance 0.749.
    assert np.mean([m["noise_floor"] for m in found]) == pytest.approx(1.12e-4, rel=0.2)
    assert np.mean([m["peak"] for m in found]) == pytest.approx(3.0, rel=0.15)
    assert np.mean([m["min_distance"] for m in found]) == pytest.approx(0.745, abs=0.02)
