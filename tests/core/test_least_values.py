"""Whole numbers that a caller hands over."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from gbnbench.core.errors import InputError
from gbnbench.core.least_values import require


def test_whole_numbers_of_any_type_pass() -> None:
    require(n=(8, 1), seed=(np.uint64(0), 0))


@pytest.mark.parametrize("value", [1.5, 2.0, "2", None, True])
def test_what_is_no_whole_number_is_named(value: Any) -> None:
    with pytest.raises(InputError, match=f"jobs must be a whole number; got {value!r}"):
        require(jobs=(value, 1))


def test_a_number_below_its_least_is_named() -> None:
    with pytest.raises(InputError, match="jobs must be at least 1; got 0"):
        require(jobs=(0, 1))
