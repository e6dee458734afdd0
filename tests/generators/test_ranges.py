"""What is said where a setting or a size leaves its range, and that the ends are within."""

from __future__ import annotations

import math

import pytest

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.generators.ranges import (
    check_above,
    check_least,
    check_range,
    outside_plane,
    raise_refusal,
    too_many,
    too_many_axes,
)


def test_ends_that_belong_to_a_range_are_taken() -> None:
    for value in (2, 5):
        check_range("power", value, 2, 5)
    check_least("passes", 1, 1)
    check_least("passes", 1e300, 1)
    check_above("tau", math.nextafter(0, 1), 0, 0.3)
    check_above("tau", 0.3, 0, 0.3)
    check_above("width", 1e300, 0)


@pytest.mark.parametrize("value", [1.9, 5.1, math.nan, math.inf, -math.inf])
def test_a_range_refuses_what_is_outside(value: float) -> None:
    with pytest.raises(InputError, match=rf"power must lie in \[2, 5\] spacings; got {value}"):
        check_range("power", value, 2, 5, "spacings")


@pytest.mark.parametrize(
    ("value", "said"), [(0, ">= 1;"), (math.nan, ">= 1;"), (math.inf, ">= 1 and finite;")]
)
def test_a_least_refuses_what_is_below_infinite_or_no_number(value: float, said: str) -> None:
    with pytest.raises(InputError, match=f"passes must be {said} got {value}"):
        check_least("passes", value, 1)


@pytest.mark.parametrize("value", [0, -1, 0.31, math.nan, math.inf])
def test_a_bound_above_refuses_the_bound_itself(value: float) -> None:
    with pytest.raises(InputError, match=f"tau must be above 0 and at most 0.3; got {value}"):
        check_above("tau", value, 0, 0.3)


@pytest.mark.parametrize("value", [0, math.nan, math.inf])
def test_without_a_largest_the_bound_above_takes_finite_numbers(value: float) -> None:
    with pytest.raises(InputError, match=f"width must be above 0 spacings and finite; got {value}"):
        check_above("width", value, 0, unit="spacings")


def test_sizes_that_fit_have_no_reason_and_others_name_the_nearest() -> None:
    assert too_many(100, 100, "for a set by hand") is None
    assert too_many_axes(3, 3, "for a raster") is None
    assert outside_plane(2, "cmj is a method of the plane") is None
    assert str(too_many_axes(4, 3, "for a raster")).endswith("got d=4, nearest is 3")
    assert (
        outside_plane(1, "cmj is a method of the plane") == "cmj is a method of the plane; got d=1, use d=2"
    )


def test_a_reason_is_raised_as_it_is() -> None:
    raise_refusal(None)
    with pytest.raises(RefusalError, match=r"^too large$"):
        raise_refusal("too large")
