"""The registry of evaluators: the plan asks each, and one line adds another."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import ClassVar, get_args

import numpy as np
import pytest

from gbnbench.analysis.spectrum import candidates as candidates_module
from gbnbench.analysis.spectrum import choice as choice_module
from gbnbench.analysis.spectrum.error_model import Errors
from gbnbench.analysis.spectrum.evaluators.evaluation_cost import EvaluationCost
from gbnbench.analysis.spectrum.evaluators.protocol import Evaluator
from gbnbench.analysis.spectrum.evaluators.registry import EVALUATORS, Method, title_of
from gbnbench.analysis.spectrum.evaluators.set_by_set import set_by_set
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.plan import plan
from gbnbench.analysis.spectrum.shell_spectrum import shells
from gbnbench.core.errors import InputError
from tests.oracles.power import direct_power


@dataclass(frozen=True)
class PlainSum(Evaluator):
    """The definition, written out in numpy."""

    method: ClassVar[str] = "plain"
    title: ClassVar[str] = "plain sum"
    serves: ClassVar[tuple[str, ...]] = ("cube", "shells")

    @classmethod
    def offer(cls, request, precision, *, floor=None, forced=False):
        return cls(precision) if precision == "double" and request.n < 1000 else None

    @classmethod
    def why_not(cls, request, precision):
        return f"the plain sum takes fewer than 1,000 points in double; got n={request.n} in {precision}"

    @property
    def device(self):
        return "numpy"

    def cost(self, request):
        return EvaluationCost(0.0, 1, 0.0)

    def expected_errors(self, request):
        return Errors(1e-13, 1e-12)

    def cube(self, x, fmax, weights, *, half, mean):
        f = np.indices((2 * fmax + 1,) * x.shape[2]).reshape(x.shape[2], -1).T - fmax

        def one_set(one, w):
            return direct_power(one, f).reshape((2 * fmax + 1,) * x.shape[2]), Errors(1e-13, 1e-12)

        return set_by_set(x, weights, one_set, mean=mean)


@pytest.fixture
def with_plain_sum(monkeypatch):
    for module in (candidates_module, choice_module):
        monkeypatch.setattr(module, "EVALUATORS", (*EVALUATORS, PlainSum))


@pytest.mark.usefixtures("with_plain_sum")
def test_an_evaluator_is_added_by_one_entry():
    x = np.random.default_rng(1).random((2, 50, 2))
    ours = periodogram(x, 5, method="product")
    cheapest = plan(50, 2, 5)
    assert cheapest.method == "plain"
    assert "plain sum in double" in cheapest.explain()
    assert "not two-group product in double" in cheapest.explain()
    assert plan(50, 2, 5, floor=1e-26).method == "product"  # which the plain sum does not resolve
    added = periodogram(x, 5, method="plain")
    assert (added.method, added.device, added.error_bound > 1e-12) == ("plain", "numpy", True)
    assert np.allclose(added.power, ours.power, rtol=1e-10, atol=1e-12)
    assert periodogram(x, 5).method == "plain"  # it counts no work
    radial = shells(x, 5)  # which the protocol takes from the cube
    assert radial.method == "plain"
    assert radial.power[0] == pytest.approx(ours.power[[4, 6, 5, 5], [5, 5, 4, 6]].mean())
    with pytest.raises(InputError, match="fewer than 1,000 points"):
        periodogram(np.random.default_rng(2).random((1000, 2)), 5, method="plain")
    with pytest.raises(InputError, match="one of product, gridded, numpy, nufft, fft, plain for cube"):
        periodogram(x, 5, method="fastest")


def test_every_evaluator_is_a_method_that_users_can_ask_for():
    assert get_args(Method) == tuple(kind.method for kind in EVALUATORS)
    assert len({kind.title for kind in EVALUATORS}) == len(EVALUATORS)
    for kind in EVALUATORS:
        assert kind.serves
        assert title_of(kind.method) == kind.title


def test_the_docstring_of_periodogram_names_every_method_that_it_takes():
    named = re.search(r"method : \{(.*)\}", periodogram.__doc__ or "")
    assert named is not None
    taken = {kind.method for kind in EVALUATORS if {"cube", "listed"} & set(kind.serves)}
    assert {name.strip().strip('"') for name in named[1].split(",")} == taken


@pytest.mark.parametrize(("word", "meant"), [("two-group product", "product"), ("grided", "gridded")])
def test_a_title_or_a_slip_is_answered_by_the_word(word, meant):
    with pytest.raises(InputError, match=f"did you mean '{meant}'"):
        periodogram(np.random.default_rng(3).random((20, 2)), 5, method=word)
