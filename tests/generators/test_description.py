"""Descriptions: each setting of every generator has a meaning, and what is served is what is not refused."""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import ClassVar, Literal

import pytest

from gbnbench.generators.description import describe
from gbnbench.generators.registry import GENERATORS, find


@pytest.mark.parametrize("name", GENERATORS)
def test_every_setting_has_a_meaning(name: str) -> None:
    description = describe(find(name))
    fields = dataclasses.fields(GENERATORS[name])  # type: ignore[arg-type]
    assert [setting.name for setting in description.settings] == [field.name for field in fields]
    for setting in description.settings:
        assert setting.meaning, f"{setting.name} of {name} is not in the docstring of its class"
        assert setting.type
        assert setting.value is setting.default
    assert description.opening


@pytest.mark.parametrize("name", GENERATORS)
def test_what_it_serves_lies_in_its_dimensions(name: str) -> None:
    generator = find(name)
    least, most = GENERATORS[name].dimensions
    for served in describe(generator).serves:
        if served.n:
            assert least <= served.d <= (most or served.d)
        for n in served.n:
            assert generator.refusal(n, served.d) is None
        for n, reason in served.refused.items():
            assert generator.refusal(n, served.d) == reason


@dataclass(frozen=True)
class Told:
    """Points that are told of.

    A second paragraph.

    Parameters
    ----------
    low, high : float
        Ends of the range,
        in spacings.
    kind : {"plain", "odd"}
        Which.

    Notes
    -----
    P(f) = 1:

        a formula

    References
    ----------
    Nobody, 1900.
    """

    name: ClassVar[str] = "told"
    summary: ClassVar[str] = "told"
    low: float = 0.0
    high: float | None = None
    kind: Literal["plain", "odd"] = "plain"

    def refusal(self, n: int, d: int) -> str | None:
        return None if n % 2 == 0 else f"n must be even; got n={n}"


def test_a_docstring_is_read_section_by_section() -> None:
    description = describe(Told(low=1.0))
    assert description.opening == "Points that are told of.\n\nA second paragraph."
    assert description.notes == "P(f) = 1:\n\n    a formula"
    assert description.references == "Nobody, 1900."
    low, high, kind = description.settings
    assert (low.type, low.default, low.value) == ("number", 0.0, 1.0)
    assert low.meaning == high.meaning == "Ends of the range, in spacings."
    assert high.type == "number or none"
    assert (kind.type, kind.meaning) == ("plain or odd", "Which.")
    assert description.serves[1].refused[3] == "n must be even; got n=3"
    assert 1024 in description.serves[1].n
