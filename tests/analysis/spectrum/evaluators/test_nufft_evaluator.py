"""The evaluator of non-uniform FFTs: its library, cost, memory, batches, and what its plan says."""

from __future__ import annotations

import math
import time
from dataclasses import replace

import numpy as np
import pytest

from gbnbench.analysis.spectrum import choice
from gbnbench.analysis.spectrum.evaluators.nufft import cost as cost_module
from gbnbench.analysis.spectrum.evaluators.nufft import evaluator as evaluator_module
from gbnbench.analysis.spectrum.evaluators.nufft import transform as transform_module
from gbnbench.analysis.spectrum.evaluators.nufft.cost import cheapest_layout, nufft_bytes, nufft_seconds
from gbnbench.analysis.spectrum.evaluators.nufft.ducc import DUCC0
from gbnbench.analysis.spectrum.evaluators.nufft.evaluator import NonuniformFFT
from gbnbench.analysis.spectrum.evaluators.nufft.finufft import FINUFFT
from gbnbench.analysis.spectrum.evaluators.nufft.transform import LIBRARIES, nufft_power
from gbnbench.analysis.spectrum.periodogram import periodogram
from gbnbench.analysis.spectrum.plan import plan
from gbnbench.core.errors import InputError
from tests.analysis.spectrum.evaluators.nufft_truth import (
    drawn,
    each_library,
    points,
)
from tests.oracles.power import mean_power, root_distance


@pytest.fixture
def alone(monkeypatch, library):
    """Give a library that is the only one installed."""
    monkeypatch.setattr(transform_module, "LIBRARIES", (library,))
    choice._weighed.cache_clear()
    yield library
    choice._weighed.cache_clear()


@pytest.mark.parametrize("one", LIBRARIES, ids=lambda one: one.name)
def test_expected_seconds_grow_with_every_part_of_the_work(one):
    base = nufft_seconds(one, 10_000, 2, 128, 1e-6)
    assert base < nufft_seconds(one, 100_000, 2, 128, 1e-6)
    assert base < nufft_seconds(one, 10_000, 2, 512, 1e-6)
    assert base < nufft_seconds(one, 10_000, 2, 128, 1e-12)
    assert base < nufft_seconds(one, 10_000, 3, 128, 1e-6)
    assert 8 * 257**2 < nufft_bytes(one, 10_000, 2, 128, 1e-6) < 40e6


@each_library
@pytest.mark.parametrize(("n", "d", "fmax"), [(1000, 1, 5000), (1000, 2, 64), (4000, 3, 16)])
def test_expected_seconds_are_of_the_right_order(library, n, d, fmax):
    x = points(n, d)
    taken = []
    for _ in range(8):
        began = time.process_time()
        nufft_power(library, x, fmax, 1e-9)
        taken.append(time.process_time() - began)
    assert 0.05 < min(taken) / nufft_seconds(library, n, d, fmax, 1e-9) < 20


def test_half_the_modes_are_taken_unless_points_far_outnumber_them():
    for one in LIBRARIES:
        assert cheapest_layout(one, 4096, 2, 128, 1e-9).halved
        assert not cheapest_layout(one, 1_000_000, 2, 10, 1e-9).halved


@pytest.mark.skipif(not all(one.available for one in LIBRARIES), reason="a library is not installed")
def test_ducc0_is_preferred_and_finufft_serves_what_it_cannot_reach(monkeypatch):
    request = plan(500, 3, 9).request
    assert NonuniformFFT.offer(request, "double", floor=1e-9).transformer is DUCC0
    assert NonuniformFFT.offer(request, "double").transformer is DUCC0
    deep = NonuniformFFT.offer(request, "double", floor=(200 * 4.3e-15) ** 2)
    assert deep.transformer is FINUFFT
    assert deep.tolerance < DUCC0.tightest[2]
    out_of_reach = NonuniformFFT.offer(request, "double", floor=1e-28)
    assert (out_of_reach.transformer, out_of_reach.tolerance) == (DUCC0, DUCC0.tightest[2])
    monkeypatch.setattr(transform_module, "LIBRARIES", (FINUFFT,))
    assert NonuniformFFT.offer(request, "double", floor=1e-9).transformer is FINUFFT


@each_library
@pytest.mark.parametrize("together", [1, 3])
def test_means_over_realizations_and_weights_are_the_truth_on_one_core_and_on_several(
    monkeypatch, alone, together
):
    monkeypatch.setattr(evaluator_module, "WORTH_A_THREAD", 0.0 if together > 1 else math.inf)
    monkeypatch.setattr(evaluator_module.os, "cpu_count", lambda: together)
    x, f = np.stack([points(60, 2, seed) for seed in range(7)]), drawn(9, 2)
    each = np.random.default_rng(4).random((7, 60))
    for weights in (None, each, each[0]):
        for half in (False, True):
            found = periodogram(x, 9, weights=weights, method="nufft", half=half)
            assert found.method == "nufft"
            assert found.device == f"{alone.name} on the CPU"
            own = f * np.where(f[:, :1] < 0, -1, 1) if half else f
            power = found.power[tuple((own + np.array([0 if half else 9, 9])).T)]
            met = root_distance(power, mean_power(x, f, weights))
            assert met.max() <= found.error_bound
            assert found.power[(0 if half else 9), 9] == pytest.approx(
                60 if weights is None else np.mean(np.sum(weights, -1) ** 2 / np.sum(np.square(weights), -1))
            )
    evaluator = NonuniformFFT("double", 1e-6, alone)
    powers, _ = evaluator.cube(x, 9, None, half=False, mean=False)
    for one, power in zip(x, powers, strict=True):
        assert np.array_equal(power, nufft_power(alone, one, 9, 1e-6))


@each_library
def test_the_plan_and_the_spectrum_name_the_library(alone):
    x = points(300, 2)
    found = periodogram(x, 20, floor=1e-8, method="nufft")
    assert found.device == f"{alone.name} on the CPU"
    assert found.resolvable <= 1e-8
    offered = NonuniformFFT.offer(plan(300, 2, 20).request, "double", floor=1e-8)
    assert offered.device == found.device
    assert offered.label.startswith("non-uniform FFT to")


@each_library
def test_a_grid_that_does_not_fit_is_not_offered(monkeypatch, alone):
    request = plan(100, 3, 60).request
    held = nufft_bytes(alone, 100, 3, 60, alone.tightest[2])
    monkeypatch.setattr(evaluator_module, "memory_limit", lambda: held)
    assert NonuniformFFT.offer(request, "double") is None
    with pytest.raises(InputError, match=r"does not fit in memory; ask for a smaller fmax"):
        periodogram(points(100, 3), 60, method="nufft")
    monkeypatch.setattr(evaluator_module, "memory_limit", lambda: 4 * held)
    assert NonuniformFFT.offer(request, "double") is not None


@each_library
def test_what_the_library_cannot_allocate_is_refused_in_words(library):
    def fails(*_):
        raise MemoryError("std::bad_alloc")

    with pytest.raises(InputError, match=rf"{library.name} cannot evaluate \d+ frequencies: std::bad_alloc"):
        nufft_power(replace(library, transform=fails), points(5, 2), 3, 1e-6)


def test_every_layout_reaches_its_tolerance():
    for one in LIBRARIES:
        for tolerance in (1e-1, 1e-6, 1e-9, 1e-12, 2e-14):
            layouts = list(cost_module._layouts(one, 1000, 2, 50, tolerance))
            assert layouts
            assert all(layout.upsampling.reaches <= tolerance for layout in layouts)
