"""Sums over blocks of points against slow direct sums, within the bound that is stated of them."""

from __future__ import annotations

import numpy as np
import pytest

import gbnbench
from gbnbench.analysis.spectrum import coordinate_rounding
from gbnbench.analysis.spectrum.evaluators import direct_sum, point_blocks, shell_product
from gbnbench.opencl import devices_present
from tests.oracles.power import direct_power, lattice_of

RNG = np.random.default_rng(21)
SETS = {
    "random": RNG.random((2, 5000, 2)),
    "space": RNG.random((1, 3001, 3)),
    "coincident": np.repeat(RNG.random((1, 1, 2)), 3000, axis=1),
    "tiny": RNG.random((1, 3000, 2)) * 1e-7,
    "lattice": (lattice_of(27, 2) / 55 % 1)[None],
}

pytestmark = pytest.mark.skipif(not devices_present(), reason="blocks are summed on an OpenCL device")


@pytest.fixture
def small_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    """Cut sets in blocks of 700 points, whose last is filled up."""
    for module in (point_blocks, shell_product, direct_sum):
        monkeypatch.setattr(module, "POINTS", 700)
    monkeypatch.setattr(coordinate_rounding, "ROWS", 700)


def true_power(x: np.ndarray, f: np.ndarray, weights: np.ndarray | None) -> np.ndarray:
    """Mean power over sets by long sums."""
    each = [None] * len(x) if weights is None else weights
    return np.mean([direct_power(one, f, w) for one, w in zip(x, each, strict=True)], axis=0)


@pytest.mark.usefixtures("small_blocks")
@pytest.mark.parametrize("weighted", [False, True])
@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize("kind", SETS)
def test_shells_of_blocks_keep_their_bound(kind: str, precision: str, weighted: bool) -> None:
    x = SETS[kind]
    weights = RNG.standard_normal(x.shape[:2]) if weighted else None
    told: list[float] = []
    found = gbnbench.shells(x, 4, precision, band=(3, 4), weights=weights, progress=told.append)
    f = lattice_of(4, x.shape[2])
    square = (f**2).sum(axis=1)
    for radius, power, count in zip(found.frequency, found.power, found.count, strict=True):
        own = f[square == round(radius**2)]
        expected = true_power(x, own, weights)
        assert count == len(own)
        worst = 2 * np.sqrt(expected.mean()) * found.error_bound + found.error_bound**2
        assert abs(power - expected.mean()) <= worst
        if kind in ("random", "space"):
            typical = 30 * found.error_rms
            assert abs(np.sqrt(power) - np.sqrt(expected.mean())) <= typical
    assert told[-1] == pytest.approx(1)
    assert len(told) > len(x) * 4


@pytest.mark.usefixtures("small_blocks")
@pytest.mark.parametrize("weighted", [False, True])
@pytest.mark.parametrize("kind", SETS)
def test_listed_frequencies_of_blocks_keep_their_bound(kind: str, weighted: bool) -> None:
    x = SETS[kind]
    weights = RNG.standard_normal(x.shape[:2]) if weighted else None
    f = RNG.integers(-(2**40), 2**40, (6, x.shape[2]))
    f[0] = 3
    found = gbnbench.periodogram(x, frequencies=f, weights=weights)
    expected = true_power(x, f, weights)
    assert (np.abs(np.sqrt(found.power) - np.sqrt(expected)) <= found.error_bound).all()
    if kind == "random":
        assert (np.abs(np.sqrt(found.power) - np.sqrt(expected)) <= 10 * found.error_rms).all()


def test_rounding_of_coordinates_is_the_same_by_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    x = RNG.random((2, 2000, 2)) * np.where(np.arange(2000)[:, None] < 300, 1e-6, 1.0)
    weights = RNG.standard_normal((2, 2000))
    for precision in ("double", "float"):
        for w in (None, weights, weights[:1]):
            whole = coordinate_rounding.coordinates(x, precision, w)
            monkeypatch.setattr(coordinate_rounding, "ROWS", 300)
            parts = coordinate_rounding.coordinates(x, precision, w)
            monkeypatch.undo()
            for name in ("coherent", "scattered", "share"):
                assert getattr(parts, name) == pytest.approx(getattr(whole, name), rel=1e-12)


def test_a_plan_of_a_large_set_does_not_grow_with_it() -> None:
    """The bytes of a plan are those besides the points, which are the same for ten times as many."""
    large, larger = (gbnbench.plan(n, 2, 3010, shells=True, band=(3000, 3010)) for n in (10**7, 10**8))
    assert large.method == "shells"
    assert large.bytes == larger.bytes
