"""Lloyd's relaxation: its energy falls, and its steps are those of the whole tiling."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.errors import InputError
from gbnbench.core.torus import spacing
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import generate
from gbnbench.generators.voronoi.cells import move_to_centroids, toroidal_cells
from gbnbench.generators.voronoi.lloyd import Lloyd


@pytest.mark.parametrize(("n", "d"), [(1, 2), (2, 2), (3, 2), (5, 3), (50, 1), (100, 2), (60, 3)])
def test_energy_never_rises_and_steps_are_those_of_the_whole_tiling(n: int, d: int) -> None:
    x = generate("random", n=n, d=d, seed=1)
    energy = []
    for _ in range(12):
        cells = toroidal_cells(x, 1.0)
        energy.append(cells.energy.sum())
        x = move_to_centroids(x, cells)
    assert np.all(np.diff(energy) <= 1e-15)
    made = Lloyd(iterations=12, tolerance=0, method="lloyd")(n, d, realization_rng(1, 0))
    assert np.abs((made - x + 0.5) % 1 - 0.5).max() < 1e-12


def test_no_iterations_leave_uniform_points() -> None:
    assert np.array_equal(generate("lloyd", n=9, d=2, iterations=0), generate("random", n=9, d=2))


def test_stops_once_no_point_moves_by_the_tolerance() -> None:
    def set_after(iterations: int, tolerance: float) -> np.ndarray:
        return Lloyd(iterations, tolerance)(20, 2, realization_rng(4, 0))

    moves = []
    for k in range(40):
        offset = toroidal_cells(set_after(k, 0)).offset
        moves.append(np.linalg.norm(offset, axis=1).max() / spacing(20, 2))
    tolerance = 0.05
    steps = int(np.argmax(np.array(moves) < tolerance)) + 1
    assert 1 < steps < 40
    assert np.array_equal(set_after(1000, tolerance), set_after(steps, 0))


@pytest.mark.parametrize(("n", "d"), [(1, 3), (2, 1), (5, 1), (4, 2), (7, 2), (2, 3), (3, 3)])
def test_small_sets_come_to_rest(n: int, d: int) -> None:
    x = generate("lloyd", n=n, d=d, iterations=2000, tolerance=1e-9)
    assert np.linalg.norm(toroidal_cells(x).offset, axis=1).max() < 1e-8


def test_evens_out_the_gaps_in_one_dimension() -> None:
    x = np.sort(generate("lloyd", n=12, d=1, iterations=3000, tolerance=0)[:, 0])
    assert np.allclose(np.diff(x, append=x[0] + 1), 1 / 12, atol=1e-12)


@pytest.mark.parametrize(("n", "d", "method"), [(40, 2, "lbfgs"), (12, 3, "auto"), (20, 1, "lbfgs")])
def test_the_quasi_newton_method_comes_to_rest_at_centroids_too(n: int, d: int, method: str) -> None:
    x = generate("lloyd", n=n, d=d, method=method, iterations=500, tolerance=1e-6)
    assert np.linalg.norm(toroidal_cells(x).offset, axis=1).max() < 1e-6 * spacing(n, d)


@pytest.mark.slow
def test_thirty_quasi_newton_steps_lower_the_energy_as_far_as_a_hundred_of_lloyds() -> None:
    by = {
        method: toroidal_cells(generate("lloyd", n=150, d=3, method=method, iterations=steps)).energy.sum()
        for method, steps in (("lbfgs", 30), ("lloyd", 100))
    }
    assert by["lbfgs"] < 1.002 * by["lloyd"]


@pytest.mark.slow
def test_four_dimensions_are_served() -> None:
    """Between D4's 0.0766 a dimension and the cube's 0.0833 (Conway & Sloane, Table 2.3)."""
    x = generate("lloyd", n=8, d=4, iterations=8)
    assert 0.0766 < toroidal_cells(x).energy.sum() * 8**0.5 / 4 < 0.0833


def test_reaches_the_moment_of_good_tessellations() -> None:
    """Between the hexagon's 0.0802 a dimension and the square's 0.0833; random points have 0.159."""
    cells = toroidal_cells(generate("lloyd", n=256, d=2, iterations=100))
    assert 0.0802 < cells.energy.sum() * 256 / 2 < 0.0818


@pytest.mark.parametrize("settings", [{"iterations": -1}, {"tolerance": -0.1}, {"tolerance": float("nan")}])
def test_settings_out_of_range_are_refused(settings: dict[str, float]) -> None:
    with pytest.raises(InputError, match=r"must (lie in \[0, 1000000\]|be >= 0 spacings)"):
        Lloyd(**settings)  # type: ignore[arg-type]
