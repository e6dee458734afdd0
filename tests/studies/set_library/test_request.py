"""The sets that a library shall hold: every n and d that a generator serves, and what excludes others."""

from __future__ import annotations

import pytest

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.generators.registry import find
from gbnbench.studies.set_library.request import DEFAULT_D, DEFAULT_GENERATORS, DEFAULT_N, library_request


def test_the_whole_is_every_size_of_four_generators_less_what_they_refuse():
    request = library_request()
    sizes = len(DEFAULT_GENERATORS) * len(DEFAULT_N) * len(DEFAULT_D)
    assert (DEFAULT_N[0], DEFAULT_N[-1], DEFAULT_D) == (16, 65536, (1, 2, 3, 4, 5, 6, 7, 8))
    assert len(request.sets) + len(request.refused) == sizes == 416
    for sets in request.sets:
        assert find(sets.text).refusal(sets.n, sets.d) is None
    for entry in request.refused:
        assert entry.reason == find(entry.generator).refusal(entry.n, entry.d)
    planar = [entry for entry in request.refused if entry.generator == "bnot"]
    assert {(entry.n, entry.d) for entry in planar} == {
        (n, d) for n in DEFAULT_N for d in DEFAULT_D if d != 2
    }


def test_files_are_named_by_generator_dimension_and_n_and_come_smallest_first():
    request = library_request(["gbn[sigma=0.8]", "random"], n=(64, 16), d=(3, 1), realizations=2)
    assert [sets.file for sets in request.sets] == [
        "gbn-sigma-0.8/1d/gbn-sigma-0.8-1d-16.npy",
        "gbn-sigma-0.8/3d/gbn-sigma-0.8-3d-16.npy",
        "random/1d/random-1d-16.npy",
        "random/3d/random-3d-16.npy",
        "gbn-sigma-0.8/1d/gbn-sigma-0.8-1d-64.npy",
        "gbn-sigma-0.8/3d/gbn-sigma-0.8-3d-64.npy",
        "random/1d/random-1d-64.npy",
        "random/3d/random-3d-64.npy",
    ]
    assert request.sets[0].settings["sigma"] == 0.8
    assert request.sets[1].bytes == 8 * 2 * 16 * 3


def test_a_generator_given_twice_comes_once():
    assert len(library_request(["gbn", "gbn[sigma=1]"], n=(16,), d=(2,)).sets) == 1


def test_names_and_numbers_that_are_wrong_are_refused_in_words():
    with pytest.raises(InputError, match="no generator is named 'bnto'"):
        library_request(["bnto"])
    with pytest.raises(InputError, match="no generator given"):
        library_request([])
    with pytest.raises(InputError, match="realizations must be at least 1; got 0"):
        library_request(realizations=0)
    with pytest.raises(InputError, match="n must be at least 1; got 0"):
        library_request(n=())
    with pytest.raises(RefusalError, match="bnot cuts the plane into power cells; got d=3, use d=2"):
        library_request(["bnot"], d=(3,))
