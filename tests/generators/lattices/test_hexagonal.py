"""Hexagonal lattices in the square: the best fit, its hexagons and its power."""

from __future__ import annotations

import re

import numpy as np
import pytest

from gbnbench.core.torus import densest_spacing
from gbnbench.generators.lattices.hexagonal import MOST_STRAIN, Hexagonal, best_lattice
from gbnbench.generators.registry import generate
from tests.oracles.power import direct_power, half_space

IDEAL = np.array([[1.0, 0.5], [0.0, np.sqrt(0.75)]])


def strain_of(a: int, b: int, s: int) -> float:
    """Smallest strain between the lattice and the hexagonal one, over the bases of its shortest vectors."""
    n = a * b
    points = np.array([[(i / a + j * s / n) % 1, j / b] for i in range(a) for j in range(b)])
    around = np.concatenate([points - [p, q] for p in (0, 1) for q in (0, 1)])
    short = around[np.argsort(np.sum(around**2, axis=1))][1:9]
    scale = 1 / np.sqrt(n * np.sqrt(0.75))
    best = np.inf
    for u in short:
        for v in short:
            pair = np.stack([u, v], axis=1)
            if np.isclose(abs(np.linalg.det(pair)), 1 / n):
                stretch = np.linalg.svd(pair @ np.linalg.inv(scale * IDEAL), compute_uv=False)
                best = min(best, max(stretch[0] - 1, 1 / stretch[1] - 1))
    return best


@pytest.mark.parametrize("n", [2, 7, 15, 24, 30, 56])
def test_best_lattice_is_the_best_of_all(n: int) -> None:
    every = [strain_of(a, n // a, s) for a in range(1, n + 1) if n % a == 0 for s in range(n // a)]
    a, b, s, strain = best_lattice(n)
    assert a * b == n
    assert strain == pytest.approx(min(every), abs=1e-9)
    assert strain_of(a, b, s) == pytest.approx(strain, abs=1e-9)


@pytest.mark.parametrize("n", [15, 56, 127, 168, 1024])
def test_set_is_a_lattice_of_hexagons(n: int) -> None:
    x = generate("hexagonal", n=n)
    strain = best_lattice(n)[3]
    away = (x - x[0] + 0.5) % 1 - 0.5
    images = (away[:, None] + np.array([[i, j] for i in (-1, 0, 1) for j in (-1, 0, 1)])).reshape(-1, 2)
    length = np.sort(np.hypot(*images.T))[1:8] / densest_spacing(n, 2)
    assert np.all(np.abs(length[:6] - 1) <= strain + 1e-12)
    assert length[6] > 1.6
    assert strain <= MOST_STRAIN


def test_power_is_n_on_the_reciprocal_lattice_and_nothing_elsewhere() -> None:
    f = half_space(12, 2)
    power = direct_power(generate("hexagonal", n=56), f)
    on = power > 1
    assert np.allclose(power[on], 56, rtol=1e-12)
    assert power[~on].max() < 1e-24
    rings = np.sort(np.hypot(*f[on].T))
    assert np.allclose(rings[:3] / np.sqrt(56), np.sqrt(2 / np.sqrt(3)), rtol=MOST_STRAIN)


@pytest.mark.parametrize("n", [1, 2, 40, 50, 1000])
def test_refusal_names_the_nearest_that_fits(n: int) -> None:
    reason = Hexagonal().refusal(n, 2)
    assert reason is not None
    match = re.fullmatch(r".* got n=(\d+) \(strain [\d.]+%\), nearest is (\d+)", reason)
    assert match is not None
    nearest = int(match.group(2))
    assert best_lattice(nearest)[3] <= MOST_STRAIN
    between = range(max(1, n - abs(nearest - n) + 1), n + abs(nearest - n))
    assert all(best_lattice(m)[3] > MOST_STRAIN for m in between)


def test_unshifted_set_holds_the_origin() -> None:
    assert [0.0, 0.0] in generate("hexagonal", n=15, shift=False).tolist()
    assert "d must be 2" in str(Hexagonal().refusal(15, 3))
