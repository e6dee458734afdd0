"""Strips against plain sums over pairs and images: hard sets, moves, and every form of the kernel."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.core.errors import RefusalError
from gbnbench.generators.gbn.strips import SKIN, Strips
from gbnbench.opencl import runtime
from gbnbench.opencl.runtime import Runtime
from tests.oracles.energy import pair_field

ALLOWED = {"double": 5e-14, "float": 2e-6}  # of the sum of the pairs' forces, each at most exp(-1/2) / sigma


def hard_sets(n, d):
    rng = np.random.default_rng(n)
    yield "scattered", rng.random((n, d))
    yield "clustered", 0.5 + 1e-3 * rng.standard_normal((n, d))
    yield "border", rng.choice([0.0, 1 - 2.0**-53, 2.0**-60], (n, d))
    yield "coincident", np.full((n, d), 0.25)
    yield "outside", rng.random((n, d)) * 7 - 3
    line = np.full((n, d), 0.5)
    line[:, -1] = rng.random(n)
    yield "line", line


@pytest.mark.slow
@pytest.mark.parametrize(
    ("n", "d", "sigma"),
    [(12, 1, 0.9), (53, 1, 0.3), (145, 2, 1.0), (64, 2, 0.4), (325, 2, 1.0), (60, 3, 0.3), (160, 3, 0.3)],
)
@pytest.mark.parametrize("precision", ["double", "float"])
def test_sums_agree_with_long_double_on_hard_sets(n, d, sigma, precision):
    if precision == "float" and n ** (1 / d) < 12 * sigma:
        with pytest.raises(RefusalError, match="sigmas wide"):
            Strips(runtime(), n, d, sigma, precision)
        return
    for name, x in hard_sets(n, d):
        at = Strips(runtime(), n, d, sigma, precision)(x[None])
        gradient, excess = pair_field(np.mod(x, 1.0), sigma)
        scale = 1 + abs(excess) + (2 * np.pi) ** (d / 2) * sigma**d  # what the sums are made of
        allowed = ALLOWED[precision] * scale / sigma
        assert np.abs(at.gradient[0] - gradient).max() <= allowed, name
        assert at.excess[0] == pytest.approx(excess, abs=ALLOWED[precision] * scale), name


@pytest.mark.parametrize("cutoff", [1.0, 2.0, 3.0])
@pytest.mark.parametrize("precision", ["double", "float"])
def test_a_kernel_may_end_early(cutoff, precision):
    x = np.random.default_rng(1).random((300, 2))
    at = Strips(runtime(), 300, 2, 0.9, precision, cutoff)(x[None])
    gradient, excess = pair_field(x, 0.9, cutoff)
    assert np.abs(at.gradient[0] - gradient).max() <= ALLOWED[precision]
    assert at.excess[0] == pytest.approx(excess, abs=ALLOWED[precision])


@pytest.mark.slow
@pytest.mark.parametrize("precision", ["double", "float"])
def test_moves_within_and_beyond_the_skin_keep_every_pair(precision):
    rng = np.random.default_rng(2)
    n, d = 500, 2
    x = rng.random((n, d))
    strips = Strips(runtime(), n, d, 1.0, precision)
    strips(x[None])
    for move in (0.9 * SKIN, 0.4 * SKIN, 3.0):
        angle = rng.random(n) * 2 * np.pi
        moved = x + move / n**0.5 * np.stack([np.cos(angle), np.sin(angle)], 1)
        gradient, excess = pair_field(moved, 1.0)
        at = strips(moved[None])
        assert np.abs(at.gradient[0] - gradient).max() <= ALLOWED[precision]
        assert at.excess[0] == pytest.approx(excess, abs=ALLOWED[precision])
    assert np.array_equal(strips.anchor[0], moved)  # sorted anew only after the last, farthest move


@pytest.mark.parametrize("precision", ["double", "float"])
def test_a_sets_numbers_do_not_depend_on_the_others(precision):
    rng = np.random.default_rng(3)
    x = rng.random((3, 330, 2))
    together, alone = (Strips(runtime(), 330, 2, 1.0, precision) for _ in range(2))
    for step in range(3):
        x[:2] += rng.standard_normal((2, 330, 2)) * 0.002 * step  # the third set stays where it is
        both = together(x)
        one = alone(x[2:])
        assert np.array_equal(both.gradient[2:], one.gradient)
        assert np.array_equal(both.excess[2:], one.excess)


@pytest.mark.parametrize("precision", ["double", "float"])
def test_the_form_for_gpus_agrees(monkeypatch, precision):
    monkeypatch.setattr(Runtime, "lanes", lambda *_: 1)
    monkeypatch.setattr(Runtime, "group", property(lambda _: 64))
    x = np.random.default_rng(4).random((1, 217, 3))
    at = Strips(runtime(), 217, 3, 0.3, precision)(x)
    gradient, excess = pair_field(x[0], 0.3)
    assert np.abs(at.gradient[0] - gradient).max() <= 3 * ALLOWED[precision]
    assert at.excess[0] == pytest.approx(excess, abs=ALLOWED[precision])


@pytest.mark.slow
def test_a_million_points_give_what_their_neighbours_say():
    """On a jittered million, ten points and their neighbours by distance, in long double."""
    side, d = 1000, 2
    rng = np.random.default_rng(5)
    cells = np.stack(np.meshgrid(*[np.arange(side)] * d, indexing="ij"), -1).reshape(-1, d)
    x = (cells + rng.random(cells.shape)) / side
    at = {p: Strips(runtime(), side**2, d, 1.0, p)(x[None]).gradient[0] for p in ("double", "float")}
    for k in rng.integers(0, side**2, 10):
        u = (x[k] - x).astype(np.longdouble)
        u = (u - np.rint(u)) * side
        r2 = (u**2).sum(1)
        near = r2 < 12**2
        force = -(np.exp(-r2[near] / 2)[:, None] * u[near]).sum(0).astype(float)
        assert np.abs(at["double"][k] - force).max() < 1e-12  # x is known to 1e-13 spacings
        assert np.abs(at["float"][k] - force).max() < 1e-5


@pytest.mark.parametrize(
    ("n", "d", "precision", "cutoff", "says"),
    [
        (100, 4, "double", None, "d=4"),
        (143, 2, "float", None, "11.96 sigmas wide"),
        (63, 2, "double", 4.0, "7.937 sigmas wide"),
        (143, 2, "double", None, "11.96 sigmas wide"),
    ],
)
def test_what_strips_cannot_sum_is_refused(n, d, precision, cutoff, says):
    with pytest.raises(RefusalError, match=says):
        Strips(runtime(), n, d, 1.0, precision, cutoff)
