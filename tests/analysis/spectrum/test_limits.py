"""What fits, by count and by memory; what is named instead is the largest that does."""

from __future__ import annotations

import re

import numpy as np
import pytest

from gbnbench.analysis.spectrum import limits
from gbnbench.analysis.spectrum.limits import BYTES, MEMORY_SHARE, check_fmax, check_harmonic, largest_fmax
from gbnbench.core.errors import InputError


def named(call, *arguments):
    """The fmax that an error names, or None."""
    with pytest.raises(InputError) as refusal:
        call(*arguments)
    found = re.findall(r"the largest fmax (?:that fits )?is (\d+)", str(refusal.value))
    return int(found[0]) if found else None


@pytest.mark.parametrize("d", [1, 2, 3, 4, 5, 6, 8, 12])
@pytest.mark.parametrize("base", [3, 5, 7, 9, 11, 21])
@pytest.mark.parametrize("beside", [-1, 0, 1])
def test_the_largest_cube_that_fits_is_named(monkeypatch, d, base, beside):
    count = base**d + beside
    monkeypatch.setattr(limits, "memory_limit", lambda: int(count * BYTES / MEMORY_SHARE))
    asked = {1: 10**9, 2: 10**6}.get(d, 10)
    largest = next(f for f in range(20, -1, -1) if (2 * f + 1) ** d <= count)
    while (2 * asked + 1) ** d > 1 << 63:
        asked -= 1
    if (2 * asked + 1) ** d <= count:
        assert check_fmax(asked, d) == asked
        return
    assert named(check_fmax, asked, d) == (largest or None)
    if largest:
        assert check_fmax(largest, d) == largest
        assert named(check_fmax, largest + 1, d) == largest


def test_where_no_cube_fits_the_way_out_is_another():
    with pytest.raises(InputError, match=r"list the frequencies you need, or take gbnbench\.shells"):
        check_fmax(1, 30)


@pytest.mark.parametrize("d", range(1, 40))
def test_the_largest_that_can_be_counted_is_named(d):
    largest = largest_fmax(1 << 63, d)
    assert (2 * largest + 1) ** d <= 1 << 63 < (2 * largest + 3) ** d
    assert check_harmonic(largest, d) == largest
    assert named(check_harmonic, largest + 1, d) == largest


@pytest.mark.parametrize("d", [40, 100])
def test_what_no_harmonic_makes_countable_says_so(d):
    with pytest.raises(InputError, match=r"more than 2\^63.*list the frequencies"):
        check_harmonic(1, d)


@pytest.mark.parametrize("fmax", [0, -1, 1.0, True, "3", None, np.float64(2), float("nan"), [1]])
@pytest.mark.parametrize("check", [check_fmax, check_harmonic])
def test_what_is_no_positive_integer_is_refused(fmax, check):
    with pytest.raises(InputError, match="fmax must be an integer of at least 1"):
        check(fmax, 2)


def test_numpys_integers_are_integers():
    for kind in (np.int8, np.uint16, np.int64):
        assert check_fmax(kind(7), 3) == 7
        assert type(check_fmax(kind(7), 3)) is int


def test_memory_is_that_of_the_machine():
    assert 1 << 28 < limits.memory_limit() < 1 << 50
