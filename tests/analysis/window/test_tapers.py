"""Sine tapers against quadrature on a fine grid."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.window.tapers import MOST_TAPERS, SineTapers, default_counts

CELLS = 400


@pytest.fixture(name="grid", scope="module")
def _grid():
    middles = (np.arange(CELLS) + 0.5) / CELLS
    return np.stack([axis.ravel() for axis in np.meshgrid(middles, middles, indexing="ij")], axis=1)


TAPERS = SineTapers(np.array([2.0, 0.5]), (3, 2))
VECTORS = np.array([[3.0, 4.0], [0.0, 0.0], [math.pi, 0.3], [-7.0, 25.0]])


def test_tapers_are_orthonormal(grid):
    values = TAPERS.values(grid)
    assert values.shape == (6, CELLS**2)
    # the midpoint rule is exact for products of sines of low order
    np.testing.assert_allclose(values @ values.T / len(grid), np.eye(6), atol=1e-12)


def test_transforms_and_overlaps_are_the_integrals(grid):
    values = TAPERS.values(grid)
    waves = np.exp(-1j * (grid * TAPERS.sides) @ VECTORS.T)
    # the midpoint rule's error, h^2 / 24 times a second derivative below 400
    np.testing.assert_allclose(TAPERS.transforms(VECTORS), values @ waves / len(grid), atol=1e-4)
    np.testing.assert_allclose(TAPERS.overlaps(VECTORS), (values * values[0]) @ waves / len(grid), atol=1e-4)
    assert TAPERS.first_mean == pytest.approx(8 / math.pi**2, rel=1e-14)


def test_bandwidth_is_the_root_mean_square_of_the_gradient(grid):
    step = 1e-5
    squares = np.zeros(6)
    for axis in range(2):
        shift = step * np.eye(2)[axis]
        slope = (TAPERS.values(grid + shift) - TAPERS.values(grid - shift)) / (2 * step * TAPERS.sides[axis])
        squares += (slope**2).mean(axis=1)
    np.testing.assert_allclose(TAPERS.squared_bandwidths, squares, rtol=1e-6)
    assert TAPERS.bandwidth == pytest.approx(math.sqrt(squares.mean()))


def test_squared_overlaps_add_up_to_the_integral_of_the_fourth_power():
    steps = np.arange(-3000, 3001)
    for axis, count in enumerate(TAPERS.counts):
        found = TAPERS.squared_overlaps(axis, steps)
        assert found[3000] == pytest.approx(count)
        # sum over p, q of the integral of h_p^2 h_q^2, 1 and 3/2 for p = q
        assert found.sum() == pytest.approx(count**2 + count / 2, rel=1e-6)


def test_energy_beyond_a_wave_number_falls_from_one_as_its_cube():
    energy = TAPERS.energy_beyond(0, np.array([0.0, 50.0, 100.0, 200.0]))
    assert energy[0] == pytest.approx(
        1 + 0.5 * 8 / math.pi**2 * (1 + 1 / 9) / 3, abs=1e-3
    )  # DC is whole there
    assert energy[1] / energy[2] == pytest.approx(8, rel=0.15)
    assert energy[2] / energy[3] == pytest.approx(8, rel=0.1)


@pytest.mark.parametrize(
    ("sides", "counts"),
    [
        ([3.0], (4,)),
        ([1.0, 1.0], (2, 2)),
        ([4.0, 1.0], (8, 2)),
        ([1.0] * 3, (2, 2, 2)),
        ([1.0] * 6, (1,) * 6),
    ],
)
def test_long_sides_get_more_tapers(sides, counts):
    assert default_counts(np.array(sides)) == counts
    assert math.prod(default_counts(np.array([1000.0, 1.0, 7.0]))) <= MOST_TAPERS
