"""Spectral sampling: kernels against sums of images, what a point adds, its gradient, the greedy choice."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.measures import measures
from gbnbench.core.errors import InputError
from gbnbench.generators.kernel_based.spectral_sampling import (
    SpectralSampling,
    kernels,
    most_independent,
    span_gradient,
)
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import generate


@pytest.mark.parametrize(("d", "width"), [(1, 0.02), (2, 0.1), (2, 0.4), (3, 0.3)])
def test_kernels_count_all_images(d: int, width: float) -> None:
    x, y = realization_rng(0, 0).random((5, d)), realization_rng(1, 0).random((7, d))
    apart = x[:, None] - y[None]
    images = np.sum([np.exp(-((apart + t) ** 2) / (2 * width**2)) for t in range(-9, 10)], axis=0)
    value, slope = kernels(x, y, width)
    assert value == pytest.approx(images.prod(axis=2), abs=1e-13)
    h = 1e-6
    step = np.zeros(d)
    step[-1] = h
    ahead, behind = (kernels(x + sign * step, y, width)[0] for sign in (1, -1))
    assert slope[-1] == pytest.approx((ahead - behind) / (2 * h), abs=1e-6 / width)


def test_what_a_point_adds_is_its_distance_to_the_span_of_the_others() -> None:
    x, width = realization_rng(2, 0).random((12, 2)), 0.15
    added, gradient = span_gradient(x, width)
    others = np.delete(x, 3, axis=0)

    def distance(point: np.ndarray) -> float:
        row = kernels(point[None], others, width)[0][0]
        own = kernels(point[None], point[None], width)[0][0, 0]
        return float(own - row @ np.linalg.solve(kernels(others, others, width)[0], row))

    assert added[3] == pytest.approx(distance(x[3]), rel=1e-8)
    h = 1e-6
    for axis in range(2):
        step = h * np.eye(2)[axis]
        slope = (distance(x[3] + step) - distance(x[3] - step)) / (2 * h)
        assert gradient[3, axis] == pytest.approx(slope, rel=1e-4, abs=1e-6)


def test_the_choice_is_greedy() -> None:
    candidates, width = realization_rng(3, 0).random((40, 2)), 0.12
    chosen = most_independent(candidates, 10, width)
    for k in range(1, 10):
        before = chosen[:k]
        rows = kernels(candidates, before, width)[0]
        gram = kernels(before, before, width)[0]
        left = kernels(chosen[:1], chosen[:1], width)[0][0, 0] - np.einsum(
            "nk,nk->n", rows, np.linalg.solve(gram, rows.T).T
        )
        assert np.array_equal(candidates[left.argmax()], chosen[k])


def test_the_ascent_spreads_points() -> None:
    few, many = (measures(generate("oztireli", n=100, iterations=i)) for i in (0, 8))
    assert many["min_distance"] > few["min_distance"] + 0.1


@pytest.mark.parametrize("wrong", [{"iterations": -1}, {"sigma": 0.4}, {"sigma": 2.0}, {"step": 0.0}])
def test_wrong_settings_are_refused(wrong: dict[str, float]) -> None:
    with pytest.raises(InputError, match=next(iter(wrong))):
        SpectralSampling(**wrong)  # type: ignore[arg-type]
