"""What is kept from call to call: made once for requests that are alike, and never given to another one."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from itertools import product

import numpy as np
import pytest

from gbnbench import periodogram
from gbnbench.analysis.precision import precision_of
from gbnbench.analysis.spectrum import choice
from gbnbench.analysis.spectrum.evaluators import kept_memory, prepared_cube
from gbnbench.analysis.spectrum.evaluators.cube_product import cube_powers
from gbnbench.analysis.spectrum.evaluators.gridded_fft import transform_choice
from gbnbench.analysis.spectrum.evaluators.kept_memory import KEPT_BYTES, KEPT_REQUESTS, forget, kept
from gbnbench.analysis.spectrum.evaluators.prepared_cube import PreparedCube
from tests.devices import gpu_form


class Memory:
    """Something of a size, that counts how often one was made."""

    made = 0

    def __init__(self, *sizes: int) -> None:
        type(self).made += 1
        self.nbytes = sum(sizes)


@pytest.fixture(autouse=True)
def _none_made(monkeypatch):
    forget()
    monkeypatch.setattr(Memory, "made", 0)


def test_the_same_arguments_get_the_same_memory_and_others_their_own():
    first = kept(Memory, 1, 2)
    assert kept(Memory, 1, 2) is first
    assert kept(Memory, 2, 1) is not first
    assert Memory.made == 2
    forget()
    assert kept(Memory, 1, 2) is not first


def test_only_the_last_requests_are_kept():
    first = kept(Memory, 0)
    for k in range(1, KEPT_REQUESTS):
        kept(Memory, k)
    assert kept(Memory, 0) is first  # now the last used
    kept(Memory, KEPT_REQUESTS)
    assert kept(Memory, 0) is first
    kept(Memory, 1)
    assert Memory.made == KEPT_REQUESTS + 2


def test_no_more_bytes_are_kept_than_allowed():
    small = kept(Memory, 1)
    kept(Memory, KEPT_BYTES + 1)
    kept(Memory, KEPT_BYTES + 1)
    assert Memory.made == 3
    assert kept(Memory, 1) is small
    kept(Memory, KEPT_BYTES)
    assert kept(Memory, 1) is not small


def test_every_thread_has_its_own():
    here = kept(Memory, 5)
    with ThreadPoolExecutor(1) as pool:
        there = pool.submit(kept, Memory, 5).result()
        assert pool.submit(kept, Memory, 5).result() is there
    assert there is not here


@pytest.mark.parametrize(("n", "d", "fmax"), [(16, 2, 4), (300, 3, 8)])
def test_a_request_seen_before_is_not_planned_again(monkeypatch, n, d, fmax):
    made, planned = [], []
    init, cheapest = PreparedCube.__init__, choice._cheapest.__wrapped__

    def counted(self, *arguments):
        made.append(arguments)
        init(self, *arguments)

    def weighed(request, *others):
        planned.append(request)
        return cheapest(request, *others)

    monkeypatch.setattr(PreparedCube, "__init__", counted)
    monkeypatch.setattr(choice, "_cheapest", choice.lru_cache(weighed))
    rng = np.random.default_rng(0)
    for _ in range(4):
        assert periodogram(rng.random((n, d)), fmax).method == "product"
    assert len(made) == len(planned) == 1
    periodogram(rng.random((n, d)), fmax + 1)
    periodogram(rng.random((n, d)), fmax)
    assert len(made) == len(planned) == 2


def test_a_grid_seen_before_is_not_made_again(monkeypatch):
    made = []
    monkeypatch.setattr(
        transform_choice, "_made", lambda *a, make=transform_choice._made: made.append(a) or make(*a)
    )
    for k in range(3):
        periodogram(np.random.default_rng(k).random((50, 2)), 40, method="fft")
    periodogram(np.random.default_rng(0).random((50, 2)), 40, "float", method="fft")
    assert len(made) == 2


def every_request():
    """Requests that differ in one thing each, and some in none, in an order that mixes them."""
    rng = np.random.default_rng(2)
    x = rng.random((6, 40, 2))
    weights = {None: None, "shared": rng.random((1, 40)), "each": rng.random((3, 40))}
    forms = list(product(("double", "float"), weights, (False, True), (False, True), (5, 6, 30), (40, 39)))
    for k in rng.permutation(2 * len(forms)):
        precision, form, half, mean, fmax, n = forms[k % len(forms)]
        sets = x[3 * (k % 2) : 3 * (k % 2) + 3, :n]
        w = weights[form]
        yield precision, sets, fmax, None if w is None else w[:, :n], half, mean


@pytest.mark.parametrize("least_work", [True, False], ids=["one launch", "several"])
def test_nothing_leaks_between_sets_weights_precisions_and_sizes(monkeypatch, least_work):
    if not least_work:
        monkeypatch.setattr(prepared_cube, "is_small", lambda *_: False)
    monkeypatch.setattr(kept_memory, "KEPT_REQUESTS", 100)
    requests = list(every_request())[::3]
    mixed = [cube_powers(precision_of(name), *request) for name, *request in requests]
    for (name, *request), (power, errors) in zip(requests, mixed, strict=True):
        forget()
        alone, of_alone = cube_powers(precision_of(name), *request)
        assert np.array_equal(alone, power)
        assert of_alone == errors


def test_nothing_leaks_between_devices():
    x = np.random.default_rng(4).random((1, 30, 2))
    here, there = precision_of("double"), gpu_form()
    of_each = [[cube_powers(p, x, 7)[0] for p in (here, there)] for _ in range(2)]
    cubes = [kept(PreparedCube, p, 30, 2, 1, 7, False, True) for p in (here, there)]
    assert cubes[0] is not cubes[1]
    for before, after in zip(*of_each, strict=True):
        assert np.array_equal(before, after)


def test_what_was_returned_is_not_written_again():
    rng = np.random.default_rng(6)
    for fmax, method in ((4, "product"), (40, "fft")):
        first = periodogram(rng.random((20, 2)), fmax, method=method).power
        copy = first.copy()
        periodogram(rng.random((20, 2)), fmax, method=method)
        assert np.array_equal(first, copy)
