"""Palettes: colours are read or found, and mixed from inks as the least error has it."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import minimize

from gbnbench.core.errors import InputError
from gbnbench.io.images.arrays import image_of
from gbnbench.studies.stippling.darkness import ToneCurve
from gbnbench.studies.stippling.palette import (
    LEAST_INK,
    found_palette,
    ink_shares,
    palette_darkness,
    read_palette,
)

INKS = ("#ffd700", "#dd0000", "#0088cc", "#336633", "#000000")


def _taken(colour):
    return 1 - np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255


@pytest.mark.parametrize("inks", [INKS[1:2], INKS[:3], INKS])
def test_shares_are_the_least_error_that_a_general_optimiser_finds(inks):
    colours = np.random.default_rng(len(inks)).random((12, 3))
    shares = ink_shares(colours, inks)
    assert shares.min() >= 0
    assert shares.sum(axis=1).max() <= 1 + 1e-9
    takes = np.array([_taken(ink) for ink in inks])

    def value(a, colour):
        return 0.5 * ((colour - a @ takes) ** 2).sum() + LEAST_INK * a.sum()

    for colour, own in zip(colours, shares, strict=True):
        best = minimize(
            value, np.full(len(inks), 0.1), (colour,), "SLSQP", bounds=[(0, 1)] * len(inks),
            constraints={"type": "ineq", "fun": lambda a: 1 - a.sum()}, options={"ftol": 1e-12},
        )  # fmt: skip
        assert value(own, colour) <= best.fun + 1e-7


def test_each_ink_alone_is_itself_and_a_grey_is_black_dots():
    shares = ink_shares(np.array([_taken(ink) for ink in INKS]), INKS)
    assert shares == pytest.approx(np.eye(5), abs=0.01)
    grey = ink_shares(np.full((1, 3), 0.4), INKS)[0]
    assert grey == pytest.approx([0, 0, 0, 0, 0.4], abs=0.01)


def test_a_picture_is_parted_into_its_inks():
    picture = np.full((6, 9, 3), 255, np.uint8)
    picture[:, :3] = (221, 0, 0)
    picture[:, 3:6] = (255 + 221) // 2, 128, 128
    found = palette_darkness(image_of(picture, "x"), ("#ffd700", "#dd0000"))
    assert list(found) == ["#dd0000"]
    assert found["#dd0000"].values[0, [0, 4, 8]] == pytest.approx([1, 0.5, 0], abs=0.01)


def test_palettes_are_found():
    picture = np.full((20, 20, 3), 255, np.uint8)
    picture[:8] = (200, 30, 0)
    picture[8:12] = (228, 143, 128)  # the same red, half as much
    picture[12:18] = (0, 60, 120)
    found = found_palette(image_of(picture, "x"), 2, seed=1)
    assert np.array([_taken(ink) for ink in found]) == pytest.approx(
        np.array([_taken("#c81e00"), _taken("#003c78")]), abs=0.02
    )
    assert found_palette(image_of(picture[:8], "x"), 4) == ("#c81e00",)
    assert len(found_palette(image_of(np.full((4, 4), 90, np.uint8), "x"), 3)) == 1


def test_words_are_read():
    assert read_palette("#000, gold,#08c") == ("#ffd700", "#0088cc", "#000000")
    assert read_palette(" 5 ") == 5
    for text, says in (
        ("#000,blau", "'blau' is no colour"),
        ("", "'' is no colour"),
        ("#fff,#000", "white is the paper"),
        ("#f00,red", "#ff0000 is in the palette twice"),
        ("0", "1 to 8 inks; got 0"),
        ("9", "1 to 8 inks; got 9"),
        (",".join(f"#00{k}" for k in range(9)), "1 to 8 inks; got 9"),
    ):
        with pytest.raises(InputError, match=says):
            read_palette(text)


def test_white_and_negatives_are_refused():
    white = image_of(np.full((4, 4, 3), 255, np.uint8), "w")
    with pytest.raises(InputError, match="w has no place for points"):
        found_palette(white, 2)
    with pytest.raises(InputError, match="w has no place for points"):
        palette_darkness(white, ("#000000",))
    with pytest.raises(InputError, match="no negative"):
        palette_darkness(white, ("#000000",), ToneCurve(invert=True))
