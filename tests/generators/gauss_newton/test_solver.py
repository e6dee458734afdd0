"""Points reach the amplitudes asked of them, by the shortest steps, or say that they do not."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.core.errors import InputError
from gbnbench.core.torus import displacement
from gbnbench.generators.gauss_newton.modes import modes_below
from gbnbench.generators.gauss_newton.solver import solve_for_amplitudes
from gbnbench.generators.gauss_newton.targets import smooth_radial_power, target_amplitudes
from gbnbench.generators.gbn.generator import GaussianBlueNoise
from gbnbench.generators.protocol import realization_rng
from tests.oracles.gauss_newton import half_space_below, scaled_jacobian
from tests.oracles.power import amplitudes


def gaussian(n, d):
    """Far from rounding: on the line few gradients suffice for amplitudes with no meaningful phase."""
    return GaussianBlueNoise(gradients=5 if d == 1 else 40)(n, d, realization_rng(0, 0))


@pytest.mark.parametrize(("n", "d", "edge"), [(60, 1, 0.3), (100, 2, 0.6), (100, 3, 0.65), (100, 5, 0.8)])
def test_every_amplitude_reaches_its_target_in_phase_and_size(n, d, edge):
    x = gaussian(n, d)
    outcome = solve_for_amplitudes(x, lambda nu: 1e-20 + 0 * nu, edge)
    assert outcome.converged
    assert outcome.residual <= 1
    f = half_space_below(edge, n, d)
    before, after = amplitudes(x, f), amplitudes(outcome.x, f)
    below = modes_below(n, d, edge)
    order = np.lexsort(below.f.T[::-1])
    assert np.array_equal(below.f[order], f[np.lexsort(f.T[::-1])])
    place = np.lexsort(f.T[::-1])
    expected = (
        np.sqrt(1e-20) * before[place] / np.sqrt(smooth_radial_power(before[place].astype(complex), below))
    )
    assert np.abs(after[place] - expected).max() < 2e-3 * math.sqrt(n * 1e-20) + 1e-12


@pytest.mark.parametrize(("n", "d", "edge"), [(50, 1, 0.3), (256, 2, 0.6), (125, 3, 0.7)])
def test_a_target_of_nothing_is_met_to_rounding(n, d, edge):
    outcome = solve_for_amplitudes(np.random.default_rng(1).random((n, d)), 0.0, edge)
    assert outcome.converged
    assert (np.abs(amplitudes(outcome.x, half_space_below(edge, n, d))) ** 2 / n).max() < 1e-25


def test_the_move_is_the_shortest_to_first_order():
    """A small change asked for is made by the pseudo-inverse of the explicit Jacobian."""
    n, edge = 80, 0.5
    x = gaussian(n, 2)
    below = modes_below(n, 2, edge)
    start = amplitudes(x, below.f).astype(complex)
    power = smooth_radial_power(start, below) * 1.0002
    outcome = solve_for_amplitudes(x, lambda nu: power, edge, tolerance=1e-9)
    jacobian = scaled_jacobian(x, below.f)
    missing = (target_amplitudes(start, below, power) - start) / (math.sqrt(n) * below.length)
    real = np.concatenate([jacobian.real, jacobian.imag])
    shortest = np.linalg.lstsq(real, np.concatenate([missing.real, missing.imag]))[0].reshape(n, 2)
    move = displacement(outcome.x, x) * math.sqrt(n)
    assert outcome.converged
    assert np.linalg.norm(move - shortest) < 1e-3 * np.linalg.norm(shortest)


def test_progress_is_told_of_every_step():
    seen = []
    outcome = solve_for_amplitudes(
        gaussian(100, 2), 1e-10, 0.5, progress=lambda step, residual: seen.append((step, residual))
    )
    assert [step for step, _ in seen] == list(range(outcome.steps + 1))
    assert seen[-1][1] == outcome.residual <= 1 < seen[0][1]


def test_what_cannot_be_is_not_called_converged():
    """At an edge of 0.9 in the plane amplitudes bind more numbers than there are coordinates."""
    outcome = solve_for_amplitudes(gaussian(64, 2), 1e-10, 0.9, steps=8, products=200)
    assert not outcome.converged
    assert outcome.residual > 1
    assert "amplitudes" in outcome.reason
    short = solve_for_amplitudes(gaussian(100, 2), 1e-10, 0.5, steps=1)
    assert not short.converged
    assert short.reason == "the amplitudes are not at their targets after 1 steps"


def test_nothing_below_the_edge_leaves_the_points():
    x = gaussian(20, 2)
    outcome = solve_for_amplitudes(x, 0.0, 0.1)
    assert outcome.converged
    assert np.array_equal(outcome.x, x)


def test_the_spread_of_a_ring_is_kept():
    """Scaled amplitudes over the target are exponential in power, as they were: variance 1, no ring off."""
    n = 4096
    below = modes_below(n, 2, 0.7)
    rng = np.random.default_rng(2)
    steep = np.exp(-20 * (0.49 - below.nu**2))
    start = np.sqrt(n * steep / 2) * (rng.normal(size=len(below)) + 1j * rng.normal(size=len(below)))
    power = np.exp(-80 * (0.49 - below.nu**2))
    share = np.abs(target_amplitudes(start, below, power)) ** 2 / n / power
    assert share.mean() == pytest.approx(1, abs=0.01)
    assert share.var() == pytest.approx(1, abs=0.15)


@pytest.mark.parametrize(
    ("target", "edge", "tolerance", "says"),
    [
        (-1.0, 0.5, 1e-3, "target must be finite and >= 0 below the edge; got -1.0 at nu=0"),
        (lambda nu: np.log(nu) * np.inf, 0.5, 1e-3, "target must be finite"),
        (0.0, -0.5, 1e-3, "edge must be positive and finite; got -0.5"),
        (0.0, math.nan, 1e-3, "edge must be positive"),
        (0.0, 0.5, 0.0, "tolerance must be positive"),
    ],
)
def test_wrong_arguments_are_named(target, edge, tolerance, says):
    with pytest.raises(InputError, match=says):
        solve_for_amplitudes(np.random.default_rng(0).random((64, 2)), target, edge, tolerance=tolerance)
