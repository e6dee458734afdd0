"""Style of figures: the user's settings stay as they are, also where one figure's function calls another."""

from __future__ import annotations

import matplotlib as mpl
import pytest

from gbnbench.reports import style


def test_the_style_holds_within_functions_that_call_each_other_and_ends_with_the_outermost() -> None:
    @style.styled
    def inner() -> float:
        return float(mpl.rcParams["font.size"])

    @style.styled
    def outer() -> list[float]:
        return [inner(), float(mpl.rcParams["font.size"])]

    with mpl.rc_context({"font.size": 31.0}):
        assert outer() == [style.STYLE["font.size"]] * 2
        assert mpl.rcParams["font.size"] == 31.0


def test_the_style_ends_after_an_error() -> None:
    @style.styled
    def failing() -> None:
        raise ValueError("no ink")

    with mpl.rc_context({"font.size": 31.0}):
        for _ in range(2):
            with pytest.raises(ValueError, match="ink"):
                failing()
            assert mpl.rcParams["font.size"] == 31.0
