"""Sides of a torus: volume one, ratios kept, and a cube told from a box."""

from __future__ import annotations

import math

import numpy as np
import pytest

from gbnbench.core.errors import InputError
from gbnbench.core.sides import as_sides, positions, sides_text, wave_numbers


@pytest.mark.parametrize("sides", [(2, 1), (1.0, 3.0, 0.5), np.array([7, 7, 7, 1]), [1e-3, 1e2]])
def test_sides_have_volume_one_and_keep_their_ratios(sides: object) -> None:
    given = np.asarray(sides, dtype=float)
    found = as_sides(given, len(given))
    assert found is not None
    assert math.isclose(math.prod(found), 1, rel_tol=1e-14)
    np.testing.assert_allclose(np.array(found) / found[0], given / given[0], rtol=1e-14)


@pytest.mark.parametrize("sides", [None, (1, 1), (512.0, 512.0), (0.1 + 0.2, 0.3)])
def test_a_cube_is_none(sides: object) -> None:
    assert as_sides(sides, 2) is None  # type: ignore[arg-type]


def test_one_dimension_has_no_ratio() -> None:
    assert as_sides((7.0,), 1) is None


@pytest.mark.parametrize(
    ("sides", "says"),
    [
        ((1, 2, 3), "sides must be 2 lengths, one for each coordinate, such as (2, 1)"),
        ((1, 0), "positive"),
        ((1, -2), "positive"),
        ((1, math.nan), "finite"),
        ((1, math.inf), "finite"),
        (2.0, "one for each coordinate"),
        ("21", "sides must be 2 lengths"),
        ((True, True), "sides must be 2 lengths"),
        ((1, "a"), "sides must be 2 lengths"),
        ((1, [2, 3]), "sides must be 2 lengths"),
        ((1, 2e6), "factor of 1e+06"),
    ],
)
def test_what_is_no_box_is_refused_in_words(sides: object, says: str) -> None:
    with pytest.raises(InputError) as caught:
        as_sides(sides, 2)  # type: ignore[arg-type]
    assert says in str(caught.value)


def test_positions_stay_inside_the_box() -> None:
    sides = as_sides((3, 1), 2)
    placed = positions(np.full((1, 2), np.nextafter(1.0, 0.0)), sides)
    assert (placed < np.array(sides)).all()
    x = np.random.default_rng(0).random((10, 2))
    assert positions(x, None) is x


def test_wave_numbers() -> None:
    sides = as_sides((2, 1), 2)
    # A rectangle of area 1 is sqrt(2) by 1/sqrt(2).
    np.testing.assert_allclose(
        wave_numbers([[1, 0], [0, 1], [2, 1]], sides), [math.sqrt(0.5), math.sqrt(2), 2], rtol=1e-15
    )
    np.testing.assert_array_equal(wave_numbers([3, 4], None), 5.0)


def test_text() -> None:
    sides = as_sides((1024, 512), 2)
    assert sides is not None
    assert sides_text(sides) == "2:1"
    hexagonal = as_sides((math.sqrt(3), 1), 2)
    assert hexagonal is not None
    assert sides_text(hexagonal) == "1.73205:1"
