"""Settings at the ends of what numbers can be: each is refused in words, or the set is drawn."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest

from gbnbench.core.errors import InputError, RefusalError
from gbnbench.generators.registry import GENERATORS, find, generate

EXTREMES = ("0", "-1", "1e308", "-1e308", "1e-308", "9" * 30, "nan", "inf", "text")


@pytest.mark.parametrize("name", GENERATORS)
def test_extreme_settings_are_refused_in_words_if_at_all(name: str) -> None:
    for field in dataclasses.fields(GENERATORS[name]):  # type: ignore[arg-type]
        for value in EXTREMES:
            try:
                generator = find(f"{name}[{field.name}={value}]")
            except InputError:
                continue
            for n, d in ((1, 2), (13, 2), (17, 3), (5, 1)):
                reason = generator.refusal(n, d)
                assert reason is None or reason


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("kdm[iterations=1e12]", r"iterations must lie in \[1, 1000000\]"),
        ("kdm[temperature=1e308]", r"temperature must lie in \[0, 1000\]"),
        ("electrostatic[shaking=1e308]", r"shaking must lie in \[0, 1000\]"),
        ("voidcluster[share=1e-308]", r"share must be 1/2\*\*20 or more"),
        ("voidcluster[sigma=1e-308]", r"sigma must lie in \[0.1, 20\] pixels"),
        ("staircase[level=1e308]", r"level must be above 0 and at most 1e\+06"),
        ("peak[power=1e308]", r"power must lie in \[0, 1e\+06\]"),
        ("deep[edge=1e308]", r"edge must lie in \[1e-09, 1e\+09\]"),
        ("gbn[cutoff=1e308]", r"cutoff must lie in \[0, 1e\+06\]"),
        ("gbn[gradients=1e12]", r"gradients must lie in \[0, 10000000\]"),
    ],
)
def test_what_would_overflow_or_never_end_is_refused(text: str, says: str) -> None:
    with pytest.raises(InputError, match=says):
        find(text)


@pytest.mark.parametrize(
    ("text", "n", "d", "says"),
    [
        ("step[highest=0.5]", 1, 2, "no frequency of n=1 points in d=2 has nu below 0.5"),
        ("step[highest=1e-9]", 13, 1, "no frequency of n=13"),
        ("step[highest=1e9]", 3, 1, r"frequencies of n=3 .* GB of memory"),
        ("peak[highest=1e308]", 13, 2, r"GB of memory"),
        ("sliced[directions=1e9,iterations=1]", 4, 2, "GB of memory"),
        (
            "stealthy[core=1.08]",
            13,
            2,
            "no n=13 points in d=2 can be core=1.08 .* densest packing has 1.075",
        ),
    ],
)
def test_what_cannot_be_drawn_is_refused(text: str, n: int, d: int, says: str) -> None:
    with pytest.raises(RefusalError, match=says):
        generate(text, n=n, d=d)


def test_a_peak_as_narrow_as_numbers_can_be_is_a_step() -> None:
    with np.errstate(all="raise"):
        power = find("peak[width=1e-308]").profile(2)(np.array([0.1, 0.9]))  # type: ignore[attr-defined]
    assert power.tolist() == [0.0, 1.0]
