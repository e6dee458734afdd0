"""Voronoi cells on the torus against a fine grid of probes, whatever the border."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.generators.registry import generate
from gbnbench.generators.voronoi.cells import move_to_centroids, toroidal_cells
from tests.oracles.neighbours import nearest_by_tiling


@pytest.mark.parametrize(("n", "d"), [(n, d) for d in (1, 2, 3) for n in (1, 2, 3, 5, 17, 150)] + [(6, 4)])
def test_cells_fill_the_torus_and_do_not_depend_on_the_border(n: int, d: int) -> None:
    x = generate("random", n=n, d=d, seed=n)
    cells, whole = toroidal_cells(x), toroidal_cells(x, 1.0)
    assert cells.volume.sum() == pytest.approx(1, abs=1e-13)
    for guess in (1e-3, 0.1, 0.3):
        again = toroidal_cells(x, guess)
        for found in (cells, again):
            assert np.allclose(found.volume, whole.volume, rtol=0, atol=1e-14)
            assert np.allclose(found.offset, whole.offset, rtol=0, atol=1e-13)
            assert np.allclose(found.energy, whole.energy, rtol=1e-10, atol=0)


def test_clustered_points_widen_the_border() -> None:
    """All in a corner: cells reach across half the torus, far beyond four spacings."""
    x = np.random.default_rng(2).random((200, 2)) * 0.01
    cells = toroidal_cells(x)
    assert cells.volume.sum() == pytest.approx(1, abs=1e-12)
    assert np.allclose(cells.volume, toroidal_cells(x, 1.0).volume, rtol=0, atol=1e-13)


@pytest.mark.parametrize(
    ("n", "d", "side"),
    [(1, 2, 200), (2, 2, 200), (6, 2, 300), (40, 2, 300), (2, 3, 40), (7, 3, 40), (6, 4, 14)],
)
def test_cells_are_those_of_a_fine_grid_of_probes(n: int, d: int, side: int) -> None:
    x = generate("random", n=n, d=d, seed=3)
    probes = (np.indices((side,) * d).reshape(d, -1).T + 0.5) / side
    owner, place = nearest_by_tiling(x, probes)
    arm = probes - place
    cells = toroidal_cells(x)
    share = np.bincount(owner, minlength=n) / len(probes)
    first = np.stack([np.bincount(owner, arm[:, a], n) for a in range(d)], axis=1) / len(probes)
    second = np.bincount(owner, np.sum(arm**2, axis=1), n) / len(probes)
    tolerance = 0.3 * (1 / side if n == 1 else n ** (1 / d - 1) / side)
    assert np.allclose(cells.volume, share, rtol=0, atol=tolerance)
    assert np.allclose(cells.offset * cells.volume[:, None], first, rtol=0, atol=tolerance * n ** (-1 / d))
    assert cells.energy.sum() == pytest.approx(second.sum(), rel=1e-3)


@pytest.mark.parametrize(("n", "d"), [(9, 1), (49, 2), (27, 3), (8, 3), (1, 3)])
def test_grid_cells_are_cubes_at_rest(n: int, d: int) -> None:
    x = generate("grid", n=n, d=d)
    cells = toroidal_cells(x)
    assert np.allclose(cells.volume, 1 / n, rtol=1e-12)
    assert np.abs(cells.offset).max() < 1e-14
    assert np.allclose(cells.energy, d / 12 * n ** (-2 / d) / n, rtol=1e-12)
    assert np.abs((move_to_centroids(x, cells) - x + 0.5) % 1 - 0.5).max() < 1e-14


def test_hexagons_are_at_rest_with_their_known_moment() -> None:
    """Conway & Sloane, Table 2.3: 5 / (36 sqrt 3) a dimension; strain raises it in second order."""
    cells = toroidal_cells(generate("hexagonal", n=16384))
    assert np.abs(cells.offset).max() < 1e-14
    assert cells.energy.sum() * 16384 / 2 == pytest.approx(5 / (36 * np.sqrt(3)), rel=1e-5)


def test_body_centred_cubic_moment_is_the_known_one() -> None:
    """Conway & Sloane, Table 2.3: 19 / (192 * 2**(1/3)) a dimension."""
    cells = toroidal_cells(np.array([[0.1, 0.2, 0.3], [0.6, 0.7, 0.8]]))
    assert cells.energy.sum() * 2 ** (2 / 3) / 3 == pytest.approx(19 / (192 * 2 ** (1 / 3)), rel=1e-12)


@pytest.mark.parametrize("d", [1, 2, 3, 4])
def test_coincident_points_are_refused(d: int) -> None:
    x = generate("random", n=12, d=d)
    x[5] = x[2]
    with pytest.raises(InputError, match="x must hold distinct points"):
        toroidal_cells(x)


def test_checkerboard_lattice_in_4d_has_its_known_moment() -> None:
    """Conway & Sloane, Table 2.3: D4 has 13 / (120 sqrt 2) a dimension; its flat simplices cost some 1e-5."""
    x = np.array([[0.1, 0.2, 0.3, 0.4], [0.6, 0.7, 0.8, 0.9]])
    cells = toroidal_cells(x)
    assert np.allclose(cells.volume, 0.5, rtol=1e-4)
    assert cells.energy.sum() * 2**0.5 / 4 == pytest.approx(13 / (120 * np.sqrt(2)), rel=1e-4)


def test_five_dimensions_are_refused() -> None:
    with pytest.raises(RefusalError, match="d must be 1, 2, 3 or 4"):
        toroidal_cells(np.zeros((3, 5)))
