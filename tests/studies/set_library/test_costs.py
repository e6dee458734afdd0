"""Estimated costs: those measured as they were measured, others by counted operations or a power of n."""

from __future__ import annotations

import math

import pytest

from gbnbench.studies.set_library import costs
from gbnbench.studies.set_library.operations import draw_operations
from gbnbench.studies.set_library.request import RequestedSets, library_request


def only(text: str, n: int, d: int = 2, realizations: int = 8) -> RequestedSets:
    (sets,) = library_request([text], (n,), (d,), realizations).sets
    return sets


@pytest.fixture
def rows(monkeypatch: pytest.MonkeyPatch) -> None:
    """Costs of a machine that does not exist."""
    measured = {
        ("bnot", 2): [(16, 0.1), (64, 0.4), (256, 3.2)],
        ("gbn", 2): [(64, 0.5), (1024, 2.0)],
        ("measuring", 2): [(16, 0.8), (1024, 6.4)],
    }
    monkeypatch.setattr(costs, "_rows", lambda: measured)


def test_a_size_that_was_measured_costs_what_it_cost(rows):
    one, measuring = costs.file_cost(only("bnot", 64))
    assert (one.seconds, one.measured) == (0.4, True)
    assert costs.file_cost(only("bnot", 16, realizations=4))[1] == costs.CostEstimate(0.4, True)
    assert not measuring.measured


def test_where_nobody_counts_the_cost_is_a_power_of_n(rows):
    between, _ = costs.file_cost(only("bnot", 32))
    assert between.seconds == pytest.approx(0.2)  # linear from 16 to 64
    beyond, _ = costs.file_cost(only("bnot", 1024))
    assert beyond.seconds == pytest.approx(3.2 * 8)  # n^1.5 from 64 to 256
    assert not between.measured
    assert not beyond.measured


def test_where_operations_are_counted_costs_are_in_their_ratio(rows):
    sets = only("gbn", 4096)
    ratio = draw_operations(sets.generator, 4096, 2) / draw_operations(sets.generator, 1024, 2)
    assert costs.file_cost(sets)[0].seconds == pytest.approx(2.0 * ratio)
    assert 3 < ratio < 5  # strips are linear in n


def test_the_total_tells_measured_extrapolated_and_unknown_apart(rows):
    total = costs.total_cost([only("bnot", 64), only("bnot", 1024), only("random", 16)])
    measuring = 0.8 * 4 ** (math.log(8) / math.log(64))  # of n=64, on the law through 16 and 1024
    assert total.unknown == 1
    assert total.measured == pytest.approx(8 * 0.4 + 6.4)
    assert total.extrapolated == pytest.approx(8 * 25.6 + measuring)
    assert total.seconds == total.measured + total.extrapolated


def test_every_generator_of_the_whole_library_has_measured_costs_in_every_dimension_it_serves():
    whole = library_request()
    assert costs.total_cost(whole.sets).unknown == 0
    assert costs.cost_machine()
