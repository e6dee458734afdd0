"""The sum of energies over projections: text, gradient, balance, and what it does to the projections."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.radial.projections import projections
from gbnbench.core.errors import InputError
from gbnbench.core.torus import wrap
from gbnbench.generators.gbn.energy import energy_evaluation
from gbnbench.generators.gbn.optimiser import Nesterov
from gbnbench.generators.gbn.projective import ProjectiveEnergy, shares, subsets
from gbnbench.generators.gbn.step_sizes import step_size
from gbnbench.generators.protocol import realization_rng
from gbnbench.generators.registry import generate


@pytest.mark.parametrize(
    ("text", "d", "expected"),
    [
        ("1", 2, ((0,), (1,))),
        ("2", 3, ((0, 1), (0, 2), (1, 2))),
        ("1,2", 3, ((0,), (1,), (2,), (0, 1), (0, 2), (1, 2))),
        ("2+0 / +1", 4, ((0, 2), (1,))),
        ("0+1/2", 3, ((0, 1), (0, 2), (1, 2))),
    ],
)
def test_subsets_are_read(text, d, expected):
    assert subsets(text, d) == expected


@pytest.mark.parametrize("text", ["", "0", "2", "x", "0+0", "+2", "0+1", "1//1", "1-2"])
def test_projections_that_make_no_sense_are_refused(text):
    with pytest.raises(InputError, match="projection"):
        subsets(text, 2)


def test_too_many_projections_are_refused():
    with pytest.raises(InputError, match="more than 1000"):
        subsets("10", 30)


@pytest.mark.parametrize(
    ("n", "d", "text", "edge"), [(40, 3, "1/0+2", None), (30, 2, "1", 0.3), (25, 4, "2", None)]
)
def test_the_gradient_is_that_of_the_sum(n, d, text, edge):
    evaluate = ProjectiveEnergy(
        n, d, 1.0, subsets(text, d), edge=edge, weights={(0,): 0.5}, precision="double"
    )
    x = np.random.default_rng(n).random((2, n, d))
    at, step = evaluate(x), 1e-6 / n ** (1 / d)
    for k, a in ((0, 0), (1, 1), (n - 1, d - 1)):
        aside = np.zeros((2, n, d))
        aside[:, k, a] = step
        slope = (evaluate(x + aside).excess - evaluate(x - aside).excess) / 2e-6 * n
        assert at.gradient[:, k, a] == pytest.approx(slope, rel=1e-5, abs=1e-7)
    alone = evaluate(x[1:])
    assert np.array_equal(at.gradient[1:], alone.gradient)
    total = 0.0
    for axes, scale in evaluate.scale.items():
        term = energy_evaluation(n, len(axes), 1.0, "double", edge=edge if len(axes) < d else None)
        total = total + scale * term(np.ascontiguousarray(x[:, :, axes])).excess
    assert at.excess == pytest.approx(total)


@pytest.mark.parametrize(("n", "d", "text"), [(256, 2, "1"), (216, 3, "2"), (125, 3, "1/2")])
def test_the_whole_energys_step_is_stable_for_the_sum(n, d, text):
    evaluate = ProjectiveEnergy(n, d, 1.0, subsets(text, d), precision="double")
    side, size = n ** (1 / d), step_size(n, d, 1.0)
    x = np.random.default_rng(0).random((1, n, d))
    before = np.inf
    for _ in range(40):
        at = evaluate(x)
        assert at.excess[0] < before
        before = at.excess[0]
        x = x - size * at.gradient / side


def test_projections_become_blue_and_the_set_stays_so():
    n, chosen = 256, subsets("1", 2)
    evaluate = ProjectiveEnergy(n, 2, 1.0, chosen, edge=0.3)
    starts = np.stack([realization_rng(seed, 0).random((n, 2)) for seed in (0, 1)])
    run = Nesterov(evaluate, starts, step_size(n, 2, 1.0))
    for _ in range(300):
        run.advance()
    ours = projections(wrap(run.x), [(0, 1), (0,), (1,)])
    plain = projections(generate("gbn", n=n, d=2, realizations=2, gradients=300), [(0, 1), (0,), (1,)])
    assert plain[1].noise_floor > 0.3  # an axis of a plain set is nearly white beyond the plane's own band
    assert ours[0].noise_floor < 1e-4
    for axis in ours[1:]:
        assert axis.noise_floor < 0.02


def test_weights_out_of_range_are_refused():
    with pytest.raises(InputError, match="weights must be positive"):
        ProjectiveEnergy(16, 2, 1.0, subsets("1", 2), weights={(0,): 0.0})


def test_shares_count_the_frequencies_bound():
    found = shares(1024, 2, subsets("1", 2), edge=0.25)
    assert found[0,] == found[1,] == pytest.approx(2 * 255 / 2048, rel=0.01)
    assert found[0, 1] == pytest.approx(np.pi * 0.72**2 / 2, rel=0.01)
