"""Power diagrams on the torus against exact clipping, finite differences and Voronoi cells."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.errors import InputError
from gbnbench.generators.power_cells.diagram import power_diagram
from gbnbench.generators.registry import generate
from gbnbench.generators.voronoi.cells import toroidal_cells
from tests.oracles.power_cells import exact_cell, exact_moments


def dyadic(n: int, seed: int, heaviest: float) -> tuple[np.ndarray, np.ndarray]:
    """Points and weights of few bits, so that fractions stay short."""
    rng = np.random.default_rng(seed)
    return rng.integers(0, 2**12, (n, 2)) / 2**12, np.rint(rng.random(n) * heaviest * 2**12 / n) / 2**12


@pytest.mark.parametrize(("n", "heaviest"), [(1, 0.5), (2, 0.3), (3, 0.3), (5, 1.0), (14, 0.5), (14, 4.0)])
def test_cells_are_those_of_exact_clipping(n: int, heaviest: float) -> None:
    x, weight = dyadic(n, n, heaviest)
    diagram = power_diagram(x, weight)
    exact = [exact_moments(exact_cell(x, weight, k)) for k in range(n)]
    assert sum(area for area, _, _ in exact) == 1
    assert np.allclose(diagram.mass, [float(area) for area, _, _ in exact], rtol=0, atol=1e-14)
    assert np.allclose(
        diagram.moment, [[float(c) for c in first] for _, first, _ in exact], rtol=0, atol=1e-14
    )
    assert np.allclose(diagram.energy, [float(second) for _, _, second in exact], rtol=0, atol=1e-14)
    if (n, heaviest) == (14, 4.0):
        assert (diagram.mass == 0).any()  # a hidden point among them


@pytest.mark.parametrize("n", [1, 2, 4, 30, 200])
def test_cells_tile_the_torus_and_do_not_depend_on_the_border(n: int) -> None:
    x, weight = dyadic(n, 7, 0.4)
    diagram, whole = power_diagram(x, weight), power_diagram(x, weight, 1.0)
    assert diagram.mass.sum() == pytest.approx(1, abs=1e-13)
    for guess in (1e-3, 0.1, 0.3):
        again = power_diagram(x, weight, guess)
        assert np.allclose(again.mass, whole.mass, rtol=0, atol=1e-14)
        assert np.allclose(again.moment, whole.moment, rtol=0, atol=1e-14)


def test_a_heavy_point_widens_the_border() -> None:
    """One weight hides nearly all the others, so that cells reach across half the torus."""
    x = np.random.default_rng(3).random((300, 2))
    weight = np.zeros(300)
    weight[0] = 0.2
    diagram = power_diagram(x, weight)
    assert diagram.mass[0] > 0.4
    assert diagram.mass.sum() == pytest.approx(1, abs=1e-13)
    assert np.allclose(diagram.mass, power_diagram(x, weight, 1.0).mass, rtol=0, atol=1e-13)


def test_equal_weights_give_voronoi_cells() -> None:
    x = generate("random", n=150, seed=1)
    diagram, cells = power_diagram(x, np.full(150, 0.3)), toroidal_cells(x)
    assert np.allclose(diagram.mass, cells.volume, rtol=0, atol=1e-14)
    assert np.allclose(diagram.offset, cells.offset, rtol=0, atol=1e-13)
    assert np.allclose(diagram.energy, cells.energy, rtol=0, atol=1e-14)


@pytest.mark.parametrize(("kind", "n"), [("grid", 64), ("hexagonal", 120)])
def test_lattice_cells_are_alike_though_many_meet_in_one_vertex(kind: str, n: int) -> None:
    diagram = power_diagram(generate(kind, n=n, seed=2))
    assert np.allclose(diagram.mass, 1 / n, rtol=1e-12)
    assert np.abs(diagram.offset).max() < 1e-14


def test_the_laplacian_is_the_derivative_of_the_masses() -> None:
    x, weight = dyadic(40, 5, 0.3)
    laplacian = power_diagram(x, weight).laplacian().toarray()
    assert np.array_equal(laplacian, laplacian.T) or np.allclose(laplacian, laplacian.T, rtol=0, atol=1e-12)
    assert np.abs(laplacian.sum(axis=1)).max() < 1e-13
    step = 1e-6
    for k in (0, 11):
        change = np.zeros(40)
        change[k] = step
        slope = (power_diagram(x, weight + change).mass - power_diagram(x, weight - change).mass) / (2 * step)
        assert np.allclose(
            laplacian[:, k], slope, rtol=0, atol=1e-7
        )  # masses are quadratic but for new sides


def test_bad_input_is_refused() -> None:
    with pytest.raises(InputError, match=r"x must be \(n, 2\)"):
        power_diagram(np.zeros((3, 3)))
    with pytest.raises(InputError, match=r"weight must be \(3,\)"):
        power_diagram(np.random.default_rng(0).random((3, 2)), np.zeros(2))
    with pytest.raises(InputError, match="finite"):
        power_diagram(np.random.default_rng(0).random((3, 2)), np.array([0.0, np.nan, 0.0]))
