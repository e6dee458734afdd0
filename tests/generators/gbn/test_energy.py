"""The energy's evaluations against mpmath's theta functions, image sums, single modes, and one another."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.core.errors import InputError, RefusalError
from gbnbench.generators.gbn import kernel
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.harmonics import Harmonics
from gbnbench.generators.gbn.images import Images
from gbnbench.generators.gbn.methods import METHODS
from gbnbench.generators.gbn.plan import plan_energy
from gbnbench.generators.gbn.theta import Theta
from gbnbench.opencl import Runtime, runtime
from gbnbench.opencl.width_probe import VectorWidths
from tests.oracles.energy import frequency_field, image_field, theta_field

EXCESS = {"double": 1e-14, "float": 1e-6}  # error of Ex, over the uniform energy and theta(0)^d


def serving(n, d, sigma, precision):
    """Every method that serves this size."""
    for method in METHODS:
        try:
            yield energy_evaluation(n, d, sigma, precision, method=method)
        except RefusalError:
            continue


def check(evaluate, n, d, sigma, precision, x, expected):
    """The gradient is within the stated error; the excess energy within a few roundings of its terms."""
    gradient, excess = expected
    at = evaluate(x[None])
    assert at.gradient.shape == (1, n, d)
    assert at.excess.shape == (1,)
    allowed = evaluate.error * kernel.largest_force(n, d, sigma)
    assert np.abs(at.gradient[0] - gradient).max() <= allowed, evaluate.method
    scale = kernel.uniform_energy(d, sigma) + max(1.0, kernel.uniform_energy(d, sigma) / n)
    lost = max(1.0, evaluate.error / math.sqrt(n) / EXCESS[precision])
    assert abs(at.excess[0] - excess) <= EXCESS[precision] * lost * (scale + abs(excess)), evaluate.method


@pytest.mark.parametrize(
    ("n", "d", "sigma"),
    [
        *((7, 1, 0.5), (9, 2, 0.3), (8, 3, 1.3), (4, 2, 3.0)),
        *(pytest.param(*case, marks=pytest.mark.slow) for case in ((2, 2, 1.0), (6, 5, 1.0), (3, 1, 3.0))),
        pytest.param(4, 20, 1.0, marks=pytest.mark.slow),
    ],
)
def test_small_boxes_agree_with_the_theta_function(n, d, sigma):
    x = np.random.default_rng(n).random((n, d))
    expected = theta_field(x, sigma)
    for precision in ("double", "float"):
        fields = list(serving(n, d, sigma, precision))
        assert len(fields) > 1
        for evaluate in fields:
            check(evaluate, n, d, sigma, precision, x, expected)


@pytest.mark.parametrize(("n", "d", "sigma"), [(2, 2, 1.5), (2, 2, 3.0), (3, 2, 3.0), (14, 3, 3.0)])
def test_kernels_wider_than_the_box_are_off_by_the_rounding_of_its_side(n, d, sigma):
    """The lowest weight, exp(-89) for two points at sigma = 3, multiplies the rounding of its exponent."""
    for seed in range(3):
        x = np.random.default_rng(seed).random((n, d))
        gradient = theta_field(x, sigma, 120)[0]
        by_side = 1e-15 * kernel.decay(kernel.side_of(n, d), sigma) * np.abs(gradient).max()
        for evaluate in serving(n, d, sigma, "double"):
            allowed = evaluate.error * kernel.largest_force(n, d, sigma) + by_side
            assert np.abs(evaluate(x[None]).gradient[0] - gradient).max() <= allowed, evaluate.method


HARD = {
    "scattered": lambda rng, n, d: rng.random((n, d)),
    "clustered": lambda rng, n, d: 0.5 + 1e-3 * rng.standard_normal((n, d)),
    "on the border": lambda rng, n, d: rng.choice([0.0, 1 - 2.0**-53, 2.0**-60], (n, d)),
    "coincident": lambda rng, n, d: np.full((n, d), 0.3),
}


# 324 and 325, 144 and 145, 81 and 82: on both sides of 18, 12 and 9 sigmas a side, where images come in.
@pytest.mark.parametrize(
    ("n", "d", "sigma"),
    [
        *((n, 2, 1.0) for n in (64, 81, 82, 144, 145, 324, 325)),
        *((509, 2, 0.3), (53, 1, 1.0), (347, 3, 0.35), (500, 2, 3.0)),
    ],
)
def test_all_evaluations_agree_with_image_sums_on_hard_sets(n, d, sigma):
    rng = np.random.default_rng(n)
    for make in HARD.values():
        x = make(rng, n, d)
        expected = image_field(x, sigma)
        for precision in ("double", "float"):
            fields = list(serving(n, d, sigma, precision))
            assert len(fields) > 1
            for evaluate in fields:
                check(evaluate, n, d, sigma, precision, x, expected)


def test_the_oracles_agree():
    x = np.random.default_rng(0).random((9, 2))
    for (one, energy), (other, same) in ((theta_field(x, 0.8), image_field(x, 0.8)),):
        assert one == pytest.approx(other, abs=1e-15)
        assert energy == pytest.approx(same, abs=1e-15)
    whole = frequency_field(x, 0.8, 4.0)
    assert whole[0] == pytest.approx(one, abs=1e-14)
    assert whole[1] == pytest.approx(energy, abs=1e-14)


@pytest.mark.parametrize(
    ("n", "d", "sigma"), [(64, 2, 1.0), (53, 3, 0.7), pytest.param(37, 8, 1.0, marks=pytest.mark.slow)]
)
@pytest.mark.parametrize("precision", ["double", "float"])
def test_a_set_is_bitwise_the_same_in_any_company(n, d, sigma, precision):
    x = np.random.default_rng(n).random((5, n, d))
    for evaluate in serving(n, d, sigma, precision):
        together = evaluate(x)
        for k in (0, 3):
            alone = evaluate(x[k : k + 1])
            assert np.array_equal(alone.gradient[0], together.gradient[k]), evaluate.method
            assert alone.excess[0] == together.excess[k], evaluate.method
        assert np.array_equal(evaluate(x[:2]).gradient, together.gradient[:2])


def test_sets_too_many_for_the_buffers_come_in_turns(monkeypatch):
    from gbnbench.generators.gbn import operation_counts

    x = np.random.default_rng(1).random((7, 40, 2))
    whole = energy_evaluation(40, 2, 1.0, method="theta")(x)
    monkeypatch.setattr(
        operation_counts, "LARGEST", 3 * energy_evaluation(40, 2, 1.0, method="theta").bytes_a_set()
    )
    parts = energy_evaluation(40, 2, 1.0, method="theta")(x)
    assert np.array_equal(whole.gradient, parts.gradient)
    assert np.array_equal(whole.excess, parts.excess)


class Single(Runtime):
    """The device with one number a work-item in groups of 64, as a GPU works."""

    widths = VectorWidths(1, 1)
    group = 64


@pytest.fixture(scope="module")
def single():
    return Single(runtime().device)


@pytest.mark.parametrize("precision", ["double", "float"])
@pytest.mark.parametrize(
    ("n", "d", "sigma"), [(83, 2, 1.0), pytest.param(37, 4, 0.4, marks=pytest.mark.slow)]
)
def test_single_lanes_in_groups_agree_with_vectors(single, n, d, sigma, precision):
    x = np.random.default_rng(n).random((3, n, d))
    for kind in (Theta, Images, Harmonics):
        vectors = kind(runtime(), n, d, sigma, precision)(x)
        lanes = kind(single, n, d, sigma, precision)
        allowed = 2 * lanes.error * kernel.largest_force(n, d, sigma)
        assert lanes(x).gradient == pytest.approx(vectors.gradient, abs=allowed, rel=0)
        assert lanes(x).excess == pytest.approx(
            vectors.excess, abs=10 * EXCESS[precision] * (1 + sigma**d * 40)
        )


@pytest.mark.parametrize(("n", "d", "fmax"), [(400, 2, 30), (64, 2, 20), (50, 3, 8)])
def test_excess_is_the_weighted_sum_of_the_power(n, d, fmax):
    x = np.random.default_rng(n).random((n, d))
    power = periodogram(x, fmax).power
    f = np.indices(power.shape) - fmax
    q2 = (2 * np.pi / n ** (1 / d)) ** 2 * (f**2).sum(axis=0)
    weight = (2 * np.pi) ** (d / 2) * np.exp(-q2 / 2)
    weight[(fmax,) * d] = 0
    for evaluate in serving(n, d, 1.0, "double"):
        found = evaluate(x[None]).excess[0]
        assert found == pytest.approx((weight * power).sum() / (2 * n), rel=1e-12), evaluate.method


@pytest.mark.parametrize(("n", "d", "sigma"), [(4, 2, 3.0), (2, 1, 3.0), (3, 20, 3.0), (9, 2, 3.0)])
@pytest.mark.parametrize("precision", ["double", "float"])
def test_a_flat_kernel_keeps_its_digits(n, d, sigma, precision):
    """Where theta departs from its mean by 1e-20 or 1e-70, the forces are as good as anywhere: no stall."""
    x = np.random.default_rng(n).random((n, d))
    gradient, excess = theta_field(x, sigma, digits=120)
    digits = {"double": 1e-12, "float": 1e-4}[precision]
    for method in ("theta", "harmonics"):
        at = energy_evaluation(n, d, sigma, precision, method=method)(x[None])
        assert np.abs(at.gradient[0] - gradient).max() <= digits * np.abs(gradient).max()
        assert at.excess[0] == pytest.approx(excess, rel=digits)


@pytest.mark.parametrize("method", ["theta", "harmonics"])
def test_the_force_of_a_flat_kernel_is_in_proportion_to_a_small_distance(method):
    evaluate = energy_evaluation(2, 2, 3.0, "double", method=method)
    forces = []
    for apart in (1e-3, 1e-6, 1e-9):
        x = np.array([[0.25, 0.5], [0.25 + apart, 0.5]])
        x[1, 0] = 0.25 + (x[1, 0] - 0.25)
        at = evaluate(x[None]).gradient[0]
        assert at[0, 0] > 0 > at[1, 0]  # apart: the energy falls
        forces.append(at[0, 0] / (x[1, 0] - x[0, 0]))
    assert forces[1] == pytest.approx(forces[0], rel=1e-4)
    assert forces[2] == pytest.approx(forces[1], rel=1e-6)


def test_forces_keep_their_digits_across_the_border():
    """Two points a hair apart on either side of 0: every evaluation must see their distance."""
    for apart in (1e-9, 1e-12):
        x = np.array([[apart / 2, 0.3], [1 - apart / 2, 0.3], [0.5, 0.6]])
        moved = np.array([[0.5 + apart / 2, 0.3], [0.5 - apart / 2, 0.3], [0.0, 0.6]])
        for method in ("theta", "harmonics"):
            near, same = energy_evaluation(3, 2, 1.0, "double", method=method)(np.stack([x, moved])).gradient
            assert near[0, 0] == pytest.approx(same[0, 0], abs=1e-15)


@pytest.mark.parametrize(
    ("n", "d", "edge"),
    [
        (200, 2, 0.5),
        (120, 3, 0.7),
        *(pytest.param(*case, marks=pytest.mark.slow) for case in ((100, 1, 0.4), (30, 4, 0.9))),
    ],
)
@pytest.mark.parametrize("precision", ["double", "float"])
def test_an_edge_keeps_the_modes_within_it(n, d, edge, precision):
    x = np.random.default_rng(n).random((n, d))
    evaluate = energy_evaluation(n, d, 1.0, precision, edge=edge)
    assert evaluate.method == "harmonics"
    check(evaluate, n, d, 1.0, precision, x, frequency_field(x, 1.0, edge))
    beyond = energy_evaluation(n, d, 1.0, precision, edge=50.0)(x[None])
    assert beyond.gradient == pytest.approx(
        energy_evaluation(n, d, 1.0, precision)(x[None]).gradient, abs=1e-5
    )


def test_points_out_of_the_unit_box_are_wrapped():
    x = np.random.default_rng(3).integers(0, 1 << 40, (1, 30, 2)) / 2.0**40
    for evaluate in serving(30, 2, 1.0, "double"):
        assert evaluate(x + np.array([3.0, -2.0])).gradient == pytest.approx(evaluate(x).gradient, abs=1e-14)


def test_another_shape_is_refused():
    with pytest.raises(InputError, match=r"x must be \(sets, 30, 2\); got shape \(30, 2\)"):
        energy_evaluation(30, 2, 1.0)(np.zeros((30, 2)))


@pytest.mark.parametrize("precision", ["double", "float"])
def test_where_the_plan_changes_its_mind_both_agree(precision):
    rng = np.random.default_rng(5)
    sizes = [*range(2, 60, 3), *range(60, 500, 20)]
    methods = [plan_energy(n, 2, 1.0, precision).method for n in sizes]
    changes = [k for k in range(1, len(sizes)) if methods[k] != methods[k - 1]]
    assert changes
    for n in {sizes[k - below] for k in changes for below in (0, 1)}:
        x = rng.random((1, n, 2))
        first, *others = serving(n, 2, 1.0, precision)
        assert others
        for other in others:
            allowed = (first.error + other.error) * kernel.largest_force(n, 2, 1.0)
            assert np.abs(first(x).gradient - other(x).gradient).max() <= allowed
