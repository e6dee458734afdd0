"""Capacity-constrained centroidal Voronoi tessellations: the gradient, and what the price of areas does."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from scipy.optimize import OptimizeResult

from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.power_cells.diagram import power_diagram
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import generate
from gbnbench.generators.voronoi.capcvt import CapacityConstrainedVoronoi, energy_and_gradient
from tests.oracles.power_cells import exact_cell, exact_moments

Objective = Callable[[FloatArray], tuple[float, FloatArray]]


def test_the_energy_is_that_of_exact_cells() -> None:
    x = np.random.default_rng(1).integers(0, 2**12, (9, 2)) / 2**12
    cells = [exact_moments(exact_cell(x, np.zeros(9), k)) for k in range(9)]
    exact = 9 * sum(float(second) + 7.0 * (float(area) - 1 / 9) ** 2 for area, _, second in cells)
    assert energy_and_gradient(power_diagram(x), 7.0)[0] == pytest.approx(exact, rel=1e-13)


@pytest.mark.parametrize(("n", "capacity"), [(2, 3.0), (3, 0.0), (40, 0.0), (40, 50.0)])
def test_the_gradient_is_that_of_finite_differences(n: int, capacity: float) -> None:
    x, step = np.random.default_rng(n).random((n, 2)), 1e-6
    _, gradient = energy_and_gradient(power_diagram(x), capacity)
    for k, axis in ((0, 0), (n - 1, 1)):
        energy = []
        for sign in (1, -1):
            moved = x.copy()
            moved[k, axis] += sign * step
            energy.append(energy_and_gradient(power_diagram(moved), capacity)[0])
        slope = (energy[0] - energy[1]) / (2 * step)
        assert gradient[k, axis] == pytest.approx(slope, abs=1e-7 * (1 + capacity))


@pytest.mark.slow
def test_the_energy_falls_with_the_steps() -> None:
    energy = [
        energy_and_gradient(power_diagram(generate("capcvt", n=100, iterations=k, seed=1)), 50.0)[0]
        for k in (1, 5, 20, 60)
    ]
    assert np.all(np.diff(energy) < 0)


@pytest.mark.slow
def test_a_dearer_capacity_makes_areas_more_equal() -> None:
    deviation = [
        power_diagram(generate("capcvt", n=200, iterations=60, capacity=price, seed=2)).mass.std() * 200
        for price in (0.0, 1.0, 50.0)
    ]
    assert deviation[0] > 2 * deviation[1] > 4 * deviation[2]
    assert deviation[2] < 5e-3


def test_without_a_price_it_comes_to_rest_at_centroids() -> None:
    x = CapacityConstrainedVoronoi(iterations=2000, capacity=0)(12, 2, realization_rng(3, 0))
    assert np.abs(power_diagram(x).offset).max() < 1e-6


def test_the_program_counts_a_twelfth_of_the_integrals_beside_the_whole_gradient(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    x = np.random.default_rng(1).integers(0, 2**12, (9, 2)) / 2**12
    compared = {}
    for energy in ("formula", "program"):

        def at_one_place(objective: Objective, start: FloatArray, **_: object) -> OptimizeResult:
            compared[energy] = objective(x.ravel())  # noqa: B023 (called before the loop goes on)
            return OptimizeResult(x=start)

        monkeypatch.setattr("scipy.optimize.minimize", at_one_place)
        generate("capcvt", n=9, capacity=7.0, energy=energy)
    cells = [exact_moments(exact_cell(x, np.zeros(9), k)) for k in range(9)]
    exact = 9 * sum(float(second) / 12 + 7.0 * (float(area) - 1 / 9) ** 2 for area, _, second in cells)
    assert compared["program"][0] == pytest.approx(exact, rel=1e-13)
    assert np.array_equal(compared["program"][1], compared["formula"][1])
    assert compared["formula"][0] == energy_and_gradient(power_diagram(x), 7.0)[0]


@pytest.mark.parametrize(
    "settings",
    [{"iterations": 0}, {"capacity": -1.0}, {"capacity": float("nan")}, {"capacity": 1e155}],
)
def test_settings_out_of_range_are_refused(settings: dict[str, float]) -> None:
    with pytest.raises(InputError, match=r"must be >=|must lie in"):
        CapacityConstrainedVoronoi(**settings)  # type: ignore[arg-type]
