"""The plan chooses deterministically, explains itself, and refuses in words what no evaluation does."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.core.integer_frequencies import shell_counts
from gbnbench.generators.gbn import kernel, operation_counts
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.frequency_ball import ball_volume, square_needed
from gbnbench.generators.gbn.plan import plan_energy
from gbnbench.generators.gbn.wave_tables import TILE, ball_waves


def dense_counts(d, square):
    """Counts of every |f|^2 from 0 to square."""
    counts = np.zeros(square + 1)
    squares, occurring = shell_counts(d, square)
    counts[squares] = occurring
    return counts


@pytest.mark.parametrize(
    ("n", "d", "sigma", "method"),
    [
        (100_000, 2, 1.0, "strips"),
        (1_000_000, 3, 1.0, "strips"),
        (1024, 8, 1.0, "theta"),
        (256, 20, 1.0, "theta"),
        (2, 2, 1.0, "theta"),
        (1000, 4, 0.3, "images"),
        (1024, 2, 3.0, "harmonics"),
        (4096, 8, 3.0, "harmonics"),
    ],
)
def test_the_cheapest_is_chosen(n, d, sigma, method):
    found = plan_energy(n, d, sigma, "double")
    assert found.method == method
    assert found.chosen.effort == min(c.effort for c in (found.chosen, *found.others))


@pytest.mark.parametrize("precision", ["double", "float"])
def test_every_size_has_an_evaluation(precision):
    for d in (*range(1, 9), 12, 20):
        for sigma in (0.3, 1.0, 3.0):
            for n in (2, 3, 10, 100, 1000, 4096):
                found = plan_energy(n, d, sigma, precision)
                assert math.isfinite(found.chosen.effort)
                across = n ** (1 / d) / sigma * 2.0**-53 * n  # coordinates are no finer
                assert found.error < {"double": 2e-14, "float": 2e-5}[precision] * n + across


def test_the_number_of_sets_changes_the_price_only():
    one, many = (plan_energy(300, 2, 1.0, "double", sets=sets) for sets in (1, 64))
    assert one.method == many.method
    assert many.flops == 64 * one.flops
    assert one.seconds() < many.seconds() < 64 * one.seconds()


def test_it_explains_itself():
    text = str(plan_energy(1024, 8, 1.0, "double"))
    assert "theta: all pairs, degree 3; the cheapest that is exact to the precision" in text
    assert "strips" in text
    assert "d=8" in text
    assert "asked for" in str(plan_energy(1024, 8, 1.0, "double", method="harmonics"))


def test_image_sums_that_lose_digits_come_last():
    found = plan_energy(2, 2, 1.0, "float")
    lossy = next(c for c in found.others if c.method == "images")
    assert lossy.error > 100 * found.error
    assert found.others[-1] is lossy


@pytest.mark.parametrize(
    ("settings", "says"),
    [
        ({"n": 0}, "n, d and sets"),
        ({"sigma": math.nan}, "sigma must be positive"),
        ({"precision": "half"}, 'precision must be "double" or "float"'),
        ({"method": "guess"}, "method must be one of strips"),
        ({"cutoff": 1.0, "edge": 0.5}, "give one of them"),
        ({"cutoff": -1.0}, "cutoff must be positive"),
        ({"edge": 0.0}, "edge must be positive"),
        ({"edge": 0.01}, "leaves no frequency of 100 points in 2D: the lowest is 0.1"),
        ({"edge": 0.5, "method": "theta"}, "edge is a setting of method harmonics"),
        ({"cutoff": 1.0, "method": "theta"}, "cutoff is a setting of method strips"),
    ],
)
def test_what_makes_no_sense_is_refused(settings, says):
    with pytest.raises(InputError, match=says):
        plan_energy(**{"n": 100, "d": 2, "sigma": 1.0, "precision": "double", **settings})


@pytest.mark.parametrize(
    ("settings", "says"),
    [
        ({"method": "strips"}, "from 12 sigmas, n=145"),
        ({"method": "strips", "d": 4}, "1 to 3 dimensions"),
        ({"method": "images", "n": 3}, "21 images|images a dimension"),
        ({"method": "theta", "n": 10_000}, "100 sigmas wide"),
        ({"method": "harmonics", "n": 10**9, "d": 3}, "waves of 2 axes"),
        ({"cutoff": 8.0}, "10 sigmas wide; strips within 8 sigmas serve boxes from 16"),
    ],
)
def test_methods_say_what_they_cannot_serve(settings, says):
    with pytest.raises(RefusalError, match=says):
        plan_energy(**{"n": 100, "d": 2, "sigma": 1.0, "precision": "double", **settings})


def test_waves_too_many_for_the_memory_are_refused():
    with pytest.raises(RefusalError, match="bytes; method harmonics takes"):
        energy_evaluation(1_000_000, 2, 1.0, "double", edge=1.0)


@pytest.mark.slow
def test_costs_are_those_of_the_evaluations():
    """The count of frequencies, of images and the degree stand both in the plan and in what runs."""
    for n, d, sigma in ((64, 2, 1.0), (300, 2, 1.0), (40, 5, 0.5)):
        for precision in ("double", "float"):
            modes = energy_evaluation(n, d, sigma, precision, method="harmonics").modes
            assert (
                operation_counts.harmonics(n, d, sigma, precision).detail
                == f"{ball_volume(d, modes.square):.4g} frequencies"
            )
            assert operation_counts.harmonics(n, d, sigma, precision).work == pytest.approx(
                n * modes.products, rel=0.35
            )
            degree = energy_evaluation(n, d, sigma, precision, method="theta").degree
            assert operation_counts.theta(n, d, sigma, precision).instructions == n * n * d * (2 * degree + 9)


@pytest.mark.parametrize(("d", "square"), [(1, 20), (2, 30), (3, 14), (4, 9), (6, 3)])
def test_a_ball_has_each_of_its_frequencies_once(d, square):
    reach = math.isqrt(square)
    f = np.indices((2 * reach + 1,) * d).reshape(d, -1) - reach
    squares = (f**2).sum(axis=0)
    assert np.array_equal(dense_counts(d, square), np.bincount(squares, minlength=square + 1)[: square + 1])
    modes = ball_waves(d, square)
    weights = modes.weights(0.0)  # each real wave stands for 2^(axes with f != 0) / 2^(same) frequencies
    held = np.zeros_like(weights, dtype=bool)
    for i, j in modes.tiles:
        held[i : i + TILE[0], j : j + TILE[1]] = True
    assert np.array_equal(weights > 0, held & (weights > 0))
    assert np.count_nonzero(weights) == np.count_nonzero((squares > 0) & (squares <= square))


@pytest.mark.parametrize(
    ("n", "d", "sigma"), [(50, 1, 1.0), (300, 2, 1.0), (20, 2, 3.0), (100, 3, 0.5), (9, 7, 1.0)]
)
@pytest.mark.parametrize("precision", ["double", "float"])
def test_frequencies_left_out_do_not_show(n, d, sigma, precision):
    """Their forces add up to less than a rounding of the largest force of one pair; none is wasted."""
    square, side = square_needed(n, d, sigma, precision), n ** (1 / d)
    b = 2 * (math.pi * sigma / side) ** 2
    more = square + math.ceil(60 / b) + 60
    s = np.arange(square + 1, more)
    tail = np.sum(np.sqrt(s) * dense_counts(d, more)[square + 1 : more] * np.exp(-b * s))
    mean = (math.sqrt(2 * math.pi) * sigma / side) ** d
    left_out = 2 * math.pi / side * mean * tail / kernel.largest_force(n, d, sigma)
    assert left_out <= kernel.EPS[precision]
    if square > 20:  # a ball a sixth smaller would show
        s = np.arange(math.ceil(square / 1.2), more)
        assert 2 * math.pi / side * mean * np.sum(
            np.sqrt(s) * dense_counts(d, more)[s[0] : more] * np.exp(-b * s)
        ) > (kernel.EPS[precision] * kernel.largest_force(n, d, sigma) / 4)


@pytest.mark.parametrize("ratio", [0.3, 1.0, 2.4, 8.0, 13.0, 18.0])
@pytest.mark.parametrize("precision", ["double", "float"])
def test_the_polynomial_is_theta(ratio, precision):
    order = kernel.degree(ratio, 1.0, precision)
    flat = kernel.unit(ratio, 1.0, 1, precision) != 1
    found = kernel.polynomial(ratio, 1.0, order, flat)
    u = np.linspace(0, 0.5, 41)
    w = np.exp(-2 * (np.pi / ratio) ** 2 * (np.arange(1, 80) ** 2 - (1 if flat else 0)))
    exact = 2 * np.cos(2 * np.pi * np.outer(u, np.arange(1, 80))) @ w
    value = np.polynomial.polynomial.polyval(np.cos(2 * np.pi * u), found)
    assert np.abs(value - exact).max() <= (kernel.EPS[precision] + 30 * 2.0**-53) * exact[0]
    assert np.abs(found[1:]).sum() <= 1.1 * exact[0] + 1.1  # Horner's scheme is well conditioned
    # harmonics beyond are needed only one by one: half as many would show
    if order > 3:
        assert w[order // 2] > kernel.EPS[precision] * exact[0]
