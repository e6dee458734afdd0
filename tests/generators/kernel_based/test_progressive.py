"""Progressive orders: permutations whose halves no exchange betters, floors of prefixes, the generator."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.measures import measures
from gbnbench.core.errors import InputError
from gbnbench.core.torus import FloatArray
from gbnbench.generators.kernel_based.progressive_order import prefix_noise_floors, progressive_order
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import generate


def pair_energy(x: FloatArray, width: float) -> float:
    apart = x[:, None] - x[None]
    images = np.sum([np.exp(-((apart + t) ** 2) / (2 * width**2)) for t in range(-6, 7)], axis=0)
    return float(np.sum(images.prod(axis=2)))


@pytest.mark.parametrize(("n", "d"), [(1, 2), (2, 1), (33, 2), (40, 3)])
def test_is_a_permutation_the_same_each_time(n: int, d: int) -> None:
    x = realization_rng(0, 0).random((n, d))
    order = progressive_order(x)
    assert np.array_equal(np.sort(order), np.arange(n))
    assert np.array_equal(order, progressive_order(x))


def test_no_exchange_betters_the_first_half() -> None:
    n, size = 40, 20
    x = realization_rng(1, 0).random((n, 2))
    order = progressive_order(x)
    half, rest, width = order[:size], order[size:], size**-0.5
    least = pair_energy(x[half], width)
    for k in range(size):
        for other in rest:
            exchanged = half.copy()
            exchanged[k] = other
            assert pair_energy(x[exchanged], width) > least - 1e-7


def test_floors_of_prefixes_are_the_measures() -> None:
    x = generate("jittered", n=256, seed=2)
    floors = prefix_noise_floors(x, [1, 100, 256])
    assert math.isnan(floors[0])
    assert floors[1] == pytest.approx(measures(x[:100])["noise_floor"])
    assert floors[2] == pytest.approx(measures(x)["noise_floor"])


def test_every_prefix_is_blue() -> None:
    """Of 256 points half in random order would have a floor of 0.5, a quarter 0.75."""
    x = generate("progressivegbn", n=256)
    floors = prefix_noise_floors(x, [64, 96, 128, 192, 256])
    assert np.all(floors < 0.06)
    assert floors[-1] < 1e-6
    gbn = generate("gbn", n=256)
    assert np.array_equal(np.unique(x, axis=0), np.unique(gbn, axis=0))


@pytest.mark.slow
def test_halves_quarters_and_eighths_have_the_floors_documented() -> None:
    sets = generate("progressivegbn", n=1024, realizations=3)
    floors = np.mean([prefix_noise_floors(x, [128, 256, 512]) for x in sets], axis=0)
    assert np.all(floors < 8e-3)


@pytest.mark.parametrize(
    ("x", "sigma", "message"), [([[[0.5]]], 1.0, "one set"), ([[0.5]], 0.1, "sigma must be 0.2 to 2")]
)
def test_wrong_input_is_refused(x: list[list[float]], sigma: float, message: str) -> None:
    with pytest.raises(InputError, match=message):
        progressive_order(x, sigma)


def test_sizes_beyond_the_set_are_refused() -> None:
    with pytest.raises(InputError, match="sizes must be 1 to 4"):
        prefix_noise_floors(np.arange(4)[:, None] / 4, [5])
    with pytest.raises(InputError, match="prefix_sigma must lie"):
        generate("progressivegbn[prefix_sigma=3]", n=4)
