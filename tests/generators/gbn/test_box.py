"""The box's energy against sums and quadrature; nothing leaves the box."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.spatial.edge_density import edge_density
from gbnbench.generators.gbn import energy_cost
from gbnbench.generators.gbn.box import BoxEnergy, domain_energy, domain_pull, fold
from gbnbench.generators.registry import generate
from gbnbench.opencl.runtime import Runtime
from tests.oracles.energy import box_field

ALLOWED = {"double": 5e-13, "float": 1e-5}  # of the largest component


CASES = [
    (50, 2, 1.0),
    (200, 2, 0.3),
    (200, 3, 0.5),
    (40, 1, 0.7),
    (2, 2, 1.0),
    (12, 20, 1.0),
    pytest.param(9, 1, 3.0, marks=pytest.mark.slow),
    pytest.param(64, 8, 3.0, marks=pytest.mark.slow),
]


@pytest.mark.parametrize(("n", "d", "sigma"), CASES)
@pytest.mark.parametrize("precision", ["double", "float"])
def test_energy_and_gradient_agree_with_quadrature(n, d, sigma, precision):
    rng = np.random.default_rng(n)
    sets = np.stack(
        [rng.random((n, d)), 0.5 + 1e-3 * rng.standard_normal((n, d)), rng.choice([0, 1 - 2.0**-53], (n, d))]
    )
    at = BoxEnergy(n, d, sigma, precision)(sets)
    for x, gradient, excess in zip(sets, at.gradient, at.excess, strict=True):
        expected, least = box_field(x, sigma)
        allowed = ALLOWED[precision] * (np.abs(expected).max() + 1 / sigma)
        assert np.abs(gradient - expected).max() <= allowed
        assert excess == pytest.approx(least, rel=ALLOWED[precision], abs=ALLOWED[precision])
        assert excess > 0


@pytest.mark.parametrize(("n", "d", "sigma"), [(900, 2, 0.5), (1500, 3, 0.3), (500, 1, 1.0)])
@pytest.mark.parametrize("precision", ["double", "float"])
def test_strips_give_what_all_pairs_give(monkeypatch, n, d, sigma, precision):
    x = np.random.default_rng(d).random((2, n, d))
    cut = BoxEnergy(n, d, sigma, precision)
    assert cut.method == "box, strips"
    monkeypatch.setitem(energy_cost.SHARE, "strips", 1e-9)
    whole = BoxEnergy(n, d, sigma, precision)
    assert whole.method == "box, images"
    one, other = cut(x), whole(x)
    assert one.gradient == pytest.approx(other.gradient, abs=20 * ALLOWED[precision])
    assert one.excess == pytest.approx(other.excess, rel=ALLOWED[precision], abs=ALLOWED[precision])


def test_a_set_is_the_same_in_any_company():
    rng = np.random.default_rng(3)
    for n, d, sigma in ((900, 2, 0.5), (60, 3, 1.0)):
        x = rng.random((3, n, d))
        field = BoxEnergy(n, d, sigma)
        together, alone = field(x), [field(each[None]) for each in x]
        assert np.array_equal(together.gradient, np.concatenate([at.gradient for at in alone]))
        assert np.array_equal(together.excess, np.concatenate([at.excess for at in alone]))


def test_the_pull_is_the_slope_of_its_potential():
    u, step = np.random.default_rng(1).random((20, 3)) * 5, 1e-5
    _, gradient = domain_pull(u, 5.0, 0.8)
    for a in range(3):
        aside = step * np.eye(3)[a]
        difference = domain_pull(u + aside, 5.0, 0.8)[0] - domain_pull(u - aside, 5.0, 0.8)[0]
        assert gradient[:, a] == pytest.approx(difference / (2 * step), abs=1e-8)


@pytest.mark.slow
def test_the_domains_energy_is_that_of_a_fine_grid_of_points():
    v = (np.arange(4000) + 0.5) * 3 / 4000
    direct = np.exp(-((v[:, None] - v) ** 2) / (2 * 0.7**2)).sum() * (3 / 4000) ** 2
    assert domain_energy(3.0, 2, 0.7) == pytest.approx(direct**2, rel=1e-6)


@pytest.mark.parametrize(
    ("n", "d", "sigma"), [(400, 2, 1.0), (30, 1, 1.0), (64, 3, 0.7), (256, 8, 1.0), (9, 2, 3.0), (64, 6, 2.0)]
)
def test_the_curvature_is_that_of_the_hessian(n, d, sigma):
    """The largest eigenvalue by differences of the gradient, near a minimum: a step of 1.2 / it is stable."""
    field = BoxEnergy(n, d, sigma, "double")
    side, largest = n ** (1 / d), max(field.curvature, 2 / sigma**2)
    x = np.random.default_rng(0).random((1, n, d))
    for _ in range(40):
        x = x - 1.2 / largest * field(x).gradient / side
    v = np.random.default_rng(n).standard_normal(x.shape)
    for _ in range(40):
        v /= np.linalg.norm(v)
        aside = 1e-5 * v / side
        v = (field(x + aside).gradient - field(x - aside).gradient) / 2e-5
    assert 0.3 * largest < np.linalg.norm(v) < 2 / 1.2 * largest


def test_folding_keeps_inside_points_and_mirrors_the_rest():
    x = np.array([0.0, 2.0**-60, 0.3, 1 - 2.0**-53, 1.0, 1.2, -0.2, -1e-17, 7.6, -3.3])
    folded = fold(x)
    assert np.array_equal(folded[:4], x[:4])
    assert np.all((folded >= 0) & (folded < 1))
    assert folded[4:] == pytest.approx([1, 0.8, 0.2, 0, 0.4, 0.7], abs=1e-12)


@pytest.mark.parametrize(("n", "d"), [(30, 1), (40, 2), (40, 3), (20, 8)])
@pytest.mark.parametrize("sigma", [0.3, 1.0, 3.0])
def test_the_mirror_image_has_the_same_energy_and_the_mirrored_gradient(n, d, sigma):
    rng = np.random.default_rng(d)
    inside = rng.random((1, n, d))
    flip, turns = rng.integers(0, 2, inside.shape), 2 * rng.integers(-3, 4, inside.shape)
    outside = np.where(flip, -inside, inside) + turns
    field = BoxEnergy(n, d, sigma)
    at, there = field(inside), field(outside)
    assert there.excess == pytest.approx(at.excess, rel=1e-12, abs=1e-13)
    assert there.gradient == pytest.approx(np.where(flip, -1, 1) * at.gradient, abs=1e-11)
    assert field.mirrored == np.count_nonzero((outside < 0) | (outside >= 1))


@pytest.mark.parametrize(("n", "d"), [(30, 1), (60, 2), (40, 3), (20, 8)])
@pytest.mark.parametrize("sigma", [0.3, 1.0, 3.0])
def test_descent_leaves_no_point_outside_even_from_the_border_with_large_steps(n, d, sigma):
    rng = np.random.default_rng(n)
    field = BoxEnergy(n, d, sigma)
    for start in (
        rng.random((n, d)),
        rng.choice([0.0, 1 - 2.0**-53], (n, d)) * rng.choice([1.0, 0.999], (n, d)),
    ):
        for factor in (1.0, 20.0):
            x, first = start[None], field(start[None]).excess[0]
            for _ in range(60):
                step = factor / max(field.curvature, 2 / sigma**2) * field(x).gradient
                x = x - step / n ** (1 / d)
            placed = fold(x)
            assert np.all((placed >= 0) & (placed < 1))
            if factor == 1:
                assert field(x).excess[0] < first
                assert field(placed).excess == pytest.approx(field(x).excess, abs=1e-10)


@pytest.mark.parametrize(("n", "d"), [(256, 2), (100, 3), (40, 1), (60, 8)])
def test_the_generator_draws_in_the_box_and_beats_uniform_points(n, d):
    x = generate("gbn", n=n, d=d, realizations=2, domain="box", gradients=150)
    assert np.all((x >= 0) & (x < 1))
    start = generate("gbn", n=n, d=d, realizations=2, domain="box", gradients=0)
    field = BoxEnergy(n, d, 1.0)
    assert np.all(field(x).excess < 0.05 * field(start).excess)
    assert np.array_equal(x[1], generate("gbn[domain=box,gradients=150]", n=n, d=d, realizations=2)[1])


def test_the_extreme_points_end_a_quarter_spacing_inside():
    found = edge_density(generate("gbn", n=256, d=2, realizations=8, domain="box", gradients=150))
    assert found.extreme == pytest.approx(0.27, abs=0.05)
    deep = found.edges[:-1] > 1
    assert np.average(found.density[deep]) == pytest.approx(1, abs=0.05)


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize(("n", "d", "sigma"), [(900, 2, 0.5), (60, 3, 1.0)])
def test_one_lane_and_groups_of_64_give_the_same(monkeypatch, n, d, sigma, precision):
    x = np.random.default_rng(n).random((2, n, d))
    vectors = BoxEnergy(n, d, sigma, precision)(x)
    monkeypatch.setattr(Runtime, "lanes", lambda self, name: 1)
    monkeypatch.setattr(Runtime, "group", property(lambda self: 64))
    scalars = BoxEnergy(n, d, sigma, precision)(x)
    assert scalars.gradient == pytest.approx(vectors.gradient, abs=20 * ALLOWED[precision])
    assert scalars.excess == pytest.approx(vectors.excess, rel=ALLOWED[precision])
