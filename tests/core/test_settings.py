"""Settings of generators and integrands: their text is read back, and mistakes are named."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from gbnbench.core.errors import InputError
from gbnbench.core.settings import configure, parse, specification
from gbnbench.core.torus import FloatArray


@dataclass(frozen=True)
class Sample:
    name: ClassVar[str] = "sample"
    summary: ClassVar[str] = "every type of setting"
    steps: int = 3
    width: float = 0.5
    shift: bool = True
    method: Literal["nesterov", "descent"] = "nesterov"
    limit: int | None = None
    tag: str = "none yet"

    def refusal(self, n: int, d: int) -> str | None:
        return None

    def __call__(self, n: int, d: int, rng: np.random.Generator) -> FloatArray:
        return rng.random((n, d))


@given(
    steps=st.integers(),
    width=st.floats(allow_nan=False, allow_infinity=False),
    shift=st.booleans(),
    method=st.sampled_from(["nesterov", "descent"]),
    limit=st.none() | st.integers(),
    tag=st.text("abcxyz019.-_", min_size=1),
)
def test_any_settings_return_from_their_text(**settings: Any) -> None:
    generator = Sample(**settings)
    name, inside = parse(specification(generator))
    assert name == "sample"
    assert configure(Sample, inside) == generator


def test_canonical_text_holds_what_differs_in_the_order_of_the_fields() -> None:
    assert specification(Sample()) == "sample"
    assert specification(Sample(limit=4, shift=False, steps=9)) == "sample[steps=9,shift=false,limit=4]"


@pytest.mark.parametrize(
    ("settings", "expected"),
    [
        ({"steps": "1e4"}, Sample(steps=10_000)),
        ({"steps": 12.0}, Sample(steps=12)),
        ({"steps": np.int32(7)}, Sample(steps=7)),
        ({"steps": "123456789012345678901"}, Sample(steps=123456789012345678901)),
        ({"width": 2}, Sample(width=2.0)),
        ({"width": "1e-3"}, Sample(width=0.001)),
        ({"shift": "No"}, Sample(shift=False)),
        ({"shift": "1"}, Sample(shift=True)),
        ({"method": "descent"}, Sample(method="descent")),
        ({"limit": "none"}, Sample(limit=None)),
        ({"limit": "8"}, Sample(limit=8)),
        ({"limit": None}, Sample(limit=None)),
    ],
)
def test_values_are_read_by_their_fields_type(settings: dict[str, object], expected: Sample) -> None:
    made = configure(Sample, settings)
    assert made == expected
    for key in settings:
        assert type(getattr(made, key)) is type(getattr(expected, key))


@pytest.mark.parametrize(
    ("settings", "message"),
    [
        ({"steps": "2.5"}, "steps of sample must be a whole number; got '2.5'"),
        ({"steps": True}, "steps of sample must be a whole number; got True"),
        ({"steps": "many"}, "steps of sample must be a whole number; got 'many'"),
        ({"width": "nan"}, "width of sample must be a finite number; got 'nan'"),
        ({"width": "inf"}, "width of sample must be a finite number"),
        ({"width": None}, "width of sample must be a finite number; got None"),
        ({"shift": "perhaps"}, "shift of sample must be true or false; got 'perhaps'"),
        ({"shift": 1}, "shift of sample must be true or false; got 1"),
        ({"method": "newton"}, "method of sample must be one of nesterov, descent; got 'newton'"),
        ({"tag": 3}, "tag of sample must be text; got 3"),
        (
            {"wdth": 3},
            r"no setting 'wdth' \(did you mean 'width'.*steps=3, width=0.5, shift=true, method=",
        ),
    ],
)
def test_wrong_values_are_named(settings: dict[str, object], message: str) -> None:
    with pytest.raises(InputError, match=message):
        configure(Sample, settings)


def test_empty_brackets_are_no_settings() -> None:
    assert parse("gbn[]") == ("gbn", {})


MALFORMED = (
    "gbn[ gbn] gbn[a=1]] gbn[a=1]x gbn[[a=1]] [a=1] gbn[a] gbn[a=] gbn[=1] gbn[a=1,] gbn[a=1,a=2] gbn,lloyd"
)


@pytest.mark.parametrize("text", ["", "  ", "a b", *MALFORMED.split()])
def test_malformed_text_is_refused(text: str) -> None:
    with pytest.raises(InputError):
        parse(text)


def test_a_malformed_text_is_told_what_it_should_describe() -> None:
    with pytest.raises(
        InputError, match=r"^a generator must read name or name\[setting=value,...\]; got 'a b'"
    ):
        parse("a b")
    with pytest.raises(InputError, match=r"^an integrand must read name"):
        parse("a b", "an integrand")
