"""Islands of a density: parts in white are found, also over the borders of a torus, and share the points."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.generators.adaptive.density import as_density
from gbnbench.generators.adaptive.islands import islands
from gbnbench.generators.adaptive.power_cells.density_diagram import DensityDiagrams
from gbnbench.generators.adaptive.registry import adaptive_points
from gbnbench.generators.power_cells.equal_areas import equal_masses


def discs(centres, radii, shape):
    """Discs of rising density in white."""
    rows, columns = np.indices(shape)
    values = np.zeros(shape)
    for k, ((row, column), radius) in enumerate(zip(centres, radii, strict=True), 1):
        values[(rows - row) ** 2 + (columns - column) ** 2 < radius**2] = k
    return values


def put_together(parts, shape):
    """What the islands are of, laid back where they were cut out."""
    whole = np.zeros(shape)
    for part in parts:
        rows, columns = np.nonzero(part.density.values)
        at = ((rows + int(part.corner[0])) % shape[0], (columns + int(part.corner[1])) % shape[1])
        assert (whole[at] == 0).all()
        whole[at] = part.density.values[rows, columns]
    return whole


@pytest.mark.parametrize("toroidal", [False, True])
def test_islands_are_the_whole_and_share_its_points(toroidal):
    values = discs([(10, 10), (12, 40), (30, 25)], [4, 6, 5], (45, 60))
    density = as_density(values, toroidal=toroidal)
    parts = islands(density, 100)
    assert np.array_equal(put_together(parts, (45, 60)), density.values)
    mass = np.array([part.density.values.sum() for part in parts])
    counts = np.array([part.n for part in parts])
    assert counts.sum() == 100
    assert np.abs(counts - 100 * mass / mass.sum()).max() < 1
    assert len(parts) == 3


def test_pixels_that_meet_at_a_corner_are_one_island():
    assert len(islands(as_density([[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 0, 1]]), 6)) == 3


def test_an_island_goes_on_over_the_borders_of_a_torus():
    values = np.zeros((20, 30))
    values[:2, 5:9], values[-3:, 5:9] = 1, 1  # one, over the upper border
    values[10, 0], values[11, -1], values[9, 12:14] = 5, 5, 5  # one, by a corner, and another
    bounded = islands(as_density(values), 96)
    assert sorted(part.n for part in bounded) == [12, 12, 19, 24, 29]
    parts = islands(as_density(values, toroidal=True), 96)
    assert sorted(part.density.shape for part in parts) == [(1, 2), (2, 2), (5, 4)]
    assert np.array_equal(put_together(parts, (20, 30)), values / 5)


def test_what_goes_around_a_torus_is_not_cut_out():
    values = np.zeros((20, 30))
    values[4:7, :], values[12, 3] = 1, 9
    parts = islands(as_density(values, toroidal=True), 50)
    assert [(part.density.shape, part.density.toroidal) for part in parts] == [
        ((20, 30), True),
        ((1, 1), False),
    ]


def test_specks_belong_to_the_nearest_island():
    values = np.zeros((20, 40))
    values[5:15, 2:8], values[5:15, 30:36] = 1, 1
    values[3, 12], values[10, 26], values[10, 28] = 1, 1, 1  # of a tenth of a point each
    parts = islands(as_density(values), 12)
    assert [(part.density.values > 0).sum() for part in parts] == [61, 62]
    assert [part.n for part in parts] == [6, 6]
    toroidal = np.roll(values, 25, axis=1)
    assert sorted((p.density.values > 0).sum() for p in islands(as_density(toroidal, toroidal=True), 12)) == [
        61,
        62,
    ]


def test_ink_that_hangs_together_and_specks_alone_are_one_island():
    ramp = as_density(np.linspace(0.1, 1, 20)[:, None] * np.ones(9))
    assert [part.density for part in islands(ramp, 7)] == [ramp]
    specks = as_density(np.eye(9)[::-1][::2])
    assert [part.density for part in islands(specks, 3)] == [specks]


@pytest.mark.parametrize("toroidal", [False, True])
def test_cells_of_bnot_have_equal_shares_of_each_of_many_islands(toroidal):
    rng = np.random.default_rng(4)
    centres = np.argwhere(np.ones((3, 4))) * 60 + 12 + 16 * rng.random((12, 2))
    density = as_density(discs(centres, 5 + 7 * rng.random(12), (180, 240)), toroidal=toroidal)
    x = adaptive_points("bnot", density, 400)
    assert x.shape == (400, 2)
    for part in islands(density, 400):
        apart = (x - part.corner) % density.shape
        own = apart[(apart < part.density.shape).all(axis=1)]
        assert len(own) == part.n
        diagrams = DensityDiagrams(part.density, 1e-3 / part.n)
        start = diagrams(own, np.zeros(part.n))
        cells = equal_masses(lambda w, near: diagrams(own, w, near), np.zeros(part.n), start, 1e-6, 40)[1]  # noqa: B023
        assert part.n * cells.mass == pytest.approx(np.ones(part.n), abs=1e-5)
        spacing = np.sqrt(part.density.values.size / part.n)
        assert np.sqrt((cells.offset**2).sum(axis=1).mean()) < 0.02 * spacing  # as in test_bnot
