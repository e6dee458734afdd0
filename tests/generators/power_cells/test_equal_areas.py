"""Weights for equal areas: every cell has 1/n by exact clipping, from any start."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.errors import RefusalError
from gbnbench.generators.power_cells import equal_areas as module
from gbnbench.generators.power_cells.equal_areas import equal_areas
from tests.oracles.power_cells import exact_cell, exact_moments


def test_areas_are_equal_by_exact_clipping() -> None:
    x = np.random.default_rng(4).integers(0, 2**12, (12, 2)) / 2**12
    weight, diagram = equal_areas(x, np.zeros(12), 1e-11)
    areas = [12 * float(exact_moments(exact_cell(x, weight, k))[0]) for k in range(12)]
    assert np.allclose(areas, 1, rtol=0, atol=2e-11)
    assert np.allclose(diagram.mass, 1 / 12, rtol=2e-11)


@pytest.mark.parametrize("n", [1, 2, 3, 10, 400])
def test_the_weights_are_one_answer_whatever_the_start(n: int) -> None:
    """The dual is strictly concave up to a constant, where no cell is empty."""
    rng = np.random.default_rng(n)
    x = rng.random((n, 2))
    first, _ = equal_areas(x, np.zeros(n), 1e-9)
    second, diagram = equal_areas(x, 0.3 * rng.random(n) / n, 1e-9)
    assert np.allclose(first - first.mean(), second - second.mean(), rtol=0, atol=1e-9 / n)
    assert n * np.abs(diagram.mass - 1 / n).max() <= 1e-9


def test_weights_that_hide_points_are_dropped() -> None:
    x = np.random.default_rng(0).random((50, 2))
    weight = np.zeros(50)
    weight[3] = 0.2
    _, diagram = equal_areas(x, weight, 1e-6)
    assert np.allclose(diagram.mass, 1 / 50, rtol=1e-6)


def test_clustered_points_still_share_the_torus() -> None:
    """All in a corner: the weights must carry most cells far from their points."""
    x = np.random.default_rng(1).random((60, 2)) * 0.1
    _, diagram = equal_areas(x, np.zeros(60), 1e-8)
    assert np.allclose(diagram.mass, 1 / 60, rtol=1e-8)


def test_steps_that_do_not_suffice_are_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "STEPS", 1)
    with pytest.raises(RefusalError, match="raise the tolerance"):
        equal_areas(np.random.default_rng(1).random((60, 2)), np.zeros(60), 1e-8)
