"""Arrays put together from parts, in memory or in a nameless file: the numbers of numpy either way."""

from __future__ import annotations

import numpy as np
import pytest

from gbnbench.analysis.measures import analyse_to_arrays
from gbnbench.core import large_arrays
from gbnbench.core.large_arrays import filled


@pytest.mark.parametrize("most", [0, 1 << 28])
def test_parts_lie_one_after_another(monkeypatch, most):
    monkeypatch.setattr(large_arrays, "IN_MEMORY", most)
    parts = [np.random.default_rng(k).random((k, 3, 2)) for k in (1, 4, 2)]
    whole = filled((7, 3, 2), iter(parts))
    assert isinstance(whole, np.memmap) == (most == 0)
    assert whole.tobytes() == np.concatenate(parts).tobytes()


def test_too_few_and_too_many_rows_are_refused():
    with pytest.raises(ValueError, match="1 rows were given for 2"):
        filled((2, 3), [np.zeros((1, 3))])
    with pytest.raises(ValueError, match="could not broadcast"):
        filled((1, 3), [np.zeros((2, 3))])


def test_measures_are_the_same_bits_of_arrays_in_files(monkeypatch):
    x = np.random.default_rng(1).random((40, 64, 2))
    here = analyse_to_arrays(x)
    monkeypatch.setattr(large_arrays, "IN_MEMORY", 0)
    there = analyse_to_arrays(x)
    assert repr(dict(here.measures.measured)) == repr(dict(there.measures.measured))
    assert repr(dict(here.measures.standard_error)) == repr(dict(there.measures.standard_error))
    assert here.spectrum.power.tobytes() == there.spectrum.power.tobytes()
